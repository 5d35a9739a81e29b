#pragma once

#include "energy/session.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::app {

/// One run's figure and the half-width of its 95 % interval, which does not know how far another
/// run would be off.
struct RunFigure {
  double value = 0.0;  ///< positive
  std::optional<double> half_width;
  std::optional<double> without_gain =
      std::nullopt;  ///< the part of it that is not the gain of a sensor
};

/// What a change comes to, B against A.
enum class Verdict {
  lower,    ///< the interval of the ratio lies below 1
  higher,   ///< above 1
  noise,    ///< it holds 1: no difference that the data can carry
  unknown,  ///< there is no interval
};
std::string_view to_string(Verdict verdict);

/// One figure of a configuration in both sessions.
struct FigureChange {
  double a = 0.0;  ///< geometric mean of the repeats
  double b = 0.0;
  double ratio = 1.0;         ///< b / a
  std::optional<double> low;  ///< 95 % interval of the ratio
  std::optional<double> high;
  Verdict verdict = Verdict::unknown;
  bool regression = false;  ///< the whole interval is above 1 + tolerance
};

/// How far runs of one configuration differ from each other: relative standard deviation, and on
/// how many degrees of freedom it rests (0: no configuration was repeated).
struct RunSpread {
  double deviation = 0.0;
  std::size_t degrees_of_freedom = 0;
};

/// Pools the spread of several groups of repeats, each about its own geometric mean. It takes
/// configurations for equally unsteady in relative terms, since each alone has too few repeats.
RunSpread pool_spread(std::span<const std::vector<RunFigure>> groups);

/// The ratio of B's repeats to A's (one or more each) with its 95 % interval, made of logarithms:
/// log ratio +- the larger of the runs' own half-widths in quadrature (delta method) and
/// t s sqrt(1/n_A + 1/n_B) with the pooled spread between runs. `tolerance`: what B may be higher
/// without being a regression; nothing: none is looked for.
FigureChange change_of(std::span<const RunFigure> a, std::span<const RunFigure> b,
                       const RunSpread& spread, std::optional<double> tolerance);

/// One configuration that both sessions have.
struct ConfigurationChange {
  std::vector<energy::KeyValue> configuration;  ///< its identity
  std::size_t runs_a = 1;
  std::size_t runs_b = 1;
  FigureChange seconds;               ///< an operation
  std::optional<FigureChange> watts;  ///< nothing unless both have it, from the same kind of origin
  std::optional<FigureChange> joules;  ///< an operation, gross
};

struct Comparison {
  std::vector<ConfigurationChange> matched;  ///< in A's order
  std::vector<std::vector<energy::KeyValue>> only_a;
  std::vector<std::vector<energy::KeyValue>> only_b;
  /// One sentence each: what differs besides what was to be compared.
  std::vector<std::string> warnings;
  bool same_sensor = false;
  RunSpread time_spread;

  [[nodiscard]] std::size_t regressions() const;
};

/// Compares two sessions, configuration by configuration (configuration_identity()); repeats of one
/// are taken together. The sensor's gain error is part of the figures' half-widths; it cancels and
/// is taken out if both sessions used the same sensor.
Comparison compare_sessions(const energy::Session& a, const energy::Session& b,
                            std::optional<double> tolerance);

/// What makes two sessions hard to compare: other machine, build, settings, sensor; cut-off runs.
std::vector<std::string> differences_of(const energy::SessionInfo& a, const energy::SessionInfo& b);

/// Whether both sessions' energies come from sources of the same names on the same kind of
/// processor: as much as a session tells (two machines of one kind cannot be told apart).
bool same_sensor(const energy::SessionInfo& a, const energy::SessionInfo& b);

}  // namespace encore::app
