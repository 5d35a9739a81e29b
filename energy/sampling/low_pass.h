#pragma once

namespace encore::energy {

/// A first-order low pass, tau y' = u - y, as gauges smooth what they show: `shown` before the step
/// gives what is shown after it. Exact for the stated input, so stable at every ratio of `dt` to
/// `tau` and free of cancellation at both ends; the result lies within the range of `shown` and the
/// inputs. tau = 0 shows the input at once; dt <= 0 changes nothing. Same unit for dt and tau.
///
/// The input is constant over the step.
double low_pass_step(double shown, double input, double dt, double tau);
/// The input goes in a straight line from `from` to `to` over the step.
double low_pass_ramp(double shown, double from, double to, double dt, double tau);

}  // namespace encore::energy
