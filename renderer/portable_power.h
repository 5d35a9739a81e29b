#pragma once

namespace encore::renderer {

/// base ^ exponent for base >= 0 and a finite exponent, from IEEE basic operations only: the C
/// library's own pow differs in the last bit from machine to machine, pictures must not. Relative
/// error below 1e-12 for results in the normal range; beyond, infinity above and 0 or a subnormal
/// number below. A base >= 0 to the power 0 is 1, also 0; a negative or NaN base gives NaN.
double portable_power(double base, double exponent);

}  // namespace encore::renderer
