#pragma once

namespace encore::scene {

// Sine, cosine and arc cosine from IEEE basic operations only (+ - * / sqrt and exact roundings).
// The C library's own differ in the last bit from machine to machine; whatever shapes geometry
// uses these, so that a procedural or animated scene is the same bit for bit everywhere. (The
// project is compiled with -ffp-contract=off, which this relies on.)

inline constexpr double kPi = 3.14159265358979323846;

/// Sine and cosine of `x` radians. Absolute error below 1e-14 for |x| <= 1e6; beyond, the argument
/// is first reduced by 2 pi rounded to double, so the error grows as |x| * 1e-16. NaN and
/// infinities give NaN.
double portable_sin(double x);
double portable_cos(double x);

/// Sine and cosine of an angle in degrees; exact (0, 1, -1) at multiples of 90.
double portable_sin_degrees(double degrees);
double portable_cos_degrees(double degrees);

/// Arc cosine in [0, pi]; arguments outside [-1, 1] are clamped. Absolute error below 1e-14. NaN
/// gives NaN.
double portable_acos(double x);

}  // namespace encore::scene
