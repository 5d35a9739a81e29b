#pragma once

#include "energy/csv.h"
#include "energy/session.h"
#include "energy/session_columns.h"

namespace encore::energy {

/// The headers of the files about energy (docs/session-format.md).
CsvRecord sample_header();
CsvRecord event_header();
CsvRecord phase_header(const SessionColumns& columns);
CsvRecord window_header(const SessionColumns& columns);
CsvRecord convergence_header(const SessionColumns& columns);

/// Rows as records and back, as in session_columns.h.
CsvRecord to_record(const SampleRow& row);
CsvRecord to_record(const EventRow& row);
CsvRecord to_record(const PhaseRow& row);
CsvRecord to_record(const WindowRow& row);
CsvRecord to_record(const ConvergenceRow& row);
SampleRow sample_from_record(const CsvRecord& header, const CsvRecord& record);
EventRow event_from_record(const CsvRecord& header, const CsvRecord& record);
PhaseRow phase_from_record(const CsvRecord& header, const CsvRecord& record);
WindowRow window_from_record(const CsvRecord& header, const CsvRecord& record);
ConvergenceRow convergence_from_record(const CsvRecord& header, const CsvRecord& record);

}  // namespace encore::energy
