#include "ui/plot/error_chart.h"

#include "ui/plot/plot_draw.h"
#include "ui/plot/plot_input.h"
#include "ui/plot/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace encore::ui {

namespace {

bool has_points(const ErrorSeries& series) {
  return std::any_of(series.points.begin(), series.points.end(), drawable);
}

std::string percent_text(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

/// "1 % after 3 min 20 s", "1 % expected after 2 h".
std::string target_text(const ErrorSeries& series, double target) {
  const auto when = target_time(series, target);
  if (!when) return {};
  return fmt::format("{} {} {}", percent_text(target), when->reached ? "after" : "expected after",
                     duration_text(when->elapsed_s));
}

std::vector<LegendEntry> legend_entries(const ErrorData& data, const ErrorState& state) {
  std::vector<LegendEntry> entries;
  for (const ErrorSeries& series : data.series) {
    LegendEntry entry;
    entry.name = series.name;
    entry.color = plot_color(series.color);
    entry.hidden = state.hidden.contains(series.name);
    entry.provenance = series.provenance;
    entry.tooltip = series.reason;
    if (data.target) entry.value = target_text(series, *data.target);
    entries.push_back(std::move(entry));
  }
  return entries;
}

void draw_target(ImDrawList& list, const PlotRect& area, const ErrorData& data, const Axis& y) {
  if (!data.target || *data.target <= 0.0) return;
  const float at = pixel_y(y, area, 100.0 * *data.target);
  dashed_line(list, {area.x0, at}, {area.x1, at}, accent_color(), std::max(1.2F, 0.1F * em()));
  if (at < area.y0 || at > area.y1) return;
  const std::string text = fmt::format("target {}", percent_text(*data.target));
  draw_text(list, area.x0 + 0.5F * em(), at - 1.2F * em(), accent_color(), text);
}

/// The slope that independent samples give, from the last point back and on.
void draw_reference(ImDrawList& list, const PlotRect& area, const ErrorSeries& series,
                    const Axis& x, const Axis& y) {
  const auto first = reference_error(series, x.low);
  const auto last = reference_error(series, x.high);
  if (!first || !last) return;
  dashed_line(list, {area.x0, pixel_y(y, area, 100.0 * *first)},
              {area.x1, pixel_y(y, area, 100.0 * *last)}, plot_color(series.color, 0.45F), 1.0F);
}

void draw_series(ImDrawList& list, const PlotRect& area, const ErrorSeries& series,
                 const std::vector<PlacedPoint>& placed) {
  const std::uint32_t color = plot_color(series.color);
  std::vector<ImVec2> points;
  points.reserve(placed.size());
  for (const PlacedPoint& point : placed) points.emplace_back(point.x, point.y);
  polyline(list, points, color, std::max(1.3F, 0.11F * em()));
  // Marks where they stand apart; the last point always: it is the figure as it stands.
  const float radius = std::max(2.0F, 0.18F * em());
  const bool apart = static_cast<float>(points.size()) * 4.0F * radius < area.width();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    if (apart || last) list.AddCircleFilled(points[i], last ? 1.4F * radius : radius, color, 12);
  }
}

void tooltip(const ErrorData& data, const ErrorHit& hit) {
  const ErrorSeries& series = data.series[hit.series];
  const ErrorSample& point = series.points[hit.point];
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(series.name.c_str());
  ImGui::TextUnformatted(fmt::format("\xC2\xB1{} after {}",
                                     value_text(100.0 * *point.relative_ci95, "%", 4),
                                     duration_text(point.elapsed_s))
                             .c_str());
  ImGui::TextUnformatted(provenance_text(series.provenance).c_str());
  if (data.target) ImGui::TextUnformatted(target_text(series, *data.target).c_str());
  ImGui::EndTooltip();
}

void apply(const PlotInput& input, ErrorState& state) {
  if (input.x_moved || input.y_moved) state.fit = false;
  if (input.picked) {
    set_range(state.x, input.picked->from, input.picked->to);
    state.fit = false;
  }
  if (input.fit) state.fit = true;
}

void say_reasons(ImDrawList& list, const PlotRect& area, const ErrorData& data,
                 std::string_view reason) {
  std::string text;
  for (const ErrorSeries& series : data.series) {
    if (has_points(series)) return;
    if (!series.reason.empty() && text.find(series.reason) == std::string::npos) {
      text += (text.empty() ? "" : "; ") + series.reason;
    }
  }
  draw_reason(list, area, text.empty() ? reason : text);
}

}  // namespace

ErrorResult error_chart(std::string_view name, const ErrorData& data, ErrorState& state,
                        ImVec2 size, std::string_view reason) {
  ErrorResult result;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 whole{size.x > 0.0F ? size.x : room.x, size.y > 0.0F ? size.y : room.y};
  ImGui::PushID(name.data(), name.data() + name.size());
  if (const auto clicked = draw_legend(name, legend_entries(data, state), whole.x)) {
    const std::string& series = data.series[*clicked].name;
    if (state.hidden.erase(series) == 0) state.hidden.insert(series);
  }
  if (state.fit) fit_errors(data, state.x, state.y);

  PlotRect area{start.x, ImGui::GetCursorScreenPos().y + 1.5F * em(),
                start.x + whole.x - 0.5F * em(), start.y + whole.y - x_axis_height()};
  const Ticks y_ticks = axis_ticks(state.y, y_tick_room(area.height()));
  area.x0 += std::max(3.0F * em(), y_axis_width(y_ticks));
  if (area.width() >= 2.0F * em() && area.height() >= 2.0F * em()) {
    const PlotInput input = plot_input(name, area, &state.x, &state.y, state.drag_from);
    apply(input, state);
    result.hovered = input.hovered;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_ground(list, area);
    draw_x_axis(list, area, state.x, axis_ticks(state.x, x_tick_room(area.width())));
    draw_y_axis(list, area, state.y, axis_ticks(state.y, y_tick_room(area.height())), Side::left);
    list.PushClipRect({area.x0, area.y0}, {area.x1, area.y1}, true);
    if (input.dragging) draw_note(list, area.x0 + em(), area.y0, "zoom to this range", 0.0F);
    std::vector<std::vector<PlacedPoint>> placed;
    for (const ErrorSeries& series : data.series) {
      const bool hidden = state.hidden.contains(series.name);
      placed.push_back(hidden ? std::vector<PlacedPoint>{}
                              : place_errors(series, state.x, state.y, area));
      if (hidden) continue;
      if (state.show_reference) draw_reference(list, area, series, state.x, state.y);
      draw_series(list, area, series, placed.back());
    }
    draw_target(list, area, data, state.y);
    say_reasons(list, area, data, reason);
    if (input.hovered) {
      result.under_mouse = nearest_error(placed, input.mouse_x, input.mouse_y, em());
    }
    if (result.under_mouse) {
      list.AddCircle({result.under_mouse->x, result.under_mouse->y}, 0.4F * em(), text_color(), 16,
                     1.5F);
    }
    list.PopClipRect();
    draw_frame(list, area);
    if (result.under_mouse) tooltip(data, *result.under_mouse);
  }
  ImGui::SetCursorScreenPos(start);
  ImGui::Dummy(whole);
  ImGui::PopID();
  return result;
}

}  // namespace encore::ui
