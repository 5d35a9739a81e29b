#pragma once

#include "app/stability.h"

#include <string>

namespace encore::app {

void print_stability_header();
/// One line of the table; a second one below it if a limit is broken.
void print_stability_row(const StabilityRow& row);
/// The row as a JSON object; what was not measured is null.
std::string json_stability_row(const StabilityRow& row);

}  // namespace encore::app
