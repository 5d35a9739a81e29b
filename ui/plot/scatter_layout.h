#pragma once

#include "energy/provenance.h"
#include "ui/plot/axis.h"
#include "ui/plot/bar_layout.h"
#include "ui/plot/plot_colors.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace encore::ui {

/// How well a figure was known after some time.
struct ErrorSample {
  double elapsed_s = 0.0;
  std::optional<double> relative_ci95;  ///< half-width / mean: 0.01 is 1 %
  std::optional<double> samples{};      ///< independent ones that it rests on; nothing: not known
};

/// An interval that rests on fewer independent samples says next to nothing: of two, the quantile
/// of Student's t is 12.7, and no correlation can be told (energy/convergence/correlation.h takes
/// 8, too). Such points are neither drawn nor extrapolated from.
inline constexpr double kLeastSamples = 8.0;

struct ErrorSeries {
  std::string name;
  std::string group;     ///< what it belongs to; series of one group share a legend entry
  std::string quantity;  ///< what of the group: "time", "energy"
  bool dashed = false;
  PlotColor color = PlotColor::cpu;
  std::vector<ErrorSample> points;  ///< in the order of time
  energy::Provenance provenance;
  std::string reason;  ///< why there are no points
  bool aims = true;    ///< whether ErrorData::target is said of it
};

struct ErrorData {
  std::vector<ErrorSeries> series;
  std::optional<double> target;  ///< where the stop rule ends the run: 0.01 is 1 %
};

/// Whether a point has a place on logarithmic axes and rests on enough samples.
bool drawable(const ErrorSample& point);

/// Sets both axes (s, %) so that all points and the target are seen.
void fit_errors(const ErrorData& data, Axis& x, Axis& y);
/// The axes as fit_errors wants them, not yet fitted.
Axis elapsed_axis();
Axis error_axis();

struct PlacedPoint {
  float x = 0.0F;
  float y = 0.0F;
  std::size_t index = 0;  ///< of the series' points
  bool apart = false;     ///< points between the one before and this one are left out
};

/// One series in `area`, thinned to at most two points (least and largest error) a pixel column;
/// points left and right of the area: one each, so that lines go on to its edge.
std::vector<PlacedPoint> place_errors(const ErrorSeries& series, const Axis& x, const Axis& y,
                                      const PlotRect& area);

/// The error of `series` if it fell as 1/sqrt(t) from its last point on; nothing if that one is not
/// drawable: an older one says nothing of the state now.
std::optional<double> reference_error(const ErrorSeries& series, double elapsed_s);
/// The last point, if it is drawable; null otherwise.
const ErrorSample* last_point(const ErrorSeries& series);
/// When a series reached the target, or by 1/sqrt(t) from its last point will.
struct TargetTime {
  double elapsed_s = 0.0;
  bool reached = false;
};
std::optional<TargetTime> target_time(const ErrorSeries& series, double target);

struct ErrorHit {
  std::size_t series = 0;
  std::size_t point = 0;
  float x = 0.0F;
  float y = 0.0F;
};
/// The nearest point within `radius` pixels.
std::optional<ErrorHit> nearest_error(const std::vector<std::vector<PlacedPoint>>& placed, float x,
                                      float y, float radius);

}  // namespace encore::ui
