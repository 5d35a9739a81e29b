#pragma once

#include <array>
#include <optional>

namespace encore::ui {

/// A rectangle of the window in pixels, from its top left.
struct Rect {
  float x = 0.0F;
  float y = 0.0F;
  float width = 0.0F;
  float height = 0.0F;

  [[nodiscard]] float right() const { return x + width; }
  [[nodiscard]] float bottom() const { return y + height; }
  [[nodiscard]] bool empty() const { return width <= 0.0F || height <= 0.0F; }
  friend bool operator==(const Rect&, const Rect&) = default;
};

/// What the user has set of the window's division: kept from run to run.
struct LayoutSettings {
  bool left = true;          ///< the settings' column
  bool right = true;         ///< the structure's column
  bool plots = true;         ///< the plots below all of these
  float left_width = 18.0F;  ///< in widths of the font's em
  float right_width = 19.0F;
  float plots_share = 0.36F;  ///< of the height below the menu
  float plot_split = 0.5F;    ///< between bars and error
  float pane_split = 0.5F;

  friend bool operator==(const LayoutSettings&, const LayoutSettings&) = default;
};

/// What is to be laid out besides.
struct LayoutInput {
  float width = 0.0F;
  float height = 0.0F;
  float em = 16.0F;  ///< font size in pixels
  float menu_height = 0.0F;
  float status_height = 0.0F;
  int panes = 2;  ///< those that are on, and the 3D view
};

/// Where everything goes. Parts never overlap and lie inside the window. What there is no room for
/// is empty: first the right column goes, then the left one, then the plots; the panes stay.
struct Layout {
  Rect menu;
  Rect left;
  Rect right;
  std::array<Rect, 3> panes;  ///< as many as asked for
  Rect power;                 ///< the discharge rate
  Rect bars;
  Rect error;
  Rect status;
  /// The gaps that can be dragged, over the parts' edges.
  Rect left_splitter;
  Rect right_splitter;
  Rect plots_splitter;
  Rect plot_splitter;
  Rect pane_splitter;
};
Layout make_layout(const LayoutSettings& settings, const LayoutInput& input);

/// Where a picture of width x height is shown in `area`: as large as fits, in its own shape, in the
/// middle, on whole pixels. Empty for no picture or no area.
Rect fit_picture(const Rect& area, int width, int height);

}  // namespace encore::ui
