#include "energy/attribution/whitening.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace encore::energy {

namespace {

/// The gains of a Kalman filter over a counter's rows. Its state is the energy at the last edge and
/// the slowly changing power; the edges are what it sees. Differences of neighbours go in, so
/// every stretch's first edge is free: its intercept.
class EdgeFilter {
 public:
  EdgeFilter(const FitRows& rows, const Shade& shade) : rows_(rows), steps_(rows.size()) {
    const auto mean = [](const std::vector<double>& v) {
      return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
    };
    const double length_unit = mean(rows.lengths);
    const double edge_unit = mean(rows.edges_after) / (1.0 - shade.share + 1e-300);
    double ww = 0.0;  // covariance of energy (w) and power (p)
    double wp = 0.0;
    double pp = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows.starts[i]) {
        ww = shade.share < 1.0 ? rows.edges_before[i] / edge_unit : 0.0;
        wp = 0.0;
        pp = shade.swing;
      }
      Step& step = steps_[i];
      const double length = rows.lengths[i] / length_unit;
      step.length = length;
      step.keep = shade.swing > 0.0 ? std::exp(-length / shade.memory) : 0.0;
      pp = step.keep * step.keep * pp + shade.swing * (1.0 - step.keep * step.keep);
      ww += 2.0 * length * step.keep * wp + length * length * pp + shade.share * rows.noise[i];
      wp = step.keep * wp + length * pp;
      const double seen = ww + (shade.share < 1.0 ? rows.edges_after[i] / edge_unit : 0.0);
      step.energy_gain = ww / seen;
      step.power_gain = wp / seen;
      step.scale = 1.0 / std::sqrt(seen);
      pp -= step.power_gain * wp;
      wp -= step.energy_gain * wp;
      ww -= step.energy_gain * ww;
      log_determinant_ += std::log(seen);
    }
  }

  [[nodiscard]] double log_determinant() const { return log_determinant_; }
  /// What is new in each row, in units of its standard deviation.
  [[nodiscard]] std::vector<double> apply(std::span<const double> differences) const {
    std::vector<double> white(differences.size());
    double off = 0.0;  // of the last edge from the energy that the filter believes
    double power = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const Step& step = steps_[i];
      if (rows_.starts[i]) off = power = 0.0;
      power *= step.keep;
      const double news = differences[i] + off - step.length * power;
      off = news * (1.0 - step.energy_gain);
      power += step.power_gain * news;
      white[i] = news * step.scale;
    }
    return white;
  }

 private:
  struct Step {
    double length = 0.0;
    double keep = 0.0;
    double energy_gain = 0.0;
    double power_gain = 0.0;
    double scale = 0.0;
  };
  const FitRows& rows_;
  std::vector<Step> steps_;
  double log_determinant_ = 0.0;
};

/// A gauge's rows less what is left of the error before.
std::vector<double> news(std::span<const double> values, const std::vector<bool>& starts,
                         double left) {
  std::vector<double> white(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    white[i] =
        starts[i] ? values[i] * std::sqrt(1.0 - left * left) : values[i] - left * values[i - 1];
  }
  return white;
}

}  // namespace

White whiten(const FitRows& rows, Colour colour, const Shade& shade) {
  White white;
  const auto all_columns = [&](const auto& filter) {
    for (std::size_t c = 0; c < rows.columns.columns(); ++c) {
      white.columns.add_column(filter(rows.columns.column(c)));
    }
    white.values = filter(rows.values);
  };
  if (colour == Colour::autoregressive) {
    all_columns([&](std::span<const double> v) {
      std::vector<double> fresh = news(v, rows.starts, shade.share);
      for (std::size_t i = 0; i < fresh.size(); ++i) fresh[i] /= std::sqrt(rows.noise[i]);
      return fresh;
    });
    const auto starts = std::count(rows.starts.begin(), rows.starts.end(), true);
    white.log_determinant = -static_cast<double>(starts) * std::log1p(-shade.share * shade.share);
    for (const double noise : rows.noise) white.log_determinant += std::log(noise);
  } else {
    const EdgeFilter filter(rows, shade);
    all_columns([&](std::span<const double> v) { return filter.apply(v); });
    white.log_determinant = filter.log_determinant();
  }
  return white;
}

}  // namespace encore::energy
