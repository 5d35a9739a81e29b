#include "ui/plot/strip_chart.h"

#include "ui/plot/strip_draw.h"
#include "ui/plot/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

bool shown(const StripSeries& series, const StripState& state) {
  return series.history != nullptr && !series.history->empty() &&
         !state.hidden.contains(series.name);
}

bool any_samples(const StripData& data) {
  return std::any_of(data.series.begin(), data.series.end(), [](const StripSeries& series) {
    return series.history != nullptr && !series.history->empty();
  });
}

/// First and last time of all samples and spans.
std::optional<AxisRange> whole_time(const StripData& data) {
  std::optional<AxisRange> range;
  const auto take = [&](double from, double to) {
    range = range ? AxisRange{std::min(range->from, from), std::max(range->to, to)}
                  : AxisRange{from, to};
  };
  for (const StripSeries& series : data.series) {
    if (series.history == nullptr || series.history->empty()) continue;
    take(*series.history->first_time(), series.history->latest()->t1);
  }
  for (const StripSpan& span : data.spans) take(span.t0, span.t1);
  return range;
}

/// A live strip that is younger than its window shows no time in which there was nothing: it begins
/// with the first sample, and grows in steps so that the scale stays still in between.
double followed_width(const StripData& data, const StripState& state) {
  const auto range = whole_time(data);
  const double elapsed = *data.now_s - (range ? std::min(range->from, *data.now_s) : 0.0);
  if (!(elapsed < state.window_s)) return state.window_s;
  constexpr double kStep = 10.0;
  constexpr double kAhead = 1.02;  // as follow() leaves room
  return std::min(state.window_s, kStep * std::max(1.0, std::ceil(kAhead * elapsed / kStep)));
}

void place_x(const StripData& data, StripState& state) {
  if (data.now_s && state.follow) {
    const double width = followed_width(data, state);
    follow(state.x, *data.now_s, width);
    const auto range = whole_time(data);
    const double begin = range ? std::min(range->from, *data.now_s) : 0.0;
    if (state.x.low < begin && *data.now_s < begin + width) {
      set_range(state.x, begin, begin + width);
    }
    state.fit_x = false;
  } else if (state.fit_x) {
    const auto range = whole_time(data);
    if (!range) return;
    fit(state.x, range->from, range->to, 0.01);
    state.fit_x = false;
  }
}

/// Fits y to what is in sight, to whole ticks so that it does not tremble while time goes on.
void place_y(const StripData& data, StripState& state, float height) {
  if (!state.fit_y) return;
  std::optional<AxisRange> range;
  const auto take = [&](double value) {
    if (!std::isfinite(value)) return;
    range = range ? AxisRange{std::min(range->from, value), std::max(range->to, value)}
                  : AxisRange{value, value};
  };
  for (const StripSeries& series : data.series) {
    if (!shown(series, state)) continue;
    if (const auto extremes = series.history->extremes(state.x.low, state.x.high)) {
      take((*extremes)[0]);
      take((*extremes)[1]);
    }
    if (series.idle) take(series.idle->value);
  }
  if (!range) return;
  // 0 is shown where that costs little room.
  if (state.from_zero || (range->from > 0.0 && range->from < 0.4 * range->to)) take(0.0);
  Axis fitted = state.y;
  fit(fitted, range->from, range->to, 0.04);
  const double step = axis_ticks(fitted, y_tick_room(height)).step;
  if (step > 0.0 && range->to > range->from) {
    const double low = range->from == 0.0 ? 0.0 : std::floor(fitted.low / step) * step;
    set_range(fitted, low, std::ceil(fitted.high / step) * step);
  }
  state.y = fitted;
}

