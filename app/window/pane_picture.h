#pragma once

#include "app/window/pane_output.h"
#include "app/window/pane_request.h"
#include "app/window/pane_tracer.h"
#include "app/window/refinement.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace encore::app {

/// A pane's picture with all that is made of it: what each ray cost and hit, colours of costs and
/// of differences. Traces only what is wanted and not there yet; colours alone are made anew
/// without tracing.
class PanePicture {
 public:
  /// Draws what is asked for with 1 / `divisor` of the pixels a side, unless it is there. Of a
  /// picture of several samples a pixel it draws the next part (refinement.h), and of a coarse one
  /// the first sample alone; complete() says whether there is more to draw. False if `cancel` ended
  /// it; then what was there before stays.
  bool trace(PaneTracer& tracer, const PaneRequest& request, int divisor, energy::PhaseLog& log,
             const std::atomic<bool>* cancel);
  /// Takes over the picture that the tracer drew last by itself.
  void take_drawn(PaneTracer& tracer, const PaneRequest& request);
  /// Makes what is shown of what was traced, if the request changed what that is.
  void color(const PaneRequest& request);
  void fill(PaneOutput& output) const;
  void clear() { *this = {}; }

  /// Whether the whole picture that `request` asks for is there.
  [[nodiscard]] bool whole(const PaneTracer& tracer, const PaneRequest& request) const;
  /// Whether the picture has all samples that it is to have.
  [[nodiscard]] bool complete() const { return complete_; }
  /// Of a picture of several samples a pixel, since it was begun; null for others.
  [[nodiscard]] const Refinement* refinement() const { return refined_ ? &refinement_ : nullptr; }
  /// Whether the last trace() drew a picture, or found it there.
  [[nodiscard]] bool drew() const { return drew_; }

 private:
  /// What a picture was made of.
  struct Made {
    std::uint64_t content = 0;
    scene::Camera camera;
    int width = 0;
    int height = 0;

    friend bool operator==(const Made&, const Made&) = default;
  };
  [[nodiscard]] bool draw(PaneTracer& tracer, const PaneRequest& request, const Made& wanted,
                          energy::PhaseLog& log, const std::atomic<bool>* cancel);
  [[nodiscard]] bool refine(PaneTracer& tracer, const PaneRequest& request, const Made& wanted,
                            energy::PhaseLog& log, const std::atomic<bool>* cancel);
  [[nodiscard]] static bool wants_counters(const PaneTracer& tracer, const PaneRequest& request);
  [[nodiscard]] static bool wants_hits(const PaneTracer& tracer, const PaneRequest& request);
  void color_heatmap(const PaneRequest& request, ScreenPicture& screen);
  void color_difference(const PaneRequest& request, ScreenPicture& screen);
  void keep_hits(const std::vector<scene::Hit>& hits);

  std::optional<Made> image_made_;
  std::optional<Made> counters_made_;
  std::optional<Made> hits_made_;
  std::shared_ptr<const renderer::Image> image_;
  Refinement refinement_;
  bool refined_ = false;  ///< image_ is refinement_'s
  bool complete_ = true;
  std::vector<accel::TraceCounters> counters_;
  std::shared_ptr<const std::vector<float>> distances_;
  std::shared_ptr<const std::vector<std::uint32_t>> hit_triangles_;
  int wanted_width_ = 0;  ///< as the request had it
  int wanted_height_ = 0;
  bool drew_ = false;
  // What the colours were made of.
  std::shared_ptr<const ScreenPicture> screen_;
  std::shared_ptr<const renderer::Image> colored_;
  ui::PaneContent content_ = ui::PaneContent::picture;
  ui::HeatmapSettings heatmap_;
  std::optional<double> joules_;
  std::uint64_t other_serial_ = 0;
  bool colored_counters_ = false;
  std::optional<ui::HeatmapView> heatmap_view_;
  std::optional<ui::DifferenceView> difference_view_;
};

}  // namespace encore::app
