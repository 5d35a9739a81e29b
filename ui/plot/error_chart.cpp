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

/// "2 independent samples: too few for an interval".
std::string few_samples(const ErrorSample& point) {
  if (!point.samples) return "no interval yet";
  return fmt::format("{:.3g} independent samples so far: too few for an interval", *point.samples);
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

bool hidden(const ErrorSeries& series, const ErrorState& state) {
  return state.hidden.contains(series.name) || state.hidden.contains(series.group) ||
         state.hidden.contains(series.quantity);
}

/// What is known of a series now, in a line: "time: 1 % expected after 2 h".
std::string state_text(const ErrorSeries& series, const ErrorData& data) {
  const std::string name = series.quantity.empty() ? "" : series.quantity + ": ";
  if (const ErrorSample* last = last_point(series)) {
    std::string text = name + "\xC2\xB1" + value_text(100.0 * *last->relative_ci95, "%", 3);
    if (data.target && series.aims) text += ", " + target_text(series, *data.target);
    return text;
  }
  if (!series.points.empty()) return name + few_samples(series.points.back());
  return series.reason;
}

LegendEntry quantity_entry(const ErrorSeries& series, const ErrorState& state) {
  LegendEntry entry;
  entry.name = series.quantity;
  entry.color = text_color(0.75F);
  entry.mark = series.dashed ? LegendEntry::Mark::dashes : LegendEntry::Mark::line;
  entry.hidden = state.hidden.contains(series.quantity);
  entry.provenance = series.provenance;
  return entry;
}

/// One entry a group, by its colour, and one a quantity, by its line; series without a group have
/// one of their own.
std::vector<LegendEntry> legend_entries(const ErrorData& data, const ErrorState& state) {
  std::vector<LegendEntry> groups;
  std::vector<LegendEntry> quantities;
  const auto find = [](std::vector<LegendEntry>& entries, const std::string& name) {
    const auto at = std::find_if(entries.begin(), entries.end(),
                                 [&](const LegendEntry& entry) { return entry.name == name; });
    return at == entries.end() ? nullptr : &*at;
  };
  for (const ErrorSeries& series : data.series) {
    const bool grouped = !series.group.empty();
    const std::string& name = grouped ? series.group : series.name;
    LegendEntry* entry = find(groups, name);
    if (entry == nullptr) {
      entry = &groups.emplace_back();
      entry->name = name;
      entry->color = plot_color(series.color);
      entry->hidden = state.hidden.contains(name);
      if (!grouped) entry->provenance = series.provenance;
    }
    const std::string line = state_text(series, data);
    if (!line.empty()) entry->tooltip += (entry->tooltip.empty() ? "" : "\n") + line;
    if (!grouped || series.quantity.empty()) continue;
    LegendEntry* known = find(quantities, series.quantity);
    if (known == nullptr) {
      quantities.push_back(quantity_entry(series, state));
    } else if (known->provenance->origin == energy::Origin::unavailable) {
      known->provenance = series.provenance;
    }
  }
  groups.insert(groups.end(), quantities.begin(), quantities.end());
  return groups;
}

void draw_target(ImDrawList& list, const PlotRect& area, const ErrorData& data, const Axis& y) {
  if (!data.target || *data.target <= 0.0) return;
  const float at = pixel_y(y, area, 100.0 * *data.target);
  dashed_line(list, {area.x0, at}, {area.x1, at}, accent_color(), std::max(1.2F, 0.1F * em()));
  if (at < area.y0 || at > area.y1) return;
  const std::string text = fmt::format("target {}", percent_text(*data.target));
  // Below the line if there is room: what is still measured lies above it.
  const bool below = at + 1.3F * em() < area.y1;
  draw_text(list, area.x0 + 0.5F * em(), below ? at + 0.15F * em() : at - 1.2F * em(),
            accent_color(), text);
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

/// A line in dashes whose length runs on from piece to piece.
void dashed_path(ImDrawList& list, const std::vector<ImVec2>& points, std::uint32_t color,
                 float thickness) {
  const float dash = 0.45F * em();
  float done = 0.0F;  // since the last dash began; gaps are as long
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ImVec2 from = points[i - 1];
    const ImVec2 to = points[i];
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0.0F) || length > 100.0F * dash) {
      list.AddLine(from, to, color, thickness);
      continue;
    }
    const auto at = [&](float along) {
      const float share = along / length;
      return ImVec2{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    };
    for (float along = 0.0F; along < length;) {
      const bool on = done < dash;
      const float step = std::min(length - along, (on ? dash : 1.8F * dash) - done);
      if (on) list.AddLine(at(along), at(along + step), color, thickness);
      along += std::max(step, 0.01F);
      done += std::max(step, 0.01F);
      if (done >= 1.8F * dash) done = 0.0F;
    }
  }
}

