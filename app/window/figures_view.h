#pragma once

#include "app/window/opened_session.h"
#include "app/window/slot_book.h"
#include "ui/view.h"

#include <string>
#include <vector>

namespace encore::app {

/// Figures of measure mode as the panels see them, one configuration each.
std::vector<ui::ConfigurationView> views_of(const Figures& figures);
/// Those of a session that was opened.
std::vector<ui::ConfigurationView> views_of(const OpenedSession& session);
/// Names of configurations that are shown together: structure and device ("kd-sah, cpu"), and what
/// else is not the same in all of them. All have the same keys in the same order.
std::vector<std::string> short_labels(
    const std::vector<std::vector<energy::KeyValue>>& configurations);
/// What differs between two sessions.
std::vector<ui::ChangeView> views_of(const OpenedComparison& comparison);

}  // namespace encore::app
