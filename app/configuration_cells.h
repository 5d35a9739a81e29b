#pragma once

#include "app/profile_table.h"
#include "energy/session.h"

#include <string>
#include <vector>

namespace encore::app {

/// The first columns of a table of configurations: what they have in common is left out, what tells
/// them apart is shown.
class ConfigurationCells {
 public:
  explicit ConfigurationCells(const std::vector<energy::SummaryRow>& rows);

  static void add_columns(TextTable& table);
  /// As many as add_columns() adds.
  [[nodiscard]] std::vector<std::string> cells(
      const std::vector<energy::KeyValue>& configuration) const;

 private:
  bool groups_;
  bool devices_;
  bool memory_;
  bool cases_;
  bool intersections_;
  bool rays_;
  bool samples_;
  bool repeats_;
};

}  // namespace encore::app
