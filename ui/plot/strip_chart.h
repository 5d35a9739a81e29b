#pragma once

#include "energy/provenance.h"
#include "ui/plot/axis.h"
#include "ui/plot/plot_colors.h"
#include "ui/plot/plot_input.h"
#include "ui/plot/sample_history.h"

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace encore::ui {

/// A value with its uncertainty.
struct Level {
  double value = 0.0;
  std::optional<double> half_width;
};

/// One line of a strip chart, as one source saw it.
struct StripSeries {
  std::string name;
  PlotColor color = PlotColor::cpu;
  const SampleHistory* history = nullptr;  ///< the caller's; may be null or empty
  energy::Provenance provenance;
  std::string reason;  ///< why there are no samples: "no power source: ..."
  std::optional<Level> idle;
  const SampleHistory* running_mean = nullptr;  ///< with its half-widths; may be null
};

/// What went on for a while: a CPU slot, a GPU slot, idle, a build.
struct StripSpan {
  double t0 = 0.0;
  double t1 = 0.0;
  int lane = 0;  ///< 0 .. 7, lower lanes further down
  PlotColor color = PlotColor::idle;
  std::string name;
  std::string tooltip;
};

/// Something that happened at one time.
struct StripFlag {
  double time_s = 0.0;
  std::string text;
};

/// What a strip chart shows; nothing of it is changed.
struct StripData {
  std::vector<StripSeries> series;
  std::vector<StripSpan> spans;  ///< in the order of t0
  std::vector<StripFlag> flags;
  std::string unit = "W";
  std::string integral_unit = "J";  ///< of value x s
  std::optional<double> now_s;      ///< where a live strip is; nothing for a recording
};

/// What the user chose in a strip chart.
struct StripState {
  Axis x{.scale = Scale::time,
         .low = 0.0,
         .high = 60.0,
         .unit = "s",
         .least = -1e9,
         .most = 1e12,
         .narrowest = 1e-5};
  Axis y{.scale = Scale::linear,
         .low = 0.0,
         .high = 100.0,
         .unit = "W",
         .least = -1e12,
         .most = 1e12,
         .narrowest = 1e-9};
  bool follow = true;  ///< a live strip shows its last `window_s` seconds
  double window_s = 60.0;
  bool fit_x = true;       ///< a recording is fitted once
  bool fit_y = true;       ///< y follows what is in sight
  bool from_zero = false;  ///< y always shows 0
  std::optional<AxisRange> selection;
  std::set<std::string> hidden;  ///< names of series

  // Between frames only.
  std::optional<double> drag_from;
  struct Known {
    const SampleHistory* history = nullptr;
    double t0 = 0.0;
    double t1 = 0.0;
    std::uint64_t samples = 0;
    double latest = 0.0;  ///< s, the newest sample then
    std::optional<RangeStatistics> statistics;
  };
  std::vector<Known> known;  ///< statistics of the selection, so that they are not made each frame
};

struct StripResult {
  bool hovered = false;
  std::optional<double> cursor_s;      ///< the time under the mouse
  bool selection_changed = false;      ///< picked or dropped in this frame
  std::optional<std::size_t> toggled;  ///< series whose legend entry was clicked
};

/// Draws a strip chart of `size` pixels (0: what is left) at Dear ImGui's cursor. `name` is its
/// widget's name. A double click shows everything and, on a live strip, follows again.
StripResult strip_chart(std::string_view name, const StripData& data, StripState& state,
                        ImVec2 size = {0.0F, 0.0F});

/// The statistics of the selection of one series, kept until its samples change them; nothing
/// without a selection or samples in it.
std::optional<RangeStatistics> selection_statistics(const SampleHistory& history,
                                                    StripState& state);

}  // namespace encore::ui
