#include "ui/plot/scatter_layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::ui {

namespace {

float x_of(const Axis& axis, const PlotRect& area, double value) {
  return area.x0 + static_cast<float>(axis_position(axis, value)) * area.width();
}

float y_of(const Axis& axis, const PlotRect& area, double percent) {
  // Far outside, pixels lose their meaning before floats do.
  const double position = std::clamp(axis_position(axis, percent), -10.0, 11.0);
  return area.y1 - static_cast<float>(position) * area.height();
}

bool enough(const ErrorSample& point) {
  return !point.samples || *point.samples >= kLeastSamples;
}

}  // namespace

const ErrorSample* last_point(const ErrorSeries& series) {
  return !series.points.empty() && drawable(series.points.back()) ? &series.points.back() : nullptr;
}

bool drawable(const ErrorSample& point) {
  return std::isfinite(point.elapsed_s) && point.elapsed_s > 0.0 && point.relative_ci95 &&
         std::isfinite(*point.relative_ci95) && *point.relative_ci95 > 0.0 && enough(point);
}

Axis elapsed_axis() {
  return {.scale = Scale::log10,
          .low = 0.1,
          .high = 100.0,
          .unit = "s",
          .least = 1e-9,
          .most = 1e9,
          .narrowest = 0.05};
}

Axis error_axis() {
  return {.scale = Scale::log10,
          .low = 0.1,
          .high = 100.0,
          .unit = "%",
          .least = 1e-9,
          .most = 1e9,
          .narrowest = 0.05};
}

void fit_errors(const ErrorData& data, Axis& x, Axis& y) {
  std::optional<double> t0, t1, e0, e1;
  const auto take = [](std::optional<double>& low, std::optional<double>& high, double value) {
    low = std::min(low.value_or(value), value);
    high = std::max(high.value_or(value), value);
  };
  for (const ErrorSeries& series : data.series) {
    for (const ErrorSample& point : series.points) {
      if (!drawable(point)) continue;
      take(t0, t1, point.elapsed_s);
      take(e0, e1, *point.relative_ci95 * 100.0);
    }
  }
  if (data.target && *data.target > 0.0) take(e0, e1, *data.target * 100.0);
  if (t0) fit(x, *t0, *t1, 0.06);
  if (e0) fit(y, *e0, *e1, 0.1);
}

std::vector<PlacedPoint> place_errors(const ErrorSeries& series, const Axis& x, const Axis& y,
                                      const PlotRect& area) {
  std::vector<PlacedPoint> placed;
  std::optional<PlacedPoint> left, right;
  int column = 0;
  std::size_t begin = 0;  // of the column's points
  bool apart = false;     // something is left out before the next one
  const auto thin = [&] {
    // Of a column's points the lowest and the highest stay, in the order of time.
    if (placed.size() - begin <= 2) return;
    const auto higher = [](const PlacedPoint& a, const PlacedPoint& b) { return a.y < b.y; };
    const auto [top, bottom] = std::minmax_element(
        placed.begin() + static_cast<std::ptrdiff_t>(begin), placed.end(), higher);
    PlacedPoint a = *top;
    PlacedPoint b = *bottom;
    if (a.index > b.index) std::swap(a, b);
    a.apart = placed[begin].apart;
    b.apart = false;
    placed.resize(begin);
    placed.push_back(a);
    if (b.index != a.index) placed.push_back(b);
  };
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const ErrorSample& point = series.points[i];
    if (!drawable(point)) {
      apart = true;
      continue;
    }
    const PlacedPoint here{x_of(x, area, point.elapsed_s),
                           y_of(y, area, *point.relative_ci95 * 100.0), i,
                           std::exchange(apart, false)};
    if (here.x < area.x0) {
      left = here;
    } else if (here.x > area.x1) {
      if (!right) right = here;
    } else {
      const int its_column = static_cast<int>(here.x - area.x0);
      if (its_column != column) {
        begin = placed.size();
        column = its_column;
      }
      placed.push_back(here);
      thin();
    }
  }
  if (left) placed.insert(placed.begin(), *left);
  if (right) placed.push_back(*right);
  return placed;
}

std::optional<double> reference_error(const ErrorSeries& series, double elapsed_s) {
  const ErrorSample* last = last_point(series);
  if (last == nullptr || !(elapsed_s > 0.0)) return std::nullopt;
  return *last->relative_ci95 * std::sqrt(last->elapsed_s / elapsed_s);
}

std::optional<TargetTime> target_time(const ErrorSeries& series, double target) {
  const ErrorSample* last = last_point(series);
  if (last == nullptr || !(target > 0.0)) return std::nullopt;
  const double ratio = *last->relative_ci95 / target;
  if (ratio > 1.0) return TargetTime{last->elapsed_s * ratio * ratio, false};
  // Reached: from that point on, every later one is below the target, too.
  const ErrorSample* reached = last;
  for (auto i = series.points.rbegin(); i != series.points.rend(); ++i) {
    if (!drawable(*i)) continue;
    if (*i->relative_ci95 > target) break;
    reached = &*i;
  }
  return TargetTime{reached->elapsed_s, true};
}

std::optional<ErrorHit> nearest_error(const std::vector<std::vector<PlacedPoint>>& placed, float x,
                                      float y, float radius) {
  std::optional<ErrorHit> best;
  float nearest = radius * radius;
  for (std::size_t s = 0; s < placed.size(); ++s) {
    for (const PlacedPoint& point : placed[s]) {
      const float dx = point.x - x;
      const float dy = point.y - y;
      const float squared = dx * dx + dy * dy;
      if (squared > nearest) continue;
      nearest = squared;
      best = ErrorHit{s, point.index, point.x, point.y};
    }
  }
  return best;
}

}  // namespace encore::ui
