#pragma once

#include "app/accuracy/accuracy_rows.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace encore::app {

/// Draws error against cost, both logarithmic, a point each configuration, and the Pareto front as
/// a line: accuracy-time.svg, and accuracy-energy.svg where joules are known. `own_error`: of the
/// reference; smaller errors are drawn at its height. Throws scene::InputError for a file that
/// cannot be written.
void write_accuracy_scatter(const std::filesystem::path& folder,
                            const std::vector<AccuracyRow>& rows,
                            const std::optional<double>& own_error);

}  // namespace encore::app
