#pragma once

namespace encore::energy {

/// What Student's 97.5 % quantile tends to for many degrees of freedom: the normal distribution's.
inline constexpr double kNormal95 = 1.959963984540054;

/// P(T > t) for Student's t distribution with `dof` > 0 degrees of freedom (any real number);
/// relative error below 1e-11 for dof up to 1e6. NaN if dof is not positive or t is NaN.
double student_t_tail(double t, double dof);

/// The t with P(T <= t) = p, for p in (0, 1); +-infinity at 1 and 0, NaN outside.
double student_t_quantile(double p, double dof);

}  // namespace encore::energy
