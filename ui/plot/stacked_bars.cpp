#include "ui/plot/stacked_bars.h"

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

const Bar& bar_of(const BarData& data, const PlacedBar& placed) {
  return data.groups[placed.group].bars[placed.bar];
}

/// Whether a part is large enough anywhere to be seen; the tooltips have the others, too.
bool seen(const BarPart& part, const Bar& bar) {
  if (!part.value) return false;
  const auto sum = bar_sum(bar);
  return std::abs(*part.value) > 0.002 * std::abs(sum ? sum->value : 0.0);
}

/// One entry a part's name and one a bar's name, if it is told apart by hatching.
std::vector<LegendEntry> legend_entries(const BarData& data) {
  std::vector<LegendEntry> entries;
  const auto known = [&](const std::string& name) {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const LegendEntry& entry) { return entry.name == name; });
  };
  for (const BarGroup& group : data.groups) {
    for (const Bar& bar : group.bars) {
      for (const BarPart& part : bar.parts) {
        if (known(part.name) || !seen(part, bar)) continue;
        LegendEntry entry;
        entry.name = part.name;
        entry.color = plot_color(part.color);
        entries.push_back(std::move(entry));
      }
    }
  }
  for (const BarGroup& group : data.groups) {
    if (group.bars.size() < 2) continue;
    for (const Bar& bar : group.bars) {
      if (bar.name.empty() || known(bar.name)) continue;
      LegendEntry entry;
      entry.name = bar.name;
      entry.color = text_color(0.6F);
      entry.hatched = bar.pale;
      entries.push_back(std::move(entry));
    }
  }
  return entries;
}

void draw_parts(ImDrawList& list, const BarData& data, const BarLayout& layout,
                const std::optional<PlacedPart>& hovered) {
  for (const PlacedPart& placed : layout.parts) {
    const Bar& bar = data.groups[placed.group].bars[placed.bar];
    const BarPart& part = bar.parts[placed.part];
    PlotRect rect = placed.rect;
    rect.x0 += 1.0F;
    rect.x1 -= 1.0F;
    list.AddRectFilled({rect.x0, rect.y0}, {rect.x1, rect.y1}, plot_color(part.color));
    if (bar.pale) hatch(list, rect, ImGui::GetColorU32(ImGuiCol_WindowBg, 0.7F));
    const bool here = hovered && hovered->group == placed.group && hovered->bar == placed.bar &&
                      hovered->part == placed.part;
    // A line of ground between the parts tells them apart without colours, too.
    if (rect.height() > 3.0F) {
      list.AddLine({rect.x0, rect.y0}, {rect.x1, rect.y0}, ImGui::GetColorU32(ImGuiCol_WindowBg));
    }
    if (here) list.AddRect({rect.x0, rect.y0}, {rect.x1, rect.y1}, text_color(), 0.0F, 0, 2.0F);
  }
}

/// An I over the sum: its confidence interval.
void draw_band(ImDrawList& list, const PlacedBar& placed) {
  if (!placed.band_low || !placed.band_high) return;
  const float x = 0.5F * (placed.slot.x0 + placed.slot.x1);
  const float half = std::min(0.3F * em(), 0.3F * placed.slot.width());
  const std::uint32_t color = text_color(0.95F);
  list.AddLine({x, *placed.band_low}, {x, *placed.band_high}, color, 1.5F);
  list.AddLine({x - half, *placed.band_low}, {x + half, *placed.band_low}, color, 1.5F);
  list.AddLine({x - half, *placed.band_high}, {x + half, *placed.band_high}, color, 1.5F);
}

