#pragma once

#include "energy/csv.h"
#include "tests/support/files.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::energy {

/// One row of a file of assets/thesis: its cells by column.
using ThesisRow = std::map<std::string, std::string>;

/// The rows of assets/thesis/`name`.csv.
inline std::vector<ThesisRow> thesis_rows(const std::string& name) {
  const auto records =
      parse_csv(test::contents_of(ENCORE_SOURCE_DIR "/assets/thesis/" + name + ".csv"));
  if (records.empty()) throw std::runtime_error(name + ".csv cannot be read");
  std::vector<ThesisRow> rows;
  for (std::size_t i = 1; i < records.size(); ++i) {
    ThesisRow row;
    for (std::size_t k = 0; k < records[0].size(); ++k) row[records[0][k]] = records[i].at(k);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A cell's number; NaN for an empty one.
inline double number(const ThesisRow& row, const std::string& column) {
  return parse_csv_number(row.at(column)).value_or(std::nan(""));
}

/// The mean discharge rates in watts of the rows where `chosen` holds and a rate was given.
template <class Chosen>
std::vector<double> rates_of(const std::vector<ThesisRow>& rows, const Chosen& chosen) {
  std::vector<double> watts;
  for (const ThesisRow& row : rows) {
    const double milliwatts = number(row, "discharge_rate_mw");
    if (chosen(row) && !std::isnan(milliwatts)) watts.push_back(milliwatts / 1e3);
  }
  return watts;
}

/// Whether `value` rounds to `stated` at that many decimals.
inline bool rounds_to(double value, double stated, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) == std::round(stated * scale);
}

}  // namespace encore::energy