void draw_series(ImDrawList& list, const PlotRect& area, const ErrorSeries& series,
                 const std::vector<PlacedPoint>& placed) {
  const std::uint32_t color = plot_color(series.color);
  const float thickness = std::max(1.3F, 0.11F * em());
  std::vector<ImVec2> points;
  const auto lift = [&] {
    if (series.dashed) {
      dashed_path(list, points, color, thickness);
    } else {
      polyline(list, points, color, thickness);
    }
    points.clear();
  };
  for (const PlacedPoint& point : placed) {
    if (point.apart) lift();
    points.emplace_back(point.x, point.y);
  }
  lift();
  // Marks where they stand apart; the last point always: it is the figure as it stands.
  const float radius = std::max(2.0F, 0.16F * em());
  const bool apart = static_cast<float>(placed.size()) * 4.0F * radius < area.width();
  const bool current = last_point(series) != nullptr;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const bool last = current && i + 1 == placed.size();
    if (!apart && !last) continue;
    const ImVec2 at{placed[i].x, placed[i].y};
    const float size = last ? 1.4F * radius : radius;
    if (series.dashed) {
      list.AddCircleFilled(at, size, ImGui::GetColorU32(ImGuiCol_WindowBg), 12);
      list.AddCircle(at, size, color, 12, 1.2F);
    } else {
      list.AddCircleFilled(at, size, color, 12);
    }
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
  if (point.samples) {
    ImGui::TextUnformatted(fmt::format("from {:.3g} independent samples", *point.samples).c_str());
  }
  ImGui::TextUnformatted(provenance_text(series.provenance).c_str());
  if (data.target && series.aims) ImGui::TextUnformatted(target_text(series, *data.target).c_str());
  ImGui::EndTooltip();
}

/// Why there is nothing to see; what all series say is said once.
void say_reasons(ImDrawList& list, const PlotRect& area, const ErrorData& data,
                 std::string_view reason) {
  std::string text;
  for (const ErrorSeries& series : data.series) {
    if (has_points(series)) return;
    const std::string why =
        series.points.empty() ? series.reason : few_samples(series.points.back());
    if (!why.empty() && text.find(why) == std::string::npos) {
      text += (text.empty() ? "" : "; ") + why;
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
  const std::vector<LegendEntry> entries = legend_entries(data, state);
  // The chart keeps at least half of the height.
  const auto rows = static_cast<std::size_t>(
      std::clamp((0.5F * whole.y - 1.5F * em() - x_axis_height()) / (1.4F * em()), 1.0F, 6.0F));
  if (const auto clicked = draw_legend(name, entries, whole.x, rows)) {
    const std::string& entry = entries[*clicked].name;
    if (state.hidden.erase(entry) == 0) state.hidden.insert(entry);
  }
  if (state.fit) fit_errors(data, state.x, state.y);

  PlotRect area{start.x, ImGui::GetCursorScreenPos().y + 1.5F * em(),
                start.x + whole.x - 0.5F * em(), start.y + whole.y - x_axis_height()};
  const Ticks y_ticks = axis_ticks(state.y, y_tick_room(area.height()));
  area.x0 += std::max(3.0F * em(), y_axis_width(y_ticks));
  if (area.width() >= 2.0F * em() && area.height() >= 2.0F * em()) {
    const PlotInput input = plot_input(name, area, &state.x, &state.y, state.drag_from);
    follow_input(input, state);
    result.hovered = input.hovered;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_ground(list, area);
    // Without points there are no scales, and nothing that a target could be held against.
    const bool any = std::any_of(data.series.begin(), data.series.end(), has_points);
    if (any) {
      draw_x_axis(list, area, state.x, axis_ticks(state.x, x_tick_room(area.width())));
      draw_y_axis(list, area, state.y, axis_ticks(state.y, y_tick_room(area.height())), Side::left);
    }
    list.PushClipRect({area.x0, area.y0}, {area.x1, area.y1}, true);
    if (input.dragging) draw_note(list, area.x0 + em(), area.y0, "zoom to this range", 0.0F);
    std::vector<std::vector<PlacedPoint>> placed;
    for (const ErrorSeries& series : data.series) {
      const bool off = hidden(series, state);
      placed.push_back(off ? std::vector<PlacedPoint>{}
                           : place_errors(series, state.x, state.y, area));
      if (off) continue;
      if (state.show_reference) draw_reference(list, area, series, state.x, state.y);
      draw_series(list, area, series, placed.back());
    }
    if (any) draw_target(list, area, data, state.y);
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