std::optional<std::size_t> legend(std::string_view name, const StripData& data, StripState& state,
                                  float width) {
  std::vector<LegendEntry> entries;
  for (const StripSeries& series : data.series) {
    if (series.name.empty()) continue;
    LegendEntry entry{.name = series.name,
                      .color = plot_color(series.color),
                      .hidden = state.hidden.contains(series.name),
                      .provenance = series.provenance,
                      .value = {},
                      .tooltip = series.reason};
    if (series.idle) {
      entry.tooltip += (entry.tooltip.empty() ? "" : "\n") + idle_text(series, data.unit) +
                       " (the dashed line, with its 95 % interval)";
    }
    if (series.history != nullptr && data.now_s) {
      if (const auto latest = series.history->latest()) {
        entry.value = value_text(static_cast<double>(latest->last), data.unit);
      }
    }
    entries.push_back(std::move(entry));
  }
  const auto clicked = draw_legend(name, entries, width, 3);
  if (clicked) {
    const std::string& series = data.series[*clicked].name;
    if (state.hidden.erase(series) == 0) state.hidden.insert(series);
  }
  return clicked;
}

/// `shown_s`: how wide the axis was before the mouse moved it.
void apply(const PlotInput& input, const StripData& data, double shown_s, StripState& state,
           StripResult& result) {
  if (input.x_moved) {
    // A zoom at the end of a live strip goes on following, with the new width.
    const bool at_end = data.now_s && *data.now_s <= state.x.high && *data.now_s >= state.x.low;
    const double width = state.x.high - state.x.low;
    const bool zoomed = std::abs(width - shown_s) > 1e-6 * width;
    state.follow = state.follow && at_end && zoomed;
    state.window_s = width;
  }
  if (input.y_moved && !input.x_moved) state.fit_y = false;
  if (input.picked) {
    state.selection = input.picked;
    result.selection_changed = true;
  } else if (input.clicked && state.selection) {
    state.selection.reset();
    result.selection_changed = true;
  }
  if (input.fit) {
    state.fit_x = true;
    state.fit_y = true;
    state.follow = data.now_s.has_value();
    const auto range = whole_time(data);
    if (range && state.follow) state.window_s = std::max(1.0, *data.now_s - range->from);
  }
}

struct Hover {
  const StripSeries* series = nullptr;
  Bucket bucket;
};

void draw_cursor(ImDrawList& list, const PlotRect& area, const std::vector<Hover>& hovers,
                 const StripState& state, float mouse_x) {
  const float at = std::round(mouse_x);
  list.AddLine({at, area.y0}, {at, area.y1}, text_color(0.4F));
  for (const Hover& hover : hovers) {
    const Bucket& bucket = hover.bucket;
    const double value = bucket.count == 1 ? static_cast<double>(bucket.last) : bucket.mean();
    const ImVec2 point{pixel_x(state.x, area, 0.5 * (bucket.t0 + bucket.t1)),
                       pixel_y(state.y, area, value)};
    list.AddCircleFilled(point, 0.28F * em(), plot_color(hover.series->color), 12);
    list.AddCircle(point, 0.28F * em(), text_color(), 12, 1.0F);
  }
}

void cursor_tooltip(const StripData& data, const std::vector<Hover>& hovers, double time) {
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(fmt::format("{:.4f} s", time).c_str());
  for (const Hover& hover : hovers) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float size = 0.7F * em();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.15F * em()},
                                              {at.x + size, at.y + 0.15F * em() + size},
                                              plot_color(hover.series->color));
    ImGui::Dummy({size, em()});
    ImGui::SameLine();
    ImGui::TextUnformatted(fmt::format("{}: {}  at {:.4f} s  ({})", hover.series->name,
                                       bucket_text(hover.bucket, data.unit), hover.bucket.t1,
                                       energy::to_string(hover.series->provenance.origin))
                               .c_str());
  }
  for (const StripSeries& series : data.series) {
    if (series.idle) ImGui::TextUnformatted(idle_text(series, data.unit).c_str());
  }
  ImGui::EndTooltip();
}

/// Why there is nothing to see, one line a series.
void draw_reasons(ImDrawList& list, const PlotRect& area, const StripData& data) {
  std::string text;
  for (const StripSeries& series : data.series) {
    const bool empty = series.history == nullptr || series.history->empty();
    if (!empty) return;
    const std::string& reason = series.reason.empty() ? series.provenance.detail : series.reason;
    if (reason.empty() || text.find(reason) != std::string::npos) continue;
    text += (text.empty() ? "" : "; ") + reason;
  }
  draw_reason(list, area, text.empty() ? "no samples yet" : text);
}

