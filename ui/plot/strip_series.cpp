#include "ui/plot/strip_draw.h"
#include "ui/plot/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

constexpr std::size_t kMostBuckets = 4096;

/// Two pixels a bucket: where samples are dense, the line is then a mean that can be followed, and
/// what it hides is in the paler envelope behind it.
std::size_t buckets_for(const PlotRect& area) {
  constexpr float kPixels = 2.0F;
  return static_cast<std::size_t>(
      std::clamp(area.width() / kPixels, 2.0F, static_cast<float>(kMostBuckets)));
}

/// Collects a line and draws it piece by piece.
class Line {
 public:
  Line(ImDrawList& list, std::uint32_t color, float thickness)
      : list_(list), color_(color), thickness_(thickness) {}
  ~Line() { lift(); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void to(float x, float y) { points_.emplace_back(x, y); }
  void lift() {
    polyline(list_, points_, color_, thickness_);
    points_.clear();
  }

 private:
  ImDrawList& list_;
  std::uint32_t color_;
  float thickness_;
  std::vector<ImVec2> points_;
};

/// What of the series lies in sight, with one neighbour on each side for the line to run to.
struct InSight {
  std::optional<Bucket> before;
  std::vector<Bucket> buckets;
  std::optional<Bucket> after;
};

InSight in_sight(const SampleHistory& history, const Axis& x, const PlotRect& area) {
  InSight found;
  found.buckets = history.between(x.low, x.high, buckets_for(area));
  const bool none = found.buckets.empty();
  found.before = history.before(none ? x.low : found.buckets.front().t0);
  found.after = history.after(none ? x.high : found.buckets.back().t1);
  return found;
}

/// A filled column from one value to another, at least a pixel wide and high.
void column(ImDrawList& list, const PlotRect& area, const Axis& x, const Axis& y,
            const Bucket& bucket, float low, float high, std::uint32_t color) {
  const float left = pixel_x(x, area, bucket.gap_before ? bucket.t0 : bucket.from);
  const float right = std::max(pixel_x(x, area, bucket.t1), left + 1.0F);
  const float bottom = pixel_y(y, area, static_cast<double>(low));
  const float top = std::min(pixel_y(y, area, static_cast<double>(high)), bottom - 1.0F);
  list.AddRectFilled({left, top}, {right, bottom}, color);
}

/// The +- band of the buckets, along the line that joins them.
void draw_band(ImDrawList& list, const PlotRect& area, const InSight& sight, Reading reading,
               const Axis& x, const Axis& y, std::uint32_t color) {
  // Without soft edges, which would show as seams between the pieces.
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  const Bucket* previous = sight.before ? &*sight.before : nullptr;
  const auto at = [&](const Bucket& bucket, float value) {
    return ImVec2(pixel_x(x, area, bucket.count > 1 ? 0.5 * (bucket.t0 + bucket.t1) : bucket.t1),
                  pixel_y(y, area, static_cast<double>(value)));
  };
  const auto add = [&](const Bucket& bucket) {
    const bool joined = previous != nullptr && !bucket.gap_before;
    if (!(bucket.low < bucket.min || bucket.high > bucket.max)) {
      // No band here.
    } else if (reading == Reading::point && joined) {
      list.AddQuadFilled(at(*previous, previous->low), at(*previous, previous->high),
                         at(bucket, bucket.high), at(bucket, bucket.low), color);
    } else {
      column(list, area, x, y, bucket, bucket.low, bucket.high, color);
    }
    previous = &bucket;
  };
  for (const Bucket& bucket : sight.buckets) add(bucket);
  if (sight.after) add(*sight.after);
  list.Flags = flags;
}

void draw_line(ImDrawList& list, const PlotRect& area, const InSight& sight, Reading reading,
               const Axis& x, const Axis& y, std::uint32_t color) {
  Line line(list, color, std::max(1.3F, 0.11F * em()));
  const auto point = [&](double time, double value) {
    line.to(pixel_x(x, area, time), pixel_y(y, area, value));
  };
  if (sight.before) point(sight.before->t1, static_cast<double>(sight.before->last));
  const auto add = [&](const Bucket& bucket) {
    if (bucket.gap_before) line.lift();
    if (bucket.count > 1) {
      point(0.5 * (bucket.t0 + bucket.t1), bucket.mean());
      return;
    }
    const auto value = static_cast<double>(bucket.last);
    if (reading == Reading::mean_since && !bucket.gap_before) point(bucket.from, value);
    point(bucket.t1, value);
  };
  for (const Bucket& bucket : sight.buckets) add(bucket);
  if (!sight.after || sight.after->gap_before) return;
  if (reading == Reading::mean_since) {
    add(*sight.after);
  } else {
    point(sight.after->t0, static_cast<double>(sight.after->first));
  }
}

/// Where samples stand apart, each gets a mark: full where the sensor's value is new, hollow where
/// it only repeats the one before.
void draw_marks(ImDrawList& list, const PlotRect& area, const InSight& sight, const Axis& x,
                const Axis& y, std::uint32_t color) {
  const float radius = std::max(2.0F, 0.17F * em());
  const auto room = static_cast<std::size_t>(area.width() / (4.0F * radius));
  const bool apart = sight.buckets.size() <= room;
  for (std::size_t i = 0; i < sight.buckets.size(); ++i) {
    const Bucket& bucket = sight.buckets[i];
    if (bucket.count != 1) continue;
    // Alone between two gaps there is no line to see it by.
    const bool next_apart = i + 1 == sight.buckets.size() || sight.buckets[i + 1].gap_before;
    if (!apart && !(bucket.gap_before && next_apart)) continue;
    const ImVec2 at{pixel_x(x, area, bucket.t0),
                    pixel_y(y, area, static_cast<double>(bucket.last))};
    if (bucket.changed > 0) {
      list.AddCircleFilled(at, radius, color, 10);
    } else {
      list.AddCircleFilled(at, radius, ImGui::GetColorU32(ImGuiCol_WindowBg), 10);
      list.AddCircle(at, radius, color, 10, 1.0F);
    }
  }
}

}  // namespace

