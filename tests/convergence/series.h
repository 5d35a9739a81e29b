#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace encore::energy::test {

/// A stationary AR(1) series of mean 0 and variance 1: neighbours correlate by phi, and
/// (1 + phi) / (1 - phi) values are worth one independent one.
class Ar1 {
 public:
  Ar1(double phi, unsigned seed) : phi_(phi), random_(seed), value_(normal_(random_)) {}

  double next() {
    const double now = value_;
    value_ = phi_ * value_ + std::sqrt(1.0 - phi_ * phi_) * normal_(random_);
    return now;
  }
  std::vector<double> take(std::size_t count) {
    std::vector<double> values(count);
    for (double& value : values) value = next();
    return values;
  }
  [[nodiscard]] double inflation() const { return (1.0 + phi_) / (1.0 - phi_); }

 private:
  double phi_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double value_;
};

}  // namespace encore::energy::test
