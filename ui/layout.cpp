#include "ui/layout.h"

#include "ui/layout_drag.h"

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

// The least sizes, in ems: narrower, a part's words no longer fit.
constexpr float kLeastColumn = 12.0F;
constexpr float kLeastPane = 12.0F;
constexpr float kLeastPaneHeight = 7.0F;
constexpr float kLeastPlot = 11.0F;
constexpr float kLeastPlotsHeight = 13.0F;
/// Of the plots' width, for the power.
constexpr float kPowerShare = 0.38F;

float whole(float value) {
  return std::isfinite(value) ? std::max(0.0F, std::round(value)) : 0.0F;
}

/// Widths and shares come from files and from arithmetic; none may spoil the rest.
float sane(float value, float low, float high, float otherwise) {
  return std::isfinite(value) ? std::clamp(value, low, std::max(low, high)) : otherwise;
}

float share(float value) {
  return sane(value, 0.02F, 0.98F, 0.5F);
}

struct Sizes {
  float em = 16.0F;
  float gap = 6.0F;  ///< between parts
  [[nodiscard]] float ems(float count) const { return whole(count * em); }
};

Sizes sizes_of(const LayoutInput& input) {
  const float em = sane(input.em, 4.0F, 200.0F, 16.0F);
  return {em, std::max(4.0F, std::round(em * 0.35F))};
}

/// Two parts of `room` beside each other, the first with its share but each with at least `least`
/// where there is room for that.
float first_of_two(float room, float part, float least) {
  const float low = std::min(least, std::floor(room / 2.0F));
  return std::clamp(std::round(room * share(part)), low, std::max(low, room - low));
}

/// Cuts columns from both sides of `middle`; the right one goes first, then the left one.
void place_columns(const LayoutSettings& settings, const Sizes& sizes, int panes, Rect& middle,
                   Layout& layout) {
  const float least = sizes.ems(kLeastColumn) + sizes.gap;
  // Panes can lie one above the other, so two widths are enough for any number.
  const float centre = sizes.ems(kLeastPane) * static_cast<float>(std::min(panes, 2));
  bool left = settings.left;
  bool right = settings.right;
  if (left && right && centre + 2.0F * least > middle.width) right = false;
  if (right && centre + least > middle.width) right = false;
  if (left && centre + least > middle.width) left = false;

  if (left) {
    const float most = middle.width - centre - sizes.gap - (right ? least : 0.0F);
    const float wanted = sizes.ems(sane(settings.left_width, kLeastColumn, 400.0F, 18.0F));
    const float width = std::min(wanted, most);
    layout.left = {middle.x, middle.y, width, middle.height};
    layout.left_splitter = {layout.left.right(), middle.y, sizes.gap, middle.height};
    middle.x += width + sizes.gap;
    middle.width -= width + sizes.gap;
  }
  if (right) {
    const float most = middle.width - centre - sizes.gap;
    const float wanted = sizes.ems(sane(settings.right_width, kLeastColumn, 400.0F, 19.0F));
    const float width = std::min(wanted, most);
    layout.right = {middle.right() - width, middle.y, width, middle.height};
    layout.right_splitter = {layout.right.x - sizes.gap, middle.y, sizes.gap, middle.height};
    middle.width -= width + sizes.gap;
  }
}

/// Power, bars and error beside each other; where it is narrow, the error goes first, then the
/// bars.
void divide_plots(const LayoutSettings& settings, const Sizes& sizes, const Rect& plots,
                  Layout& layout) {
  const float least = sizes.ems(kLeastPlot);
  if (plots.width < 2.0F * least + sizes.gap) {
    layout.power = plots;
    return;
  }
  const bool three = plots.width >= 3.0F * least + 2.0F * sizes.gap;
  const float first = first_of_two(plots.width - sizes.gap, three ? kPowerShare : 0.5F, least);
  layout.power = {plots.x, plots.y, first, plots.height};
  const Rect rest{layout.power.right() + sizes.gap, plots.y, plots.width - first - sizes.gap,
                  plots.height};
  if (!three || rest.width < 2.0F * least + sizes.gap) {
    layout.bars = rest;
    return;
  }
  const float second = first_of_two(rest.width - sizes.gap, settings.plot_split, least);
  layout.bars = {rest.x, rest.y, second, rest.height};
  layout.plot_splitter = {layout.bars.right(), rest.y, sizes.gap, rest.height};
  layout.error = {layout.plot_splitter.right(), rest.y, rest.width - second - sizes.gap,
                  rest.height};
}

/// Cuts the plots from the bottom of `middle`.
void place_plots(const LayoutSettings& settings, const Sizes& sizes, int panes, Rect& middle,
                 Layout& layout) {
  const float least = sizes.ems(kLeastPlotsHeight);
  const float above = panes > 0 ? sizes.ems(kLeastPaneHeight) + sizes.gap : 0.0F;
  if (!settings.plots || middle.height < least + above || middle.width < sizes.em) return;
  if (panes == 0) {
    divide_plots(settings, sizes, middle, layout);
    middle.height = 0.0F;
    return;
  }
  const float wanted = std::round(middle.height * share(settings.plots_share));
  const float height = std::clamp(wanted, least, middle.height - above);
  const Rect plots{middle.x, middle.bottom() - height, middle.width, height};
  layout.plots_splitter = {middle.x, plots.y - sizes.gap, middle.width, sizes.gap};
  middle.height -= height + sizes.gap;
  divide_plots(settings, sizes, plots, layout);
}

