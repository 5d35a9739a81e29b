#include "ui/plot/strip_draw.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::ui {

namespace {

constexpr int kMostLanes = 8;
constexpr float kWide = 3.0F;    // pixels: narrower spans stand without ground between them
constexpr float kWashed = 2.0F;  // font sizes: narrower spans would make stripes of the area

float lane_height() {
  return 0.85F * em();
}

PlotRect lane_rect(const PlotRect& area, int lane) {
  const float top = area.y1 + 0.25F * em() + lane_height() * static_cast<float>(lane);
  return {area.x0, top, area.x1, top + lane_height() - 1.0F};
}

}  // namespace

int lane_count(const std::vector<StripSpan>& spans) {
  int lanes = 0;
  for (const StripSpan& span : spans) lanes = std::max(lanes, span.lane + 1);
  return std::min(lanes, kMostLanes);
}

float lanes_height(int lanes) {
  return lanes == 0 ? 0.0F : 0.25F * em() + lane_height() * static_cast<float>(lanes);
}

void draw_spans(ImDrawList& list, const PlotRect& area, const std::vector<StripSpan>& spans,
                const Axis& x) {
  // Where a pixel of a lane is taken, further spans in it would not be seen.
  std::array<float, kMostLanes> taken;
  taken.fill(area.x0 - 1.0F);
  for (const StripSpan& span : spans) {
    if (span.t0 > x.high) break;
    if (span.t1 < x.low || span.lane < 0 || span.lane >= kMostLanes) continue;
    const float left = std::max(pixel_x(x, area, span.t0), area.x0);
    const float right = std::min(std::max(pixel_x(x, area, span.t1), left + 1.0F), area.x1);
    float& end = taken.at(static_cast<std::size_t>(span.lane));
    if (right < end + 1.0F) continue;
    end = right;
    const PlotRect lane = lane_rect(area, span.lane);
    const bool wide = right - left >= kWide;
    // A pixel of ground between wide neighbours tells two spans from one.
    list.AddRectFilled({left, lane.y0}, {wide ? right - 1.0F : right, lane.y1},
                       plot_color(span.color, 0.85F), wide ? 0.15F * em() : 0.0F);
    if (!wide) continue;
    if (right - left >= kWashed * em()) {
      list.AddRectFilled({left, area.y0}, {right, area.y1}, plot_color(span.color, 0.06F));
    }
    const float size = text_width(span.name);
    if (size + 0.5F * em() > right - left) continue;
    const std::uint32_t ink = dark_style() ? IM_COL32(0, 0, 0, 220) : IM_COL32(255, 255, 255, 240);
    const float small = 0.8F * em();
    list.AddText(ImGui::GetFont(), small,
                 {std::round(0.5F * (left + right) - 0.4F * size), std::round(lane.y0)}, ink,
                 span.name.data(), span.name.data() + span.name.size());
  }
}

const StripSpan* span_at(const PlotRect& area, const std::vector<StripSpan>& spans, const Axis& x,
                         float mouse_x, float mouse_y) {
  const StripSpan* best = nullptr;
  if (mouse_x < area.x0 || mouse_x >= area.x1) return best;
  float nearest = 2.0F;  // pixels
  for (const StripSpan& span : spans) {
    if (span.t0 > x.high) break;
    if (span.lane < 0 || span.lane >= kMostLanes) continue;
    const PlotRect lane = lane_rect(area, span.lane);
    if (mouse_y < lane.y0 || mouse_y > lane.y1 + 1.0F) continue;
    const float away =
        std::max({pixel_x(x, area, span.t0) - mouse_x, mouse_x - pixel_x(x, area, span.t1), 0.0F});
    if (away < nearest) {
      nearest = away;
      best = &span;
    }
  }
  return best;
}

void draw_flags(ImDrawList& list, const PlotRect& area, const std::vector<StripFlag>& flags,
                const Axis& x) {
  constexpr std::size_t kRows = 3;
  std::array<float, kRows> taken;
  taken.fill(area.x0 - 1.0F);
  float last = area.x0 - 2.0F;
  for (const StripFlag& flag : flags) {
    if (flag.time_s < x.low || flag.time_s > x.high) continue;
    const float at = std::round(pixel_x(x, area, flag.time_s));
    if (std::abs(at - last) < 1.0F) continue;
    last = at;
    list.AddLine({at, area.y0}, {at, area.y1}, accent_color(0.65F));
    list.AddTriangleFilled({at, area.y0}, {at + 0.45F * em(), area.y0 + 0.25F * em()},
                           {at, area.y0 + 0.5F * em()}, accent_color());
    // The text goes to the first row with room; without one, only the line stays.
    const float left = at + 0.55F * em();
    for (std::size_t row = 0; row < kRows; ++row) {
      if (left <= taken.at(row)) continue;
      draw_text(list, left, area.y0 + 1.1F * em() * static_cast<float>(row), text_color(0.85F),
                flag.text);
      taken.at(row) = left + text_width(flag.text) + 0.4F * em();
      break;
    }
  }
}

void draw_selection(ImDrawList& list, const PlotRect& area, const AxisRange& range, const Axis& x) {
  const float left = std::clamp(pixel_x(x, area, range.from), area.x0, area.x1);
  const float right = std::clamp(pixel_x(x, area, range.to), area.x0, area.x1);
  list.AddRectFilled({left, area.y0}, {right, area.y1}, ImGui::GetColorU32(ImGuiCol_Text, 0.10F));
  list.AddLine({left, area.y0}, {left, area.y1}, text_color(0.6F));
  list.AddLine({right, area.y0}, {right, area.y1}, text_color(0.6F));
}

}  // namespace encore::ui
