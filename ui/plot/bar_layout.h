#pragma once

#include "energy/provenance.h"
#include "ui/plot/axis.h"
#include "ui/plot/plot_colors.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::ui {

struct PlotRect {
  float x0 = 0.0F;
  float y0 = 0.0F;
  float x1 = 0.0F;
  float y1 = 0.0F;

  [[nodiscard]] float width() const { return x1 - x0; }
  [[nodiscard]] float height() const { return y1 - y0; }
  [[nodiscard]] bool holds(float x, float y) const {
    return x >= x0 && x < x1 && y >= y0 && y < y1;
  }
};

/// One phase's share of a bar.
struct BarPart {
  std::string name;
  PlotColor color = PlotColor::remainder;
  std::optional<double> value;       ///< nothing: unavailable, for provenance.detail
  std::optional<double> half_width;  ///< of its 95 % confidence interval
  energy::Provenance provenance;
  std::string detail{};  ///< lines below the part's figures where it is pointed at
};

/// One stack, bottom part first.
struct Bar {
  std::string name;                  ///< what it shows: "energy", "time", a session
  std::string unit;                  ///< "J": bars of one unit share an axis
  bool pale = false;                 ///< drawn hatched: time beside energy, session B beside A
  std::optional<double> half_width;  ///< of the sum, where it is known better than part by part
  std::vector<BarPart> parts;
};

/// Bars side by side under one label: a configuration.
struct BarGroup {
  std::string label;
  std::vector<Bar> bars;
};

struct BarData {
  std::vector<BarGroup> groups;
};

enum class BarMode : unsigned char {
  absolute,
  percent_of_bar,      ///< each bar's parts as shares of it
  percent_of_largest,  ///< all bars of a unit against the largest one, as figures 32-35 of the
                       ///< thesis
};

struct BarSum {
  double value = 0.0;
  std::optional<double> half_width;
  std::size_t missing = 0;  ///< parts without a value: the sum is then a lower bound
};
/// Nothing where no part has a value. The half-width is the bar's own, else the root of the parts'
/// squares, if every part has one.
std::optional<BarSum> bar_sum(const Bar& bar);

/// How much more `b` is than `a`, in %, with the half-width that both intervals imply (first order,
/// independent); nothing where either is unavailable, incomplete, or `a` is not above 0.
struct Difference {
  double percent = 0.0;
  std::optional<double> half_width;
};
std::optional<Difference> difference(const Bar& a, const Bar& b);

struct PlacedPart {
  PlotRect rect;
  std::size_t group = 0;
  std::size_t bar = 0;
  std::size_t part = 0;
};

struct PlacedBar {
  PlotRect slot;  ///< the column over the full height
  std::size_t group = 0;
  std::size_t bar = 0;
  bool available = false;
  float top = 0.0F;                          ///< y of the sum
  std::optional<float> band_low, band_high;  ///< y of sum -+ half-width, inside the area
};

struct PlacedLabel {
  float x = 0.0F;  ///< centre
  std::vector<std::string> lines;
  std::size_t group = 0;
  bool shortened = false;
};

struct BarLayout {
  PlotRect area;
  std::vector<std::string> units;  ///< one or two: the left and the right axis
  std::vector<Axis> axes;          ///< one a unit
  float content_width = 0.0F;      ///< more than area's: scroll
  float scroll = 0.0F;             ///< as it was clamped
  std::vector<PlacedBar> bars;     ///< only what is in sight
  std::vector<PlacedPart> parts;
  std::vector<PlacedLabel> labels;
};

/// Sizes in pixels.
struct BarSizes {
  float least_bar = 10.0F;
  float most_bar = 48.0F;
  float gap = 10.0F;          ///< between groups
  float least_group = 40.0F;  ///< so that a label has room
  float most_group = 40.0F;   ///< groups get no wider than this only for their labels
  int label_lines = 2;
  float top_room = 10.0F;  ///< above the largest bar, for what is written there
};
using MeasureText = std::function<float(std::string_view)>;

/// Places stacks in `area`; groups that do not fit are reached by `scroll` (pixels). Bars of a
/// third unit are placed as unavailable.
BarLayout layout_bars(const BarData& data, BarMode mode, const PlotRect& area, float scroll,
                      const BarSizes& sizes, const MeasureText& measure);

/// The part at a point; its `part` is past the bar's parts where the point is in the bar's column
/// but on no part. Nothing outside all columns.
std::optional<PlacedPart> bar_at(const BarLayout& layout, const BarData& data, float x, float y);

/// Breaks a text at blanks, '/', ',' and '-' into at most `lines` of at most `width` pixels; what
/// does not fit ends in an ellipsis.
PlacedLabel fit_label(std::string_view text, float width, int lines, const MeasureText& measure);
/// The least width at which a text fits into two lines.
float two_line_width(std::string_view text, const MeasureText& measure);

}  // namespace encore::ui
