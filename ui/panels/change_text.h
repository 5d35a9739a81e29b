#pragma once

#include "ui/view.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::ui {

// What two sessions differ in, as text.

/// "+3.1 % (1.2 .. 5.0)"; without an interval it says so. Nothing: "unavailable".
std::string change_text(const std::optional<double>& percent, const std::optional<double>& low,
                        const std::optional<double>& high);
/// "noise" and "unknown" in words that say what they mean.
std::string verdict_text(const std::string& verdict);

/// One row a configuration: configuration, a_s, b_s, time_percent, time_low_percent,
/// time_high_percent, time_verdict, then the same of J. Missing values are empty.
std::string changes_csv(const std::vector<ChangeView>& changes);

}  // namespace encore::ui