/// All that is inside the area; returns what the mouse can point at.
std::vector<Hover> draw_inside(ImDrawList& list, const PlotRect& area, const StripData& data,
                               StripState& state, std::optional<double> cursor) {
  std::vector<Hover> hovers;
  list.PushClipRect({area.x0, area.y0}, {area.x1, area.y1}, true);
  if (state.selection) draw_selection(list, area, *state.selection, state.x);
  for (const StripSeries& series : data.series) {
    if (!shown(series, state)) continue;
    draw_idle_level(list, area, series, state.y);
    const Drawn drawn = draw_series(list, area, series, state.x, state.y);
    draw_running_mean(list, area, series, state.x, state.y);
    if (!cursor) continue;
    if (const Bucket* bucket = nearest_bucket(drawn, *cursor)) hovers.push_back({&series, *bucket});
  }
  draw_flags(list, area, data.flags, state.x);
  draw_reasons(list, area, data);
  list.PopClipRect();
  return hovers;
}

}  // namespace

StripResult strip_chart(std::string_view name, const StripData& data, StripState& state,
                        ImVec2 size) {
  StripResult result;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 whole{size.x > 0.0F ? size.x : room.x, size.y > 0.0F ? size.y : room.y};
  ImGui::PushID(name.data(), name.data() + name.size());
  result.toggled = legend(name, data, state, whole.x);

  const float below = lanes_height(lane_count(data.spans));
  state.y.unit = data.unit;
  PlotRect area{start.x, ImGui::GetCursorScreenPos().y + 1.5F * em(),
                start.x + whole.x - 0.5F * em(), start.y + whole.y - below - x_axis_height()};
  place_x(data, state);
  place_y(data, state, area.height());
  area.x0 += std::max(3.0F * em(), y_axis_width(axis_ticks(state.y, y_tick_room(area.height()))));
  if (area.width() < 2.0F * em() || area.height() < 2.0F * em()) {
    ImGui::PopID();
    return result;
  }

  const double shown_s = state.x.high - state.x.low;
  const PlotInput input = plot_input(name, area, &state.x, &state.y, state.drag_from);
  apply(input, data, shown_s, state, result);
  result.hovered = input.hovered;
  if (input.hovered) {
    const double share =
        static_cast<double>(input.mouse_x - area.x0) / static_cast<double>(area.width());
    result.cursor_s = axis_value(state.x, share);
  }

  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_ground(list, area);
  draw_spans(list, area, data.spans, state.x);
  draw_x_axis(list, area, state.x, axis_ticks(state.x, x_tick_room(area.width())), below);
  // Without samples there is no scale: numbers on it would look like data.
  if (any_samples(data)) {
    draw_y_axis(list, area, state.y, axis_ticks(state.y, y_tick_room(area.height())), Side::left);
  }
  const auto kept = state.selection;
  if (input.dragging) state.selection = input.dragging;
  const std::vector<Hover> hovers = draw_inside(list, area, data, state, result.cursor_s);
  draw_frame(list, area);
  const bool cursor = input.hovered && !input.dragging;
  if (cursor) draw_cursor(list, area, hovers, state, input.mouse_x);
  draw_statistics(list, area, data, state);
  state.selection = kept;
  if (cursor && !hovers.empty()) cursor_tooltip(data, hovers, *result.cursor_s);
  const bool over_window = ImGui::IsWindowHovered();
  const StripSpan* span = over_window && !input.hovered
                              ? span_at(area, data.spans, state.x, input.mouse_x, input.mouse_y)
                              : nullptr;
  if (span != nullptr) {
    ImGui::SetTooltip("%s", fmt::format("{}: {}\n{}", span->name,
                                        duration_text(span->t1 - span->t0), span->tooltip)
                                .c_str());
  }
  ImGui::SetCursorScreenPos(start);
  ImGui::Dummy(whole);
  ImGui::PopID();
  return result;
}

}  // namespace encore::ui