/// What stands in the place of a bar that has no values.
void draw_unavailable(ImDrawList& list, const PlacedBar& placed) {
  const PlotRect& slot = placed.slot;
  const PlotRect box{slot.x0 + 1.0F, slot.y1 - 3.0F * em(), slot.x1 - 1.0F, slot.y1};
  hatch(list, box, text_color(0.2F));
  dashed_line(list, {box.x0, box.y1}, {box.x0, box.y0}, text_color(0.5F), 1.0F);
  dashed_line(list, {box.x0, box.y0}, {box.x1, box.y0}, text_color(0.5F), 1.0F);
  dashed_line(list, {box.x1, box.y0}, {box.x1, box.y1}, text_color(0.5F), 1.0F);
  const float x = 0.5F * (box.x0 + box.x1);
  for (const std::string_view text : {"unavailable", "n/a"}) {
    if (text_width(text) > box.width() + 1.2F * em()) continue;
    draw_text(list, x, box.y0 - 1.2F * em(), text_color(0.7F), text, 0.5F);
    break;
  }
}

/// The sums above the bars, as far as they do not touch.
void draw_sums(ImDrawList& list, const BarData& data, const BarLayout& layout) {
  float free_from = layout.area.x0 - em();
  float last_y = 0.0F;
  for (const PlacedBar& placed : layout.bars) {
    if (!placed.available) continue;
    const Bar& bar = bar_of(data, placed);
    const auto sum = bar_sum(bar);
    const std::string text = (sum->missing > 0 ? ">= " : "") + value_text(sum->value, bar.unit, 3);
    const float x = 0.5F * (placed.slot.x0 + placed.slot.x1);
    const float half = 0.5F * text_width(text);
    const float y = std::min(placed.top, placed.band_high.value_or(placed.top)) - 1.15F * em();
    const bool touches = x - half < free_from && std::abs(y - last_y) < 1.1F * em();
    if (touches || half > placed.slot.width() + 1.5F * em()) continue;
    draw_text(list, x, y, text_color(0.85F), text, 0.5F);
    free_from = x + half + 0.3F * em();
    last_y = y;
  }
}

/// "-12.3 ±0.8 %" above a group whose first two bars share a unit.
void draw_differences(ImDrawList& list, const BarData& data, const BarLayout& layout) {
  for (const PlacedBar& placed : layout.bars) {
    const BarGroup& group = data.groups[placed.group];
    if (placed.bar != 1 || group.bars[0].unit != group.bars[1].unit) continue;
    const auto change = difference(group.bars[0], group.bars[1]);
    if (!change) continue;
    float top = placed.top;
    for (const PlacedBar& other : layout.bars) {
      if (other.group != placed.group) continue;
      top = std::min({top, other.top, other.band_high.value_or(other.top)});
    }
    std::string text = value_text(change->percent, change->half_width, "%");
    if (change->percent > 0.0) text.insert(0, "+");
    // A difference within its interval is grey: it may be none.
    const bool sure = change->half_width && std::abs(change->percent) > *change->half_width;
    draw_text(list, placed.slot.x0, std::max(layout.area.y0, top - 2.3F * em()),
              text_color(sure ? 1.0F : 0.55F), text, 0.5F);
  }
}

void draw_labels(ImDrawList& list, const BarLayout& layout, const BarState& state) {
  for (const PlacedLabel& label : layout.labels) {
    float y = layout.area.y1 + 0.25F * em();
    const bool selected = state.selected && *state.selected == label.group;
    for (const std::string& line : label.lines) {
      draw_text(list, label.x, y, text_color(selected ? 1.0F : 0.85F), line, 0.5F);
      y += 1.1F * em();
    }
  }
}

void draw_scroll_bar(ImDrawList& list, const BarLayout& layout, float y) {
  if (layout.content_width <= layout.area.width() + 0.5F) return;
  const float width = layout.area.width();
  const float share = width / layout.content_width;
  const float left = layout.area.x0 + layout.scroll * share;
  list.AddRectFilled({layout.area.x0, y}, {layout.area.x1, y + 0.25F * em()},
                     ImGui::GetColorU32(ImGuiCol_ScrollbarBg), 0.12F * em());
  list.AddRectFilled({left, y}, {left + width * share, y + 0.25F * em()},
                     ImGui::GetColorU32(ImGuiCol_ScrollbarGrab), 0.12F * em());
}

