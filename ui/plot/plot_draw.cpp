#include "ui/plot/plot_draw.h"

#include "ui/plot/plot_colors.h"

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

constexpr std::size_t kPointsAtOnce = 4000;  // 4 vertices a point stay below 65,536

const char* begin_of(std::string_view text) {
  return text.data();
}
const char* end_of(std::string_view text) {
  return text.data() + text.size();
}

}  // namespace

float em() {
  return ImGui::GetFontSize();
}

float text_width(std::string_view text) {
  return text.empty() ? 0.0F : ImGui::CalcTextSize(begin_of(text), end_of(text)).x;
}

void draw_text(ImDrawList& list, float x, float y, std::uint32_t color, std::string_view text,
               float align) {
  if (text.empty()) return;
  const float left = x - align * text_width(text);
  // Whole pixels keep letters sharp.
  list.AddText({std::round(left), std::round(y)}, color, begin_of(text), end_of(text));
}

void dashed_line(ImDrawList& list, ImVec2 from, ImVec2 to, std::uint32_t color, float thickness) {
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 0.0F)) return;
  // A line that is far longer than any screen has no more dashes than one that fits.
  const float dash = std::max(0.45F * em(), length / 2000.0F);
  const ImVec2 step{(to.x - from.x) / length, (to.y - from.y) / length};
  for (float at = 0.0F; at < length; at += 2.0F * dash) {
    const float end = std::min(at + dash, length);
    list.AddLine({from.x + step.x * at, from.y + step.y * at},
                 {from.x + step.x * end, from.y + step.y * end}, color, thickness);
  }
}

void hatch(ImDrawList& list, const PlotRect& rect, std::uint32_t color) {
  if (rect.width() <= 0.0F || rect.height() <= 0.0F) return;
  list.PushClipRect({rect.x0, rect.y0}, {rect.x1, rect.y1}, true);
  const float spacing = std::max(0.4F * em(), (rect.width() + rect.height()) / 400.0F);
  // Anchored to the screen, so that the lines of neighbours meet.
  const float first = std::floor((rect.x0 - rect.height()) / spacing) * spacing;
  const float slope_origin = std::fmod(rect.y1, spacing);
  for (float x = first + slope_origin; x < rect.x1 + spacing; x += spacing) {
    list.AddLine({x, rect.y1}, {x + rect.height(), rect.y0}, color, std::max(1.0F, 0.07F * em()));
  }
  list.PopClipRect();
}

void polyline(ImDrawList& list, std::span<const ImVec2> points, std::uint32_t color,
              float thickness) {
  for (std::size_t first = 0; first + 1 < points.size(); first += kPointsAtOnce - 1) {
    const std::size_t count = std::min(kPointsAtOnce, points.size() - first);
    list.AddPolyline(points.data() + first, static_cast<int>(count), color, ImDrawFlags_None,
                     thickness);
  }
}

float pixel_x(const Axis& axis, const PlotRect& area, double value) {
  const double position = std::clamp(axis_position(axis, value), -10.0, 11.0);
  return area.x0 + static_cast<float>(position) * area.width();
}

float pixel_y(const Axis& axis, const PlotRect& area, double value) {
  const double position = std::clamp(axis_position(axis, value), -10.0, 11.0);
  return area.y1 - static_cast<float>(position) * area.height();
}

int x_tick_room(float width) {
  return static_cast<int>(std::clamp(width / (5.0F * em()), 2.0F, 14.0F));
}

int y_tick_room(float height) {
  return static_cast<int>(std::clamp(height / (2.2F * em()), 2.0F, 10.0F));
}

float y_axis_width(const Ticks& ticks) {
  float widest = 0.0F;
  for (const Tick& tick : ticks.ticks) widest = std::max(widest, text_width(tick.label));
  return widest + 0.8F * em();
}

float x_axis_height() {
  return 1.5F * em();
}

