#pragma once

#include "energy/csv.h"
#include "energy/session.h"

#include <string_view>

namespace encore::energy {

/// The columns that only the program knows, in their order: what tells configurations apart, and
/// the figures of a summary.
struct SessionColumns {
  std::vector<std::string> configuration;
  std::vector<std::string> counters;
};

/// What a cell holds whose number could not be measured.
inline constexpr std::string_view kUnavailable = "unavailable";

/// The headers of frames.csv and summary.csv (docs/session-format.md).
CsvRecord frame_header(const SessionColumns& columns);
CsvRecord summary_header(const SessionColumns& columns);

/// Rows as records and back. The readers take the configuration's and the counters' names from the
/// header and throw SessionError for a record that does not fit it.
CsvRecord to_record(const FrameRow& row);
CsvRecord to_record(const SummaryRow& row);
FrameRow frame_from_record(const CsvRecord& header, const CsvRecord& record);
SummaryRow summary_from_record(const CsvRecord& header, const CsvRecord& record);

}  // namespace encore::energy
