#pragma once

#include "energy/machine.h"
#include "energy/phase_log.h"
#include "energy/plan.h"
#include "energy/provenance.h"
#include "energy/sources/power_source.h"
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
  /// Gross energy; where it cannot be told (row or phase too short for the sensor) without a value.
  PerPhase<std::optional<Joules>> joules;
  std::optional<Joules> operation_joules;       ///< from the operation's start to its end
  std::optional<Joules> operation_joules_ci95;  ///< half-width, without the sensor's gain error
  Origin origin = Origin::unavailable;          ///< of the joules

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
  std::string source;                      ///< of the energies: names of the sources that are added
  std::optional<Watts> watts;              ///< mean gross power while measuring
  std::optional<Watts> watts_ci95;
  std::optional<Watts> watts_ci95_without_gain;  ///< for ratios of figures of one sensor
  std::optional<Joules> joules;                  ///< an operation, gross
  std::optional<Joules> joules_ci95;
  std::optional<Joules> joules_ci95_without_gain;
  std::optional<Joules> net_joules;  ///< an operation, above idle
  std::optional<Joules> net_joules_ci95;
  std::optional<Watts> idle_watts;
  std::optional<Watts> idle_watts_ci95;
  /// Means over the measured time, and what was counted in it, where the machine tells.
  std::optional<double> temperature_c;
  std::optional<double> clock_mhz;
  std::optional<double> throttle_events;
  Origin origin = Origin::unavailable;
  std::vector<Counter> counters;

  friend bool operator==(const SummaryRow&, const SummaryRow&) = default;
};

/// One row of phases.csv: the energy of one phase of one configuration as one source saw it.
struct PhaseRow {
  std::vector<KeyValue> configuration;
  std::string source;              ///< a source's name, or "total"
  std::string phase;               ///< a phase, or "idle", "remainder", "all"
  std::string method;              ///< to_string(AttributionMethod)
  std::optional<Seconds> seconds;  ///< busy, in all measured operations
  std::optional<double> operations;
  std::optional<Watts> watts;
  std::optional<Watts> watts_ci95;
  std::optional<Joules> joules;  ///< an operation, gross
  std::optional<Joules> joules_ci95;
  std::optional<Joules> net_joules;
  std::optional<Joules> net_joules_ci95;
  Origin origin = Origin::unavailable;
  std::string note;

  friend bool operator==(const PhaseRow&, const PhaseRow&) = default;
};

/// One row of samples.csv: one reading of one source.
struct SampleRow {
  Seconds time;  ///< since the session's start
  std::string source;
  std::optional<Watts> watts;  ///< a gauge's own, else the mean since the reading before
  std::optional<Joules> joules;
  bool changed = true;     ///< the sensor's value differs from the reading before
  bool restarted = false;  ///< the energy since the reading before is unknown
  Origin origin = Origin::unavailable;

  friend bool operator==(const SampleRow&, const SampleRow&) = default;
};

/// One row of events.csv: something that happened to the measuring.
struct EventRow {
  Seconds time;
  std::string source;  ///< empty: the machine
  std::string message;

  friend bool operator==(const EventRow&, const EventRow&) = default;
};

/// One row of windows.csv: what went on when, on the session's clock.
struct WindowRow {
  std::vector<KeyValue> configuration;
  std::string kind;  ///< "idle", "measured" or "mixed"
  Seconds from;
  Seconds to;

  friend bool operator==(const WindowRow&, const WindowRow&) = default;
};

/// One row of convergence.csv: how well a figure was known after some time.
struct ConvergenceRow {
  std::vector<KeyValue> configuration;
  Seconds elapsed;       ///< since the configuration's first measured operation
  std::string quantity;  ///< "time_per_operation" (s), "watts", "joules_per_operation"
  double mean = 0.0;
  std::optional<double> ci95;  ///< half-width
  std::optional<double> relative_ci95;
  std::optional<double> effective_samples;
  std::optional<double> allan_deviation;  ///< of means over allan_window
  std::optional<Seconds> allan_window;
  std::optional<double> drift_per_s;  ///< where it is more than chance

  friend bool operator==(const ConvergenceRow&, const ConvergenceRow&) = default;
};

/// How far a session got. A file that still says `running` after its program has ended was cut off;
/// its rows are good all the same.
enum class SessionState { running, complete, interrupted, failed };
std::string_view to_string(SessionState state);
std::optional<SessionState> parse_session_state(std::string_view word);

/// A power source that the session reads.
struct SessionSource {
  SourceInfo info;
  bool in_total = false;  ///< its energy is part of the figures

  friend bool operator==(const SessionSource&, const SessionSource&) = default;
};

/// session.toml: what has to be known to judge the numbers.
struct SessionInfo {
  std::string program;  ///< name and version
  std::string command_line;
  std::string started_utc;  ///< ISO 8601: 2026-01-31T23:59:59Z
  SessionState state = SessionState::running;
  Machine machine;
  Plan plan;
  Provenance sensor;  ///< of the total
  std::vector<SessionSource> sources;
  std::vector<std::string> scenes;
  std::vector<KeyValue> settings;  ///< those that hold for every configuration

  friend bool operator==(const SessionInfo&, const SessionInfo&) = default;
};

/// A whole session as read back from its folder.
struct Session {
  SessionInfo info;
  std::vector<FrameRow> frames;
  std::vector<SummaryRow> summaries;
  std::vector<PhaseRow> phases;
  std::vector<SampleRow> samples;
  std::vector<EventRow> events;
  std::vector<WindowRow> windows;
  std::vector<ConvergenceRow> convergence;
};

/// Two rows that follow each other as one: means over the operations of both.
FrameRow merge(const FrameRow& a, const FrameRow& b);

/// The rows of one configuration as one summary row, all but its counters. `rows` is not empty and
/// in the order of time.
SummaryRow summarise(const std::vector<FrameRow>& rows, const PerPhase<std::uint64_t>& counts);

}  // namespace encore::energy
