#pragma once

#include "app/compare.h"
#include "app/window/background_task.h"
#include "app/window/power_monitor.h"
#include "energy/session.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace encore::app {

/// The readings of one source of a recorded session.
struct SourceSeries {
  std::string name;
  energy::Provenance provenance;
  bool in_total = false;
  std::vector<PowerPoint> points;  ///< in the order of time, seconds since the session's start
};

/// A figure with the half-width of its 95 % interval, where there is one.
struct BarFigure {
  double value = 0.0;
  std::optional<double> half_width;
};

/// One phase of one configuration.
struct PhaseBar {
  std::string phase;                ///< "build" ...; "idle" and "remainder" for energies only
  std::optional<double> seconds;    ///< an operation
  std::optional<BarFigure> joules;  ///< an operation, gross
  std::optional<BarFigure> net_joules;
  std::string method;  ///< to_string(AttributionMethod); empty where not a phase
  std::string note;    ///< why there is no number, or what weakens it
};

/// One configuration as stacked bars.
struct ConfigurationBars {
  std::vector<energy::KeyValue> configuration;
  std::string name;
  BarFigure seconds;                ///< an operation
  std::optional<BarFigure> joules;  ///< an operation, gross
  std::optional<BarFigure> net_joules;
  std::optional<double> mrays_per_s;
  energy::Provenance energy;  ///< of the joules, or why there are none
  std::vector<PhaseBar> phases;
};

/// A session folder that was read.
struct OpenedSession {
  std::filesystem::path folder;
  /// All but the samples, which are in `series`.
  energy::Session session;
  std::vector<SourceSeries> series;
  std::vector<ConfigurationBars> bars;  ///< in the order of summary.csv
  std::string machine_card;             ///< lines for people
  double seconds = 0.0;                 ///< time of the last row of any kind
  bool cut_off = false;                 ///< its program ended without saying so
  bool recomputed = false;              ///< figures were computed from frames and samples
  std::vector<std::string> remarks;     ///< a sentence each: what the reader did or left out
};

/// Reads a session folder. Progress and stop by `control` (which ends it with SessionError). A row
/// cut off at a file's end is left out; a session without summary rows gets them from its frames
/// and samples. Throws energy::SessionError with one line: the place, what is wrong, the way out.
OpenedSession read_opened_session(const std::filesystem::path& folder, TaskControl& control);

/// Reads sessions in the background:
///   opener.start([folder](TaskControl& c) { return open_for_window(folder, c); });
using SessionOpener = BackgroundTask<std::shared_ptr<const OpenedSession>>;
std::shared_ptr<const OpenedSession> open_for_window(const std::filesystem::path& folder,
                                                     TaskControl& control);

/// The bars of a summary and the rows of phases.csv, of a recorded or of a live session.
std::vector<ConfigurationBars> bars_of(const std::vector<energy::SummaryRow>& summaries,
                                       const std::vector<energy::PhaseRow>& phases,
                                       const energy::Provenance& sensor);

/// One configuration in both of two sessions, for bars laid over each other.
struct ComparedConfiguration {
  std::string name;
  struct Change {
    double a = 0.0;
    double b = 0.0;
    double percent = 0.0;                               ///< B against A
    std::optional<std::pair<double, double>> interval;  ///< 95 %, of the percentage
    Verdict verdict = Verdict::unknown;
  };
  Change seconds;                ///< an operation
  std::optional<Change> joules;  ///< an operation; nothing unless both have it from one origin
};

struct OpenedComparison {
  std::vector<ComparedConfiguration> matched;
  std::vector<std::string> only_a;
  std::vector<std::string> only_b;
  std::vector<std::string> warnings;  ///< what differs besides
};
OpenedComparison compare_opened(const OpenedSession& a, const OpenedSession& b);

/// Gives a session the rows that it lacks because its program was killed, from its windows, its
/// frames and the readings in `series`: summaries, phases of the total and of each source, and how
/// the times converged. Frames behind the last window count for the one that was cut off, if they
/// are of one configuration.
void recompute_figures(energy::Session& session, const std::vector<SourceSeries>& series);

}  // namespace encore::app
