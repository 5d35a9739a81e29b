#pragma once

#include "energy/provenance.h"
#include "ui/plot/axis.h"
#include "ui/plot/bar_layout.h"

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace encore::ui {

// What the charts are drawn with. All sizes are in pixels and grow with the font.

/// The font's size: the unit of every length.
float em();
float text_width(std::string_view text);
/// Writes a line with its left end, centre or right end (0, 0.5, 1) at x and its top at y.
void draw_text(ImDrawList& list, float x, float y, std::uint32_t color, std::string_view text,
               float align = 0.0F);
void dashed_line(ImDrawList& list, ImVec2 from, ImVec2 to, std::uint32_t color, float thickness);
/// Slanting lines over a rectangle.
void hatch(ImDrawList& list, const PlotRect& rect, std::uint32_t color);
/// An open line, cut where it would ask for more vertices at once than 16-bit indices can count.
void polyline(ImDrawList& list, std::span<const ImVec2> points, std::uint32_t color,
              float thickness);

float pixel_x(const Axis& axis, const PlotRect& area, double value);
/// Held within a few heights of the area, so that far values stay drawable.
float pixel_y(const Axis& axis, const PlotRect& area, double value);

/// How many labelled ticks an axis of this length has room for.
int x_tick_room(float width);
int y_tick_room(float height);
/// What the labels of a vertical axis need beside the area.
float y_axis_width(const Ticks& ticks);
/// What the labels of a horizontal axis need below the area.
float x_axis_height();
/// Grid, ticks and labels. `below`: from the area's foot to the labels. The units stand at the
/// ends.
void draw_x_axis(ImDrawList& list, const PlotRect& area, const Axis& axis, const Ticks& ticks,
                 float below = 0.0F);
enum class Side : std::uint8_t { left, right };
void draw_y_axis(ImDrawList& list, const PlotRect& area, const Axis& axis, const Ticks& ticks,
                 Side side);
void draw_ground(ImDrawList& list, const PlotRect& area);
void draw_frame(ImDrawList& list, const PlotRect& area);

/// The origin's word in a small frame, filled if measured; returns its width.
float draw_badge(ImDrawList& list, float x, float y, energy::Origin origin);
float badge_width(energy::Origin origin);
/// Lines in the middle of an area, broken to its width.
void draw_reason(ImDrawList& list, const PlotRect& area, std::string_view text);
/// Text in a frame on the style's popup ground, `align` as draw_text; returns the frame.
PlotRect draw_note(ImDrawList& list, float x, float y, std::string_view text, float align);

struct LegendEntry {
  std::string name;
  std::uint32_t color = 0;
  bool hidden = false;
  bool hatched = false;
  enum class Mark : std::uint8_t { box, line, dashes } mark = Mark::box;
  std::optional<energy::Provenance> provenance;
  std::string value;    ///< beside the name
  std::string tooltip;  ///< more lines
};
/// Draws a legend at the cursor within `width`, in as many rows as it needs but no more than
/// `most_rows`: what is left over is named by the tooltip of "+3 more". A name wider than that ends
/// in an ellipsis, with all of it in its tooltip. Returns the entry that was clicked. Widgets are
/// named `<plot>.legend.<name>`.
std::optional<std::size_t> draw_legend(std::string_view plot, std::span<const LegendEntry> entries,
                                       float width, std::size_t most_rows = 100);

/// "measured: RAPL package 0".
std::string provenance_text(const energy::Provenance& provenance);

}  // namespace encore::ui
