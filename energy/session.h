#pragma once

#include "energy/machine.h"
#include "energy/phase_log.h"
#include "energy/plan.h"
#include "energy/provenance.h"
#include "energy/workload.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::energy {

/// A session folder that cannot be written or read. what() names the file and the reason.
class SessionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One row of frames.csv: one operation, or several that follow each other. All figures are means
/// an operation.
struct FrameRow {
  Seconds time;  ///< start of the first operation, since the session's start
  std::vector<KeyValue> configuration;
  std::uint64_t operations = 0;
  PerPhase<std::optional<Seconds>> phases;  ///< without a value where the phase did not happen
  PerPhase<std::optional<Joules>> joules;
  Origin origin = Origin::unavailable;  ///< of the joules

  /// The sum of the phases.
  [[nodiscard]] Seconds total() const;
  friend bool operator==(const FrameRow&, const FrameRow&) = default;
};

/// One row of summary.csv: one configuration.
struct SummaryRow {
  std::vector<KeyValue> configuration;  ///< after the last operation
  std::uint64_t operations = 0;
  PerPhase<std::uint64_t> phase_counts{};  ///< how often each phase happened
  Seconds seconds;                         ///< all operations together
  Seconds mean;                            ///< an operation
  std::optional<Seconds> ci95;             ///< half-width of the mean's 95 % confidence interval
  std::optional<double> effective_rows;    ///< independent rows that the interval rests on
  std::optional<Seconds> median;           ///< of the rows
  std::optional<Seconds> percentile95;     ///< of the rows
  PerPhase<std::optional<double>> shares;  ///< of the time; without a value as in FrameRow
  std::optional<Watts> watts;
  std::optional<Joules> joules;  ///< an operation
  Origin origin = Origin::unavailable;
  std::vector<Counter> counters;

  friend bool operator==(const SummaryRow&, const SummaryRow&) = default;
};

/// How far a session got. A file that still says `running` after its program has ended was cut off;
/// its rows are good all the same.
enum class SessionState { running, complete, interrupted, failed };
std::string_view to_string(SessionState state);
std::optional<SessionState> parse_session_state(std::string_view word);

/// session.toml: what has to be known to judge the numbers.
struct SessionInfo {
  std::string program;  ///< name and version
  std::string command_line;
  std::string started_utc;  ///< ISO 8601: 2026-01-31T23:59:59Z
  SessionState state = SessionState::running;
  Machine machine;
  Plan plan;
  Provenance sensor;
  std::vector<std::string> scenes;
  std::vector<KeyValue> settings;  ///< those that hold for every configuration

  friend bool operator==(const SessionInfo&, const SessionInfo&) = default;
};

/// A whole session as read back from its folder.
struct Session {
  SessionInfo info;
  std::vector<FrameRow> frames;
  std::vector<SummaryRow> summaries;
};

/// The rows of one configuration as one summary row, all but its counters. `rows` is not empty and
/// in the order of time.
SummaryRow summarise(const std::vector<FrameRow>& rows, const PerPhase<std::uint64_t>& counts);

}  // namespace encore::energy