void draw_x_axis(ImDrawList& list, const PlotRect& area, const Axis& axis, const Ticks& ticks,
                 float below) {
  const float top = area.y1 + below + 0.3F * em();
  const float unit_width = text_width(ticks.unit);
  draw_text(list, area.x1, top, text_color(0.65F), ticks.unit, 1.0F);
  float free_from = area.x0 - 2.0F * em();
  for (const Tick& tick : ticks.ticks) {
    const float x = std::round(pixel_x(axis, area, tick.value));
    list.AddLine({x, area.y0}, {x, area.y1}, grid_color(tick.major), 1.0F);
    list.AddLine({x, area.y1}, {x, area.y1 + (tick.major ? 0.3F : 0.18F) * em()}, frame_color());
    // A label that would touch its neighbour or the unit is left out.
    const float half = 0.5F * text_width(tick.label);
    if (tick.label.empty() || x - half < free_from) continue;
    if (x + half > area.x1 - unit_width - 0.6F * em()) continue;
    draw_text(list, x, top, text_color(0.9F), tick.label, 0.5F);
    free_from = x + half + 0.6F * em();
  }
}

void draw_y_axis(ImDrawList& list, const PlotRect& area, const Axis& axis, const Ticks& ticks,
                 Side side) {
  const bool left = side == Side::left;
  const float edge = left ? area.x0 : area.x1;
  const float out = left ? -1.0F : 1.0F;
  float free_below = area.y1 + em();
  for (const Tick& tick : ticks.ticks) {
    const float y = std::round(pixel_y(axis, area, tick.value));
    if (left) list.AddLine({area.x0, y}, {area.x1, y}, grid_color(tick.major), 1.0F);
    list.AddLine({edge, y}, {edge + out * (tick.major ? 0.3F : 0.18F) * em(), y}, frame_color());
    if (tick.label.empty() || y + 0.45F * em() > free_below) continue;
    draw_text(list, edge + out * 0.5F * em(), y - 0.5F * em(), text_color(0.9F), tick.label,
              left ? 1.0F : 0.0F);
    free_below = y - 0.55F * em();
  }
  draw_text(list, edge, area.y0 - 1.25F * em(), text_color(0.65F), ticks.unit, left ? 0.0F : 1.0F);
}

void draw_ground(ImDrawList& list, const PlotRect& area) {
  list.AddRectFilled({area.x0, area.y0}, {area.x1, area.y1}, ground_color());
}

void draw_frame(ImDrawList& list, const PlotRect& area) {
  list.AddLine({area.x0, area.y1}, {area.x1, area.y1}, frame_color(), 1.0F);
  list.AddLine({area.x0, area.y0}, {area.x0, area.y1}, frame_color(), 1.0F);
}

void draw_reason(ImDrawList& list, const PlotRect& area, std::string_view text) {
  const float width = std::max(area.width() - 2.0F * em(), 4.0F * em());
  const auto most = static_cast<int>(std::clamp(area.height() / (1.2F * em()), 1.0F, 8.0F));
  const std::vector<std::string> lines =
      fit_label(text, width, most, [](std::string_view part) { return text_width(part); }).lines;
  float y = 0.5F * (area.y0 + area.y1) - 0.6F * em() * static_cast<float>(lines.size());
  for (const std::string& line : lines) {
    draw_text(list, 0.5F * (area.x0 + area.x1), y, text_color(0.7F), line, 0.5F);
    y += 1.2F * em();
  }
}

PlotRect draw_note(ImDrawList& list, float x, float y, std::string_view text, float align) {
  const float width = text_width(text) + 0.6F * em();
  const float left = x - align * width;
  const PlotRect frame{left, y, left + width, y + 1.25F * em()};
  list.AddRectFilled({frame.x0, frame.y0}, {frame.x1, frame.y1},
                     ImGui::GetColorU32(ImGuiCol_PopupBg, 0.85F), 0.25F * em());
  list.AddRect({frame.x0, frame.y0}, {frame.x1, frame.y1}, text_color(0.25F), 0.25F * em());
  draw_text(list, left + 0.3F * em(), y + 0.12F * em(), text_color(), text);
  return frame;
}

}  // namespace encore::ui
