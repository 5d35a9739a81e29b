#pragma once

#include "energy/attribution/busy_timeline.h"
#include "energy/sampling/trace.h"
#include "energy/sources/power_source.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// A figure and the half-width of its 95 % confidence interval.
struct Uncertain {
  double value = 0.0;
  double half_width = 0.0;
  /// The part of it that is not the sensor's gain: for ratios of figures of one sensor.
  double statistical = 0.0;

  friend bool operator==(const Uncertain&, const Uncertain&) = default;
};

/// A stretch of time of which something is known: idle, or measured operations.
struct Window {
  Seconds from;
  Seconds to;
};

/// What attribution is told.
struct AttributionInput {
  const SourceInfo* source = nullptr;
  TraceView trace;
  const BusyTimeline* busy = nullptr;
  std::vector<Window> measured;  ///< operations ran in these
  std::vector<Window> mixed;     ///< blocks whose phase mix was varied on purpose; may be empty
  std::vector<Window> idle;      ///< nothing ran in these
  /// The thesis' way with gauges: the mean of all updates, idle windows included, but those below
  /// this. Biased (docs/measuring.md); `notes` tell the settled mean beside it.
  std::optional<Watts> cut_below = std::nullopt;
};

/// How a phase's energy was found.
enum class AttributionMethod {
  whole,       ///< only one phase ran: the window's energy is its energy
  windows,     ///< its spans are long against the sensor's period: read at their edges
  regression,  ///< fitted over varied mixes of phases
  none,        ///< cannot be told apart
};
std::string_view to_string(AttributionMethod method);

/// The energy of one phase, all of `measured` together. Gross: everything the source saw while the
/// phase ran. Net: above the idle baseline.
struct PhaseEnergy {
  std::string column;
  Seconds busy;        ///< in the measured windows
  double count = 0.0;  ///< operations in them
  AttributionMethod method = AttributionMethod::none;
  std::optional<Uncertain> watts;  ///< while the phase ran, gross
  std::optional<Uncertain> gross;  ///< joules
  std::optional<Uncertain> net;    ///< joules; needs an idle baseline
  /// The fit stopped at 0: the phase costs at most `net->value + net->half_width` net joules.
  bool upper_bound_only = false;
  std::string reason;  ///< why there is no number, or what weakens it; one sentence
};

/// The idle baseline: mean power while nothing ran.
struct IdleBaseline {
  Uncertain watts;
  Seconds length;                  ///< of the idle windows together
  Seconds measured_at;             ///< middle of the windows, on the session's clock
  std::optional<Uncertain> drift;  ///< watts, second half of the windows minus first (post - pre)
  bool drifted = false;            ///< the difference is larger than chance explains
};

/// The energy of a configuration by one source.
struct Attribution {
  std::optional<Uncertain> watts;  ///< mean gross power over the measured windows
  std::optional<Uncertain> gross;  ///< joules of the measured windows, from start to end
  std::optional<Uncertain> net;    ///< joules above idle
  std::optional<IdleBaseline> idle;
  /// Joules an operation, gross. `gross` is about the operations that were measured; this
  /// interval is about those to come: it holds the load's own fluctuation, too.
  std::optional<Uncertain> per_operation;
  double operations = 0.0;          ///< in the measured windows
  Seconds length;                   ///< of the measured windows
  std::vector<PhaseEnergy> phases;  ///< those that ran, in the columns' order
  /// What is left after idle and phases: gross - (idle watts * length + sum of net phases), or with
  /// method windows the energy between the phases. Phases and remainder sum to the total.
  std::optional<Uncertain> remainder;
  std::optional<double> condition;  ///< of the regression, columns scaled
  double effective_samples = 0.0;   ///< independent updates that the watts rest on
  std::vector<std::string> notes;   ///< one sentence each: drift, gaps, quantisation, overlap
};

/// Attributes what `source` saw to the phases (docs/measuring.md explains the methods and gates;
/// energy/attribution/*.h hold their parts). Never gives a number that the data cannot carry:
/// fields stay empty and `notes`/`reason` say why.
Attribution attribute(const AttributionInput& input);

/// The sum over sources that see different hardware (sources/choose_total.h): values add,
/// half-widths in quadrature with what is common. All inputs cover the same windows and columns.
Attribution add(const std::vector<Attribution>& parts);

}  // namespace encore::energy
