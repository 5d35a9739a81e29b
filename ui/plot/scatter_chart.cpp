#include "ui/plot/scatter_chart.h"

#include "ui/plot/plot_draw.h"
#include "ui/plot/plot_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

struct Placed {
  ScatterHit hit;
  ImVec2 at;
};

Axis log_axis(const std::string& unit) {
  return {.scale = Scale::log10,
          .low = 0.1,
          .high = 100.0,
          .unit = unit,
          .least = 1e-12,
          .most = 1e12,
          .narrowest = 0.05};
}

void fit_axes(const ScatterData& data, ScatterState& state) {
  std::optional<double> x0, x1, y0, y1;
  const auto take = [](std::optional<double>& low, std::optional<double>& high, double value) {
    low = std::min(low.value_or(value), value);
    high = std::max(high.value_or(value), value);
  };
  for (const ScatterSeries& series : data.series) {
    if (state.hidden.contains(series.name)) continue;
    for (const ScatterPoint& point : series.points) {
      if (!drawable(point, data)) continue;
      take(x0, x1, point.x);
      take(y0, y1, shown_error(point, data));
    }
  }
  if (!x0) return;
  if (data.floor && *data.floor > 0.0) take(y0, y1, *data.floor);
  fit(state.x, *x0, *x1, 0.08);
  fit(state.y, *y0, *y1, 0.1);
}

void draw_mark(ImDrawList& list, ImVec2 at, const ScatterSeries& series, float radius) {
  const std::uint32_t color = plot_color(series.color);
  switch (series.mark) {
    case ScatterSeries::Mark::disc:
      list.AddCircleFilled(at, radius, color, 16);
      break;
    case ScatterSeries::Mark::ring:
      list.AddCircleFilled(at, radius, ground_color(), 16);
      list.AddCircle(at, radius, color, 16, std::max(1.5F, 0.4F * radius));
      break;
    case ScatterSeries::Mark::square:
      list.AddRectFilled({at.x - 0.9F * radius, at.y - 0.9F * radius},
                         {at.x + 0.9F * radius, at.y + 0.9F * radius}, color);
      break;
  }
}

void draw_floor(ImDrawList& list, const PlotRect& area, const ScatterData& data, const Axis& y) {
  if (!data.floor || *data.floor <= 0.0) return;
  const float at = pixel_y(y, area, *data.floor);
  dashed_line(list, {area.x0, at}, {area.x1, at}, text_color(0.55F), std::max(1.0F, 0.08F * em()));
  if (at < area.y0 || at > area.y1) return;
  const bool below = at + 1.3F * em() < area.y1;
  draw_text(list, area.x0 + 0.5F * em(), below ? at + 0.15F * em() : at - 1.2F * em(),
            text_color(0.7F), data.floor_label);
}

ImVec2 place(const ScatterPoint& point, const ScatterData& data, const ScatterState& state,
             const PlotRect& area) {
  return {pixel_x(state.x, area, point.x), pixel_y(state.y, area, shown_error(point, data))};
}

/// From point to point, as steps: what costs less than the next is no better than the last.
void draw_front(ImDrawList& list, const PlotRect& area, const ScatterData& data,
                const ScatterState& state) {
  std::vector<ImVec2> corners;
  for (const ScatterHit& hit : front_of(data, state)) {
    const ImVec2 at = place(data.series[hit.series].points[hit.point], data, state, area);
    if (!corners.empty()) corners.push_back({at.x, corners.back().y});
    corners.push_back(at);
  }
  polyline(list, corners, text_color(0.6F), std::max(1.2F, 0.1F * em()));
}

