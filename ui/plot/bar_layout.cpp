#include "ui/plot/bar_layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace encore::ui {

namespace {

constexpr std::size_t kMostAxes = 2;

/// A number that can be drawn.
std::optional<double> finite(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// How far a bar reaches above and below 0: parts under 0 are stacked downwards.
struct Extent {
  double low = 0.0;
  double high = 0.0;
};

Extent extent_of(const Bar& bar) {
  Extent extent;
  for (const BarPart& part : bar.parts) {
    if (const auto value = finite(part.value)) (*value < 0.0 ? extent.low : extent.high) += *value;
  }
  return extent;
}

/// What a bar's values are multiplied by.
double scale_of(const Bar& bar, BarMode mode, const std::map<std::string, double>& largest) {
  if (mode == BarMode::absolute) return 1.0;
  const Extent own = extent_of(bar);
  const double whole = mode == BarMode::percent_of_bar ? own.high - own.low : largest.at(bar.unit);
  return whole > 0.0 ? 100.0 / whole : 0.0;
}

/// Everything that the axes and the parts are computed from.
struct Frame {
  const BarData& data;
  BarMode mode;
  std::map<std::string, double> largest;  // of each unit
  double top_room = 0.0;                  // share of the height
};

std::vector<std::string> units_of(const BarData& data) {
  std::vector<std::string> units;
  for (const BarGroup& group : data.groups) {
    for (const Bar& bar : group.bars) {
      const bool known = std::find(units.begin(), units.end(), bar.unit) != units.end();
      if (!known && units.size() < kMostAxes) units.push_back(bar.unit);
    }
  }
  return units;
}

Axis axis_for(const Frame& frame, const std::string& unit, bool all_units) {
  double low = 0.0;
  double high = 0.0;
  for (const BarGroup& group : frame.data.groups) {
    for (const Bar& bar : group.bars) {
      if (!all_units && bar.unit != unit) continue;
      const double scale = scale_of(bar, frame.mode, frame.largest);
      const Extent extent = extent_of(bar);
      low = std::min(low, extent.low * scale);
      high = std::max(high, extent.high * scale);
      const auto sum = bar_sum(bar);
      if (frame.mode == BarMode::percent_of_bar || !sum || !sum->half_width) continue;
      // What cannot be less than nothing is not shown to be: its interval ends at 0, and the bars
      // of both units stand on one line.
      if (sum->value < 0.0) low = std::min(low, (sum->value - *sum->half_width) * scale);
      high = std::max(high, (sum->value + *sum->half_width) * scale);
    }
  }
  Axis axis;
  axis.unit = frame.mode == BarMode::absolute ? unit : "%";
  axis.narrowest = 1e-30;
  axis.least = -1e300;
  axis.most = 1e300;
  if (high <= low) high = low + 1.0;
  const double room = (high - low) * frame.top_room / (1.0 - frame.top_room);
  set_range(axis, low < 0.0 ? low - 0.05 * (high - low) : 0.0, high + room);
  return axis;
}

/// Bars of both units stand on one line: what one axis shows below 0, the other shows, too.
void share_zero(std::vector<Axis>& axes) {
  double below = 0.0;
  for (const Axis& axis : axes) {
    if (axis.high > 0.0) below = std::max(below, -axis.low / axis.high);
  }
  for (Axis& axis : axes) {
    if (below > 0.0 && axis.high > 0.0) set_range(axis, -below * axis.high, axis.high);
  }
}

float y_of(const Axis& axis, const PlotRect& area, double value) {
  const double position = std::clamp(axis_position(axis, value), 0.0, 1.0);
  return area.y1 - static_cast<float>(position) * area.height();
}

void place_parts(const Frame& frame, const Axis& axis, const PlacedBar& placed, BarLayout& layout) {
  const Bar& bar = frame.data.groups[placed.group].bars[placed.bar];
  const double scale = scale_of(bar, frame.mode, frame.largest);
  double up = 0.0;
  double down = 0.0;
  for (std::size_t i = 0; i < bar.parts.size(); ++i) {
    const auto value = finite(bar.parts[i].value);
    if (!value) continue;
    double& stack = *value < 0.0 ? down : up;
    const float from = y_of(axis, layout.area, stack * scale);
    stack += *value;
    const float to = y_of(axis, layout.area, stack * scale);
    layout.parts.push_back(
        {{placed.slot.x0, std::min(from, to), placed.slot.x1, std::max(from, to)},
         placed.group,
         placed.bar,
         i});
  }
}

void place_bar(const Frame& frame, PlacedBar placed, BarLayout& layout) {
  const Bar& bar = frame.data.groups[placed.group].bars[placed.bar];
  const auto unit = std::find(layout.units.begin(), layout.units.end(), bar.unit);
  const auto sum = bar_sum(bar);
  placed.available = sum.has_value() && unit != layout.units.end();
  placed.top = layout.area.y1;
  if (placed.available) {
    const auto index = static_cast<std::size_t>(unit - layout.units.begin());
    const Axis& axis = layout.axes[std::min(index, layout.axes.size() - 1)];
    const double scale = scale_of(bar, frame.mode, frame.largest);
    const Extent extent = extent_of(bar);
    placed.top = y_of(axis, layout.area, extent.high * scale);
    if (sum->half_width && frame.mode != BarMode::percent_of_bar) {
      placed.band_low = y_of(axis, layout.area, (sum->value - *sum->half_width) * scale);
      placed.band_high = y_of(axis, layout.area, (sum->value + *sum->half_width) * scale);
    }
    place_parts(frame, axis, placed, layout);
  }
  layout.bars.push_back(placed);
}

/// What groups would have to be wide for their labels.
float label_room(const BarData& data, const BarSizes& sizes, const MeasureText& measure) {
  constexpr std::size_t kMost = 64;  // of very many, the first ones speak for the others
  float widest = 0.0F;
  for (std::size_t i = 0; i < std::min(kMost, data.groups.size()); ++i) {
    widest = std::max(widest, two_line_width(data.groups[i].label, measure));
  }
  return std::min(widest + 0.5F * sizes.gap + 1.0F, sizes.most_group);
}

}  // namespace

std::optional<BarSum> bar_sum(const Bar& bar) {
  BarSum sum;
  double squares = 0.0;
  bool all_banded = true;
  for (const BarPart& part : bar.parts) {
    const auto value = finite(part.value);
    if (!value) {
      ++sum.missing;
      continue;
    }
    sum.value += *value;
    const auto band = finite(part.half_width);
    all_banded = all_banded && band.has_value();
    squares += band.value_or(0.0) * band.value_or(0.0);
  }
  if (sum.missing == bar.parts.size()) return std::nullopt;
  if (bar.half_width) {
    sum.half_width = finite(bar.half_width);
  } else if (all_banded) {
    sum.half_width = std::sqrt(squares);
  }
  return sum;
}

std::optional<Difference> difference(const Bar& a, const Bar& b) {
  const auto first = bar_sum(a);
  const auto second = bar_sum(b);
  if (!first || !second || first->missing + second->missing > 0 || first->value <= 0.0) {
    return std::nullopt;
  }
  const double ratio = second->value / first->value;
  Difference result{100.0 * (ratio - 1.0), std::nullopt};
  if (first->half_width && second->half_width) {
    const double own = *second->half_width / first->value;
    const double other = ratio * *first->half_width / first->value;
    result.half_width = 100.0 * std::hypot(own, other);
  }
  return result;
}

BarLayout layout_bars(const BarData& data, BarMode mode, const PlotRect& area, float scroll,
                      const BarSizes& sizes, const MeasureText& measure) {
  BarLayout layout;
  layout.area = area;
  layout.units = units_of(data);
  const double room = static_cast<double>(sizes.top_room / std::max(area.height(), 1.0F));
  Frame frame{data, mode, {}, std::clamp(room, 0.02, 0.5)};
  std::size_t most_bars = 1;
  for (const BarGroup& group : data.groups) {
    most_bars = std::max(most_bars, group.bars.size());
    for (const Bar& bar : group.bars) {
      const Extent extent = extent_of(bar);
      double& largest = frame.largest[bar.unit];
      largest = std::max(largest, extent.high - extent.low);
    }
  }
  if (data.groups.empty() || area.width() <= 0.0F || area.height() <= 0.0F) return layout;
  const bool percent = mode != BarMode::absolute;
  for (const std::string& unit : layout.units) {
    layout.axes.push_back(axis_for(frame, unit, percent));
    if (percent) break;  // both in %: one axis
  }
  share_zero(layout.axes);

  // All groups are equally wide; the bars share what the gap leaves.
  const auto bars = static_cast<float>(most_bars);
  const auto groups = static_cast<float>(data.groups.size());
  const float least = std::max(
      {sizes.least_group, bars * sizes.least_bar + sizes.gap, label_room(data, sizes, measure)});
  const float group_width = std::max(least, area.width() / groups);
  layout.content_width = group_width * groups;
  layout.scroll = std::clamp(scroll, 0.0F, std::max(0.0F, layout.content_width - area.width()));
  const float bar_width = std::min(sizes.most_bar, (group_width - sizes.gap) / bars);

  for (std::size_t g = 0; g < data.groups.size(); ++g) {
    const float left = area.x0 - layout.scroll + group_width * static_cast<float>(g);
    if (left + group_width <= area.x0 || left >= area.x1) continue;
    const float middle = left + 0.5F * group_width;
    const float first = middle - 0.5F * bar_width * static_cast<float>(data.groups[g].bars.size());
    for (std::size_t b = 0; b < data.groups[g].bars.size(); ++b) {
      // Columns that are scrolled half out of sight are cut at the area's edge.
      const float x0 = std::max(area.x0, first + bar_width * static_cast<float>(b));
      const float x1 = std::min(area.x1, first + bar_width * static_cast<float>(b + 1));
      if (x1 > x0)
        place_bar(frame,
                  {.slot = {x0, area.y0, x1, area.y1},
                   .group = g,
                   .bar = b,
                   .available = false,
                   .top = 0.0F,
                   .band_low = {},
                   .band_high = {}},
                  layout);
    }
    if (middle < area.x0 || middle > area.x1) continue;
    PlacedLabel label =
        fit_label(data.groups[g].label, group_width - 0.5F * sizes.gap, sizes.label_lines, measure);
    label.x = middle;
    label.group = g;
    layout.labels.push_back(std::move(label));
  }
  return layout;
}

std::optional<PlacedPart> bar_at(const BarLayout& layout, const BarData& data, float x, float y) {
  for (const PlacedPart& part : layout.parts) {
    if (part.rect.holds(x, y)) return part;
  }
  for (const PlacedBar& bar : layout.bars) {
    if (!bar.slot.holds(x, y)) continue;
    return PlacedPart{bar.slot, bar.group, bar.bar,
                      data.groups[bar.group].bars[bar.bar].parts.size()};
  }
  return std::nullopt;
}

}  // namespace encore::ui
