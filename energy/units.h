#pragma once

#include <compare>

namespace encore::energy {

/// A number with a unit that the compiler checks: only like adds to like.
template <class Unit>
struct Quantity {
  double value = 0.0;

  constexpr Quantity() = default;
  explicit constexpr Quantity(double v) : value(v) {}

  constexpr Quantity& operator+=(Quantity o) {
    value += o.value;
    return *this;
  }
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity(a.value + b.value);
  }
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity(a.value - b.value);
  }
  friend constexpr Quantity operator*(Quantity a, double factor) {
    return Quantity(a.value * factor);
  }
  friend constexpr Quantity operator/(Quantity a, double divisor) {
    return Quantity(a.value / divisor);
  }
  /// The ratio of two like quantities is a plain number.
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
  friend constexpr auto operator<=>(Quantity a, Quantity b) = default;
};

using Seconds = Quantity<struct SecondsUnit>;
using Joules = Quantity<struct JoulesUnit>;
using Watts = Quantity<struct WattsUnit>;

constexpr Joules operator*(Watts power, Seconds time) {
  return Joules(power.value * time.value);
}
constexpr Watts operator/(Joules energy, Seconds time) {
  return Watts(energy.value / time.value);
}

constexpr Joules operator*(Seconds time, Watts power) {
  return power * time;
}
constexpr Seconds operator/(Joules energy, Watts power) {
  return Seconds(energy.value / power.value);
}

constexpr double milliseconds(Seconds time) {
  return time.value * 1e3;
}

}  // namespace encore::energy
