#pragma once

#include "ui/plot/plot_draw.h"
#include "ui/plot/strip_chart.h"

#include <string>
#include <vector>

namespace encore::ui {

// The parts of a strip chart, each drawn into an area that is already clipped.

/// Samples as drawn: what the mouse can point at.
using Drawn = std::vector<Bucket>;

/// One series: the envelope of merged samples, the line, the marks of single ones.
Drawn draw_series(ImDrawList& list, const PlotRect& area, const StripSeries& series, const Axis& x,
                  const Axis& y);
/// A dashed line with its band; no words, which would lie on the curve.
void draw_idle_level(ImDrawList& list, const PlotRect& area, const StripSeries& series,
                     const Axis& y);
/// "idle 12.0 ±0.3 W"; for a series with an idle level.
std::string idle_text(const StripSeries& series, const std::string& unit);
void draw_running_mean(ImDrawList& list, const PlotRect& area, const StripSeries& series,
                       const Axis& x, const Axis& y);

/// How many lanes the spans need.
int lane_count(const std::vector<StripSpan>& spans);
float lanes_height(int lanes);
/// The lanes below the area, and a trace of each span's colour in it.
void draw_spans(ImDrawList& list, const PlotRect& area, const std::vector<StripSpan>& spans,
                const Axis& x);
/// The span whose lane is at a point below the area; null if there is none.
const StripSpan* span_at(const PlotRect& area, const std::vector<StripSpan>& spans, const Axis& x,
                         float mouse_x, float mouse_y);
void draw_flags(ImDrawList& list, const PlotRect& area, const std::vector<StripFlag>& flags,
                const Axis& x);
void draw_selection(ImDrawList& list, const PlotRect& area, const AxisRange& range, const Axis& x);
/// The table of the selection's statistics in the corner away from it.
void draw_statistics(ImDrawList& list, const PlotRect& area, const StripData& data,
                     StripState& state);

/// The bucket of a series that is nearest to a time; null if there is none.
const Bucket* nearest_bucket(const Drawn& drawn, double time_s);
/// "35.12 W", "34.9 .. 36.2 W (mean 35.1, 12 samples)".
std::string bucket_text(const Bucket& bucket, const std::string& unit);

}  // namespace encore::ui