std::string part_line(const BarPart& part, const std::string& unit, double sum) {
  if (!part.value) {
    return fmt::format("{}: unavailable{}{}", part.name, part.provenance.detail.empty() ? "" : ": ",
                       part.provenance.detail);
  }
  const std::string share = sum > 0.0 ? fmt::format(", {:.1f} %", 100.0 * *part.value / sum) : "";
  return fmt::format("{}: {}{} ({})", part.name, value_text(*part.value, part.half_width, unit),
                     share, provenance_text(part.provenance));
}

void tooltip(const BarData& data, const PlacedPart& at) {
  const BarGroup& group = data.groups[at.group];
  const Bar& bar = group.bars[at.bar];
  const auto sum = bar_sum(bar);
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(group.label.c_str());
  std::string head = sum ? value_text(sum->value, sum->half_width, bar.unit) : "unavailable";
  if (sum && sum->missing > 0) head = "at least " + head;
  ImGui::TextUnformatted(fmt::format("{}: {}", bar.name, head).c_str());
  ImGui::Separator();
  // In the order of the stack: what is on top stands on top.
  for (std::size_t i = bar.parts.size(); i-- > 0;) {
    const std::string line = part_line(bar.parts[i], bar.unit, sum ? sum->value : 0.0);
    ImGui::TextColored(ImGui::GetStyleColorVec4(at.part == i || at.part >= bar.parts.size()
                                                    ? ImGuiCol_Text
                                                    : ImGuiCol_TextDisabled),
                       "%s", line.c_str());
    if (at.part == i && !bar.parts[i].detail.empty()) {
      ImGui::Text("  %s", bar.parts[i].detail.c_str());
    }
  }
  if (group.bars.size() > 1 && at.bar == 1 && group.bars[0].unit == bar.unit) {
    if (const auto change = difference(group.bars[0], bar)) {
      ImGui::Text("against %s: %s", group.bars[0].name.c_str(),
                  value_text(change->percent, change->half_width, "%").c_str());
    }
  }
  ImGui::EndTooltip();
}

/// A label that had to be shortened says all of it under the mouse.
void say_whole_label(const BarData& data, const BarLayout& layout) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsWindowHovered() || mouse.y < layout.area.y1 ||
      mouse.y > layout.area.y1 + 2.6F * em()) {
    return;
  }
  for (const PlacedLabel& label : layout.labels) {
    float half = 0.0F;
    for (const std::string& line : label.lines) half = std::max(half, 0.5F * text_width(line));
    if (!label.shortened || std::abs(mouse.x - label.x) > half) continue;
    ImGui::SetTooltip("%s", data.groups[label.group].label.c_str());
  }
}

bool any_difference(const BarData& data) {
  return std::any_of(data.groups.begin(), data.groups.end(), [](const BarGroup& group) {
    return group.bars.size() > 1 && group.bars[0].unit == group.bars[1].unit;
  });
}

BarSizes sizes_now(const BarData& data, const BarState& state) {
  const bool lines = state.mode != BarMode::percent_of_bar;
  const float values = lines && state.show_values ? 1.4F : 0.5F;
  const float changes = lines && state.show_differences && any_difference(data) ? 1.3F : 0.0F;
  return {.least_bar = 1.1F * em(),
          .most_bar = 3.2F * em(),
          .gap = 1.2F * em(),
          .least_group = 5.0F * em(),
          .most_group = 9.0F * em(),
          .label_lines = 2,
          .top_room = (values + changes) * em()};
}

/// Two lines, or one where all labels are short.
float labels_height(const BarData& data, float width) {
  const float group =
      (width - 7.0F * em()) / static_cast<float>(std::max<std::size_t>(data.groups.size(), 1));
  const bool one = data.groups.size() <= 64 &&
                   std::all_of(data.groups.begin(), data.groups.end(), [&](const BarGroup& each) {
                     return text_width(each.label) < group - em();
                   });
  return (one ? 1.5F : 2.6F) * em();
}

void scroll(const PlotInput& input, BarState& state) {
  if (!input.hovered) return;
  const ImGuiIO& io = ImGui::GetIO();
  state.scroll -= (io.MouseWheel + io.MouseWheelH) * 4.0F * em();
  const bool dragging = ImGui::IsItemActive() && !ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (dragging) state.scroll -= io.MouseDelta.x;
}

