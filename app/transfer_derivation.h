#pragma once

#include "energy/csv.h"
#include "energy/session.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::app {

/// What bringing a frame to its device cost, twice: as it was told apart while the frames ran, and
/// as the thesis derives it (section 5.3) from three tests of their own:
///
///   transfer = frame - build - render
///
/// with the frame of test dynamic or forced, the build (or update) of test build and the render of
/// test static, of the same scene, structure, memory, picture size and repeat. All an operation.
struct TransferFigures {
  std::vector<energy::KeyValue> configuration;  ///< of the frames
  std::optional<double> bytes;                  ///< sent
  std::optional<double> ms;                     ///< of the phase
  std::optional<double> joules;                 ///< of the phase, gross
  std::optional<double> joules_ci95;
  /// Derived. Below 0 where the frame took less than its parts did by themselves.
  std::optional<double> derived_ms;
  std::optional<double> derived_ms_ci95;
  std::optional<double> derived_joules;  ///< gross
  std::optional<double> derived_joules_ci95;
  energy::Origin origin = energy::Origin::unavailable;  ///< of the weakest of the joules involved
  std::string note;                                     ///< which test is missing; empty: none
};

/// The transfers of a session, in the order of `rows`: one for each configuration of test dynamic
/// or forced on a device that is not the CPU. `phases`: of the total, for what was told apart.
///
/// A frame's builds are held against test build of device cpu, since that is where structures are
/// built; its updates against test build under the same policy of its own device, which updates its
/// own copy; each as often as it happened in a frame. Where neither happened there is nothing to
/// subtract, and what the frame spent on animating is subtracted as it was told apart. Intervals
/// are added in quadrature, without the sensor's gain error, which all of them share: it goes once
/// into the difference. There are joules only where all parts have them.
std::vector<TransferFigures> derive_transfers(std::span<const energy::SummaryRow> rows,
                                              std::span<const energy::PhaseRow> phases);

/// The columns of transfer.csv and one record of it.
energy::CsvRecord transfer_header(const std::vector<std::string>& configuration_columns);
energy::CsvRecord to_record(const TransferFigures& figures);

/// Derives and writes transfer.csv into a session's folder; no file if there are none. Throws
/// energy::SessionError.
std::vector<TransferFigures> write_transfers(const std::filesystem::path& folder,
                                             std::span<const energy::SummaryRow> rows,
                                             std::span<const energy::PhaseRow> phases);

/// For people: a table, and what is missing; empty if there are none. `rows`: all of the session,
/// which decide what of a configuration is shown.
std::string transfer_text(const std::vector<TransferFigures>& transfers,
                          const std::vector<energy::SummaryRow>& rows);

}  // namespace encore::app