std::vector<LegendEntry> legend_of(const ScatterData& data, const ScatterState& state) {
  std::vector<LegendEntry> entries;
  for (const ScatterSeries& series : data.series) {
    LegendEntry entry;
    entry.name = series.name;
    entry.color = plot_color(series.color);
    entry.hidden = state.hidden.contains(series.name);
    entry.tooltip = fmt::format("{} points; a click hides or shows them", series.points.size());
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<Placed> draw_points(ImDrawList& list, const PlotRect& area, const ScatterData& data,
                                const ScatterState& state) {
  std::vector<Placed> placed;
  const float radius = std::max(3.0F, 0.27F * em());
  for (std::size_t s = 0; s < data.series.size(); ++s) {
    const ScatterSeries& series = data.series[s];
    if (state.hidden.contains(series.name)) continue;
    for (std::size_t p = 0; p < series.points.size(); ++p) {
      if (!drawable(series.points[p], data)) continue;
      const ImVec2 at = place(series.points[p], data, state, area);
      draw_mark(list, at, series, series.points[p].front ? 1.25F * radius : radius);
      placed.push_back({{s, p}, at});
    }
  }
  return placed;
}

std::optional<Placed> nearest(const std::vector<Placed>& placed, float x, float y) {
  std::optional<Placed> best;
  float least = em() * em();
  for (const Placed& one : placed) {
    const float dx = one.at.x - x;
    const float dy = one.at.y - y;
    if (dx * dx + dy * dy > least) continue;
    least = dx * dx + dy * dy;
    best = one;
  }
  return best;
}

std::optional<ScatterHit> draw_inside(ImDrawList& list, const PlotRect& area,
                                      const ScatterData& data, const ScatterState& state,
                                      const PlotInput& input, std::string_view reason) {
  list.PushClipRect({area.x0, area.y0}, {area.x1, area.y1}, true);
  if (input.dragging) draw_note(list, area.x0 + em(), area.y0, "zoom to this range", 0.0F);
  draw_floor(list, area, data, state.y);
  draw_front(list, area, data, state);
  const std::vector<Placed> placed = draw_points(list, area, data, state);
  if (placed.empty()) draw_reason(list, area, reason);
  std::optional<Placed> under;
  if (input.hovered) under = nearest(placed, input.mouse_x, input.mouse_y);
  if (under) list.AddCircle(under->at, 0.5F * em(), text_color(), 16, 1.5F);
  list.PopClipRect();
  if (!under) return std::nullopt;
  return under->hit;
}

}  // namespace

double shown_error(const ScatterPoint& point, const ScatterData& data) {
  return std::max(point.y, data.floor.value_or(0.0));
}

bool drawable(const ScatterPoint& point, const ScatterData& data) {
  const double y = shown_error(point, data);
  return std::isfinite(point.x) && point.x > 0.0 && std::isfinite(y) && y > 0.0;
}

std::vector<ScatterHit> front_of(const ScatterData& data, const ScatterState& state) {
  std::vector<ScatterHit> front;
  for (std::size_t s = 0; s < data.series.size(); ++s) {
    if (state.hidden.contains(data.series[s].name)) continue;
    for (std::size_t p = 0; p < data.series[s].points.size(); ++p) {
      const ScatterPoint& point = data.series[s].points[p];
      if (point.front && drawable(point, data)) front.push_back({s, p});
    }
  }
  const auto cost = [&](const ScatterHit& hit) {
    return data.series[hit.series].points[hit.point].x;
  };
  std::stable_sort(front.begin(), front.end(),
                   [&](const ScatterHit& a, const ScatterHit& b) { return cost(a) < cost(b); });
  return front;
}

std::optional<ScatterHit> scatter_chart(std::string_view name, const ScatterData& data,
                                        ScatterState& state, ImVec2 size, std::string_view reason) {
  std::optional<ScatterHit> under;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 whole{size.x > 0.0F ? size.x : room.x, size.y > 0.0F ? size.y : room.y};
  ImGui::PushID(name.data(), name.data() + name.size());
  if (const auto clicked = draw_legend(name, legend_of(data, state), whole.x, 2)) {
    const std::string& entry = data.series[*clicked].name;
    if (state.hidden.erase(entry) == 0) state.hidden.insert(entry);
  }
  if (state.x.unit != data.x_unit || state.y.unit != data.y_unit) {
    state.x = log_axis(data.x_unit);
    state.y = log_axis(data.y_unit);
    state.fit = true;
  }
  if (state.fit) fit_axes(data, state);
  PlotRect area{start.x, ImGui::GetCursorScreenPos().y + 1.5F * em(),
                start.x + whole.x - 0.5F * em(), start.y + whole.y - x_axis_height()};
  const Ticks y_ticks = axis_ticks(state.y, y_tick_room(area.height()));
  area.x0 += std::max(3.0F * em(), y_axis_width(y_ticks));
  if (area.width() >= 2.0F * em() && area.height() >= 2.0F * em()) {
    const PlotInput input = plot_input(name, area, &state.x, &state.y, state.drag_from);
    follow_input(input, state);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_ground(list, area);
    const bool any = std::any_of(data.series.begin(), data.series.end(),
                                 [](const ScatterSeries& one) { return !one.points.empty(); });
    if (any) {
      draw_x_axis(list, area, state.x, axis_ticks(state.x, x_tick_room(area.width())));
      draw_y_axis(list, area, state.y, axis_ticks(state.y, y_tick_room(area.height())), Side::left);
    }
    under = draw_inside(list, area, data, state, input, reason);
    draw_frame(list, area);
    if (under) {
      ImGui::SetTooltip("%s", data.series[under->series].points[under->point].label.c_str());
    }
  }
  ImGui::SetCursorScreenPos(start);
  ImGui::Dummy(whole);
  ImGui::PopID();
  return under;
}

}  // namespace encore::ui
