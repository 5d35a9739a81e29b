#pragma once

#include "energy/statistics.h"
#include "energy/units.h"

#include <optional>

namespace encore::energy {

/// What a short measurement tells about how long a good one must be.
struct Pilot {
  Seconds spacing;           ///< between its samples: a sensor's update period, or a row's time
  double relative_sd = 0.0;  ///< of its samples, by their mean
  double inflation = 1.0;    ///< how many samples are worth one independent one
  Seconds edge;              ///< period by which a window's two ends are unsure; 0: none
  double floor = 0.0;        ///< relative standard deviation that no length lowers
  Seconds settle;            ///< dropped at the start
};

/// A pilot from samples that took `length` together; nothing without two samples and a mean.
std::optional<Pilot> pilot_of(const Estimate& estimate, Seconds length);

/// Relative standard deviation of an energy whose window's ends are each unsure by one update
/// period, Tu / (T sqrt(6)): the difference of two uniform errors is triangular.
double edge_error(Seconds update_period, Seconds window);
/// The window that brings edge_error() down to `relative`: 41 update periods for 1 %.
Seconds edge_bound(Seconds update_period, double relative);

/// How long to measure until the half-width of the 95 % interval is `target` of the mean: with
/// scatter alone T = spacing * inflation * (1.96 relative_sd / target)^2, the edges' 1.96
/// edge_error(T) and the floor added in quadrature, and the settling time. Infinite if the floor is
/// too high.
Seconds required_time(const Pilot& pilot, double target);
/// The half-width that is to be expected after `window` (the settling time included), relative.
double expected_half_width(const Pilot& pilot, Seconds window);

}  // namespace encore::energy