/// The shorter side of the smallest of `count` equal panes.
float pane_side(const Rect& area, int count, float gap, bool stacked) {
  const float along = stacked ? area.height : area.width;
  const auto n = static_cast<float>(count);
  return std::min((along - gap * (n - 1.0F)) / n, stacked ? area.width : area.height);
}

/// Beside each other, or one above the other where that makes them larger.
void place_panes(const LayoutSettings& settings, const Sizes& sizes, int count, const Rect& area,
                 Layout& layout) {
  if (count == 0 || area.empty()) return;
  if (count == 1) {
    layout.panes[0] = area;
    return;
  }
  const bool stacked =
      pane_side(area, count, sizes.gap, true) > 1.15F * pane_side(area, count, sizes.gap, false);
  const float along = stacked ? area.height : area.width;
  const auto part = [&](float from, float length) {
    return stacked ? Rect{area.x, area.y + from, area.width, length}
                   : Rect{area.x + from, area.y, length, area.height};
  };
  // The third one keeps its share, the splitter divides what the first two have.
  float room = along - sizes.gap;
  if (count == 3) {
    const float third = std::floor((along - 2.0F * sizes.gap) / 3.0F);
    layout.panes[2] = part(along - third, third);
    room = along - third - 2.0F * sizes.gap;
  }
  const float least = sizes.ems(stacked ? kLeastPaneHeight : kLeastPane);
  const float first = first_of_two(room, settings.pane_split, least);
  layout.panes[0] = part(0.0F, first);
  layout.pane_splitter = part(first, sizes.gap);
  layout.panes[1] = part(first + sizes.gap, room - first);
}

/// The effective size of what a drag changes, moved by `delta` and as a share of the room.
float moved_share(float first, float second, float delta) {
  const float room = first + second;
  if (room <= 0.0F) return 0.5F;
  return std::clamp((first + delta) / room, 0.02F, 0.98F);
}

}  // namespace

Layout make_layout(const LayoutSettings& settings, const LayoutInput& input) {
  Layout layout;
  const Sizes sizes = sizes_of(input);
  const float width = whole(input.width);
  const float height = whole(input.height);
  const float menu = std::min(whole(input.menu_height), height);
  const float status = std::min(whole(input.status_height), height - menu);
  layout.menu = {0.0F, 0.0F, width, menu};
  layout.status = {0.0F, height - status, width, status};

  const int panes = std::clamp(input.panes, 0, static_cast<int>(layout.panes.size()));
  Rect middle{0.0F, menu, width, height - menu - status};
  if (middle.empty()) return layout;
  place_plots(settings, sizes, panes, middle, layout);
  place_columns(settings, sizes, panes, middle, layout);
  place_panes(settings, sizes, panes, middle, layout);
  return layout;
}

bool panes_stacked(const Layout& layout) {
  return !layout.panes[1].empty() && layout.panes[1].y > layout.panes[0].y;
}

LayoutSettings drag_left(const LayoutSettings& grabbed, const LayoutInput& input, float delta) {
  const Layout layout = make_layout(grabbed, input);
  if (layout.left.empty()) return grabbed;
  LayoutSettings moved = grabbed;
  const float em = sizes_of(input).em;
  moved.left_width = std::clamp((layout.left.width + delta) / em, kLeastColumn, 400.0F);
  moved.left_width = make_layout(moved, input).left.width / em;
  return moved;
}

LayoutSettings drag_right(const LayoutSettings& grabbed, const LayoutInput& input, float delta) {
  const Layout layout = make_layout(grabbed, input);
  if (layout.right.empty()) return grabbed;
  LayoutSettings moved = grabbed;
  const float em = sizes_of(input).em;
  moved.right_width = std::clamp((layout.right.width - delta) / em, kLeastColumn, 400.0F);
  moved.right_width = make_layout(moved, input).right.width / em;
  return moved;
}

LayoutSettings drag_plots(const LayoutSettings& grabbed, const LayoutInput& input, float delta) {
  const auto room = [&](const Layout& layout) {
    return input.height - layout.menu.height - layout.status.height;
  };
  const auto plots = [&](const Layout& layout) { return layout.bars.bottom() - layout.power.y; };
  const Layout layout = make_layout(grabbed, input);
  if (layout.plots_splitter.empty()) return grabbed;
  LayoutSettings moved = grabbed;
  moved.plots_share = std::clamp((plots(layout) - delta) / room(layout), 0.02F, 0.98F);
  const Layout after = make_layout(moved, input);
  moved.plots_share = plots(after) / room(after);
  return moved;
}

LayoutSettings drag_plot_split(const LayoutSettings& grabbed, const LayoutInput& input,
                               float delta) {
  const Layout layout = make_layout(grabbed, input);
  if (layout.plot_splitter.empty()) return grabbed;
  LayoutSettings moved = grabbed;
  moved.plot_split = moved_share(layout.bars.width, layout.error.width, delta);
  const Layout after = make_layout(moved, input);
  moved.plot_split = moved_share(after.bars.width, after.error.width, 0.0F);
  return moved;
}

LayoutSettings drag_pane_split(const LayoutSettings& grabbed, const LayoutInput& input,
                               float delta) {
  const Layout layout = make_layout(grabbed, input);
  if (layout.pane_splitter.empty()) return grabbed;
  const auto split = [](const Layout& l, float by) {
    return panes_stacked(l) ? moved_share(l.panes[0].height, l.panes[1].height, by)
                            : moved_share(l.panes[0].width, l.panes[1].width, by);
  };
  LayoutSettings moved = grabbed;
  moved.pane_split = split(layout, delta);
  moved.pane_split = split(make_layout(moved, input), 0.0F);
  return moved;
}

}  // namespace encore::ui