void draw_all(ImDrawList& list, const BarData& data, const BarLayout& layout, const BarState& state,
              const std::vector<Ticks>& ticks, const std::optional<PlacedPart>& hovered) {
  const PlotRect& area = layout.area;
  draw_ground(list, area);
  for (std::size_t i = 0; i < layout.axes.size(); ++i) {
    draw_y_axis(list, area, layout.axes[i], ticks[i], i == 0 ? Side::left : Side::right);
  }
  list.PushClipRect({area.x0, area.y0 - 1.2F * em()}, {area.x1, area.y1}, true);
  for (const PlacedBar& placed : layout.bars) {
    if (state.selected && *state.selected == placed.group) {
      list.AddRectFilled({placed.slot.x0 - 0.3F * em(), area.y0},
                         {placed.slot.x1 + 0.3F * em(), area.y1}, text_color(0.07F));
    }
  }
  draw_parts(list, data, layout, hovered);
  for (const PlacedBar& placed : layout.bars) {
    if (placed.available) {
      draw_band(list, placed);
    } else {
      draw_unavailable(list, placed);
    }
  }
  if (state.show_values && state.mode != BarMode::percent_of_bar) draw_sums(list, data, layout);
  if (state.show_differences && state.mode != BarMode::percent_of_bar) {
    draw_differences(list, data, layout);
  }
  list.PopClipRect();
  draw_frame(list, area);
  draw_labels(list, layout, state);
}

}  // namespace

BarResult stacked_bars(std::string_view name, const BarData& data, BarState& state, ImVec2 size,
                       std::string_view reason) {
  BarResult result;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 whole{size.x > 0.0F ? size.x : room.x, size.y > 0.0F ? size.y : room.y};
  ImGui::PushID(name.data(), name.data() + name.size());
  // The chart keeps most of the height.
  draw_legend(name, legend_entries(data), whole.x, whole.y < 16.0F * em() ? 2 : 4);

  const float labels = labels_height(data, whole.x);
  PlotRect area{start.x, ImGui::GetCursorScreenPos().y + 1.5F * em(), start.x + whole.x,
                start.y + whole.y - labels - 0.4F * em()};
  const auto measure = [](std::string_view text) { return text_width(text); };
  // The axes' labels decide how wide the area is, and do not depend on its width.
  BarLayout layout =
      layout_bars(data, state.mode, area, state.scroll, sizes_now(data, state), measure);
  std::vector<Ticks> ticks;
  for (const Axis& axis : layout.axes)
    ticks.push_back(axis_ticks(axis, y_tick_room(area.height())));
  area.x0 += ticks.empty() ? 0.0F : std::max(2.5F * em(), y_axis_width(ticks[0]));
  area.x1 -= ticks.size() > 1 ? std::max(2.5F * em(), y_axis_width(ticks[1])) : 0.5F * em();
  if (area.width() >= 2.0F * em() && area.height() >= 2.0F * em()) {
    std::optional<double> drag_from;
    const PlotInput input = plot_input(name, area, nullptr, nullptr, drag_from);
    result.hovered = input.hovered;
    scroll(input, state);
    layout = layout_bars(data, state.mode, area, state.scroll, sizes_now(data, state), measure);
    state.scroll = layout.scroll;
    if (input.hovered) result.under_mouse = bar_at(layout, data, input.mouse_x, input.mouse_y);
    if (input.hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      const auto before = state.selected;
      state.selected.reset();
      if (result.under_mouse && before != result.under_mouse->group) {
        state.selected = result.under_mouse->group;
      }
      result.selection_changed = state.selected != before;
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_all(list, data, layout, state, ticks, result.under_mouse);
    say_whole_label(data, layout);
    if (data.groups.empty()) draw_reason(list, area, reason);
    draw_scroll_bar(list, layout, start.y + whole.y - 0.3F * em());
    if (result.under_mouse) tooltip(data, *result.under_mouse);
  }
  ImGui::SetCursorScreenPos(start);
  ImGui::Dummy(whole);
  ImGui::PopID();
  return result;
}

}  // namespace encore::ui
