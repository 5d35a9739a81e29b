#pragma once

#include "app/window/pane_inspection.h"
#include "app/window/pane_picture.h"
#include "app/window/pane_worker.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace encore::app {

/// Marks of one picture: at most a dozen, and one for each part of it.
inline constexpr std::size_t kMostMarks = 64 + std::size_t{scene::kMostSamples};
/// What only the worker's thread touches.
struct PaneWorker::Work {
  explicit Work(const Setup& setup)
      : tracer(setup.gl_device), log(setup.monitor->clock(), kMostMarks) {}

  PaneTracer tracer;
  PanePicture picture;
  PaneInspection inspection;
  energy::PhaseLog log;
  std::unique_ptr<energy::PhaseListener> listener;
  std::optional<Device> listener_device;
  std::optional<ui::FrameFigures> frame;  ///< of the last whole frame
  std::uint64_t serial = 0;
  double seconds_a_pixel = 0.0;  ///< and sample, of the last picture
  /// What is drawn part by part: a request like it goes on where that one was left.
  std::optional<PaneRequest> refining;
  /// What the rays of a whole frame were that was drawn to learn it.
  struct KnownRays {
    std::uint64_t content = 0;
    scene::Camera camera;
    int width = 0;
    int height = 0;
    ui::FrameFigures figures;
  };
  std::optional<KnownRays> known_rays;
  std::uint64_t slot_frame = 0;  ///< of the animation, over all slots
  std::uint64_t cancelled_at = 0;
};

}  // namespace encore::app
