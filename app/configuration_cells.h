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
  bool presets_;
  bool groupings_;
  bool places_;
  bool cases_;
  bool intersections_;
  bool rays_;
  bool samples_;
  bool repeats_;
};

/// What all configurations that draw have in common beyond plain ray casting and so is no column:
/// "rays shadows,reflections; depth 4; samples 16". Empty where there is nothing.
std::string common_rays(const std::vector<energy::SummaryRow>& rows);

}  // namespace encore::app
