#pragma once

#include "app/compare.h"

#include <optional>
#include <string>

namespace encore::app {

/// What `encore compare` prints.
struct CompareReport {
  std::string folder_a;
  std::string folder_b;
  energy::SessionInfo info_a;
  energy::SessionInfo info_b;
  std::optional<double> tolerance;
  Comparison comparison;
};

/// For people: a table of the configurations that both have, those that only one has, what the
/// percentages mean, and the verdict on the tolerance. Warnings are not part of it.
std::string compare_text(const CompareReport& report);

/// The same, warnings included, as one JSON object; what does not exist is null.
std::string compare_json(const CompareReport& report);

/// "-12.3 % (-13.1 to -11.5)" or, without an interval, "-12.3 % (?)".
std::string change_text(const FigureChange& change);

}  // namespace encore::app
