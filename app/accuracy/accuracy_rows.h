#pragma once

#include "app/accuracy/reference.h"
#include "app/workloads.h"
#include "energy/csv.h"
#include "energy/provenance.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// One configuration: what its picture is worth, and what it costs.
struct AccuracyRow {
  WorkloadSpec spec;
  PictureErrors errors;
  std::optional<double> ms;       ///< a frame, median
  std::optional<double> ms_ci95;  ///< half-width of the mean's 95 % interval
  std::optional<double> joules;   ///< a frame, gross
  std::optional<double> joules_ci95;
  energy::Origin origin = energy::Origin::unavailable;  ///< of the joules
  bool best_by_time = false;    ///< on the Pareto front of error and milliseconds
  bool best_by_energy = false;  ///< likewise of joules
};

/// Marks the rows that no other row beats in both: one that costs no more and errs no more, and
/// less in one of them. Rows without a cost are on no front.
void mark_pareto_fronts(std::vector<AccuracyRow>& rows);

/// "bvh-median, gpu, watertight, 4 samples".
std::string accuracy_label(const AccuracyRow& row);

/// The columns of accuracy.csv (docs/session-format.md), and a row of it.
energy::CsvRecord accuracy_header();
energy::CsvRecord to_record(const AccuracyRow& row);

/// All rows as text, and as accuracy.csv in a folder. Throws energy::SessionError as CsvWriter.
std::string accuracy_csv(const std::vector<AccuracyRow>& rows);
void write_accuracy_csv(const std::filesystem::path& folder, const std::vector<AccuracyRow>& rows);

/// The table for people, and one JSON object.
std::string accuracy_table(const std::vector<AccuracyRow>& rows);
std::string accuracy_json(const std::vector<AccuracyRow>& rows,
                          const std::optional<double>& reference_error);

}  // namespace encore::app
