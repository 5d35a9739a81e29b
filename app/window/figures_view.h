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
/// Names of several configurations ("toys, kd-sah, cpu") without the parts that all of them share;
/// as they are where there is one, or where they do not have the same parts.
std::vector<std::string> short_labels(const std::vector<std::string>& labels);
/// What differs between two sessions.
std::vector<ui::ChangeView> views_of(const OpenedComparison& comparison);

}  // namespace encore::app
