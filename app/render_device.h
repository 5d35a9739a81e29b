#pragma once

#include "accel/counters.h"
#include "app/common_options.h"
#include "app/device.h"
#include "app/gpu_device.h"
#include "renderer/image.h"
#include "renderer/renderer.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What one picture took on a device. Milliseconds by the host's clock unless said otherwise; what
/// does not apply or is not known is empty.
struct DrawFigures {
  Device device = Device::cpu;
  std::string device_name;     ///< empty: the CPU itself
  std::optional<int> threads;  ///< of the CPU
  /// Sending the scene and the structure, everything compiled and allocated before.
  std::optional<double> transfer_ms;
  std::optional<double> transfer_device_ms;  ///< by the device's clock
  std::uint64_t transfer_bytes = 0;          ///< sent
  std::uint64_t converted_bytes = 0;         ///< of these, rewritten for the device before
  /// The first frame, and compiling and sending before it.
  std::optional<double> warm_up_ms;
  double draw_ms = 0.0;                  ///< after the warm-up, if there is one
  std::optional<double> draw_device_ms;  ///< by the device's clock
  std::optional<std::uint64_t> hits;     ///< of the camera's rays
  std::optional<renderer::RayFigures> rays;
};

/// A device with a scene on it, ready to draw.
class RenderDevice {
 public:
  /// `input` must outlive the object. Throws GlUnavailable or GlError.
  RenderDevice(Device device, const renderer::RenderInput& input, GpuContext& gpu, int threads,
               const scene::RaySettings& rays);

  /// Each of these draws twice where the first time takes longer, and notes the second. False if
  /// it was interrupted; throws std::invalid_argument for a camera or size that nothing can draw.
  bool draw(ImageSize size, renderer::Image& image);
  bool trace_counters(ImageSize size, std::vector<accel::TraceCounters>& counters);
  /// Notes nothing. False also if the device traces no rays.
  bool trace_hits(ImageSize size, std::vector<scene::Hit>& hits);

  [[nodiscard]] const DrawFigures& figures() const { return figures_; }

 private:
  bool run(const std::function<void()>& draw_once);

  renderer::RenderInput input_;
  std::unique_ptr<renderer::Renderer> renderer_;
  renderer::Tracer* tracer_ = nullptr;  ///< the renderer, if it traces rays
  DrawFigures figures_;
};

}  // namespace encore::app