Drawn draw_series(ImDrawList& list, const PlotRect& area, const StripSeries& series, const Axis& x,
                  const Axis& y) {
  if (series.history == nullptr || series.history->empty()) return {};
  InSight sight = in_sight(*series.history, x, area);
  const std::uint32_t envelope = plot_color(series.color, 0.28F);
  draw_band(list, area, sight, series.history->reading(), x, y, plot_color(series.color, 0.2F));
  for (const Bucket& bucket : sight.buckets) {
    if (bucket.count > 1 && bucket.max > bucket.min) {
      column(list, area, x, y, bucket, bucket.min, bucket.max, envelope);
    }
  }
  const std::uint32_t color = plot_color(series.color);
  draw_line(list, area, sight, series.history->reading(), x, y, color);
  draw_marks(list, area, sight, x, y, color);
  return std::move(sight.buckets);
}

void draw_idle_level(ImDrawList& list, const PlotRect& area, const StripSeries& series,
                     const Axis& y) {
  if (!series.idle || !std::isfinite(series.idle->value)) return;
  const double value = series.idle->value;
  const double band = series.idle->half_width.value_or(0.0);
  const float middle = pixel_y(y, area, value);
  if (band > 0.0) {
    list.AddRectFilled({area.x0, pixel_y(y, area, value + band)},
                       {area.x1, pixel_y(y, area, value - band)}, plot_color(series.color, 0.16F));
  }
  dashed_line(list, {area.x0, middle}, {area.x1, middle}, plot_color(series.color, 0.9F),
              std::max(1.0F, 0.09F * em()));
}

std::string idle_text(const StripSeries& series, const std::string& unit) {
  return fmt::format("idle {}", value_text(series.idle->value, series.idle->half_width, unit));
}

void draw_running_mean(ImDrawList& list, const PlotRect& area, const StripSeries& series,
                       const Axis& x, const Axis& y) {
  if (series.running_mean == nullptr || series.running_mean->empty()) return;
  const InSight sight = in_sight(*series.running_mean, x, area);
  draw_band(list, area, sight, Reading::point, x, y, plot_color(series.color, 0.2F));
  draw_line(list, area, sight, Reading::point, x, y, text_color(0.75F));
}

const Bucket* nearest_bucket(const Drawn& drawn, double time_s) {
  const Bucket* best = nullptr;
  double nearest = 0.0;
  for (const Bucket& bucket : drawn) {
    const double away = std::max({bucket.t0 - time_s, time_s - bucket.t1, 0.0});
    if (best != nullptr && away >= nearest) continue;
    best = &bucket;
    nearest = away;
  }
  return best;
}

std::string bucket_text(const Bucket& bucket, const std::string& unit) {
  if (bucket.count > 1) {
    return fmt::format("{} .. {}, mean {} ({} samples, {} new)",
                       value_text(static_cast<double>(bucket.min), unit, 5),
                       value_text(static_cast<double>(bucket.max), unit, 5),
                       value_text(bucket.mean(), unit, 5), bucket.count, bucket.changed);
  }
  const auto value = static_cast<double>(bucket.last);
  const double band = static_cast<double>(bucket.high) - value;
  const std::string text = band > 0.0 ? value_text(value, band, unit) : value_text(value, unit, 6);
  return bucket.changed > 0 ? text : text + " (repeated)";
}

}  // namespace encore::ui
