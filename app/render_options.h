#pragma once

#include "accel/settings.h"
#include "app/common_options.h"
#include "app/device.h"
#include "renderer/heatmap.h"
#include "scene/camera.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace encore::app {

/// What `encore render` was asked for, as it stands on the command line.
struct RenderOptions : CommonOptions {
  std::string size = "512";
  std::string out;
  double time_s = 0.0;
  std::string heatmap;
  std::string camera;
  std::string device = "cpu";
  std::string compare;
  std::string difference;
  std::optional<int> gl_device;
};

void add_render_options(CLI::App& command, RenderOptions& options);

/// What the options mean.
struct RenderChoice {
  ImageSize size;
  Device device = Device::cpu;
  std::optional<Device> compare;
  std::optional<renderer::HeatmapQuantity> heatmap;

  /// Whether a device that draws traces rays, so that there must be a structure.
  [[nodiscard]] bool needs_structure() const;
};

/// Finds everything that can be wrong with the command line before anything is loaded. Throws
/// UsageError, or std::runtime_error for a folder that is not there.
RenderChoice check_render_options(const RenderOptions& options);

/// Lays what --camera states over the scene's own camera: eye and target, then up, then the field
/// of view, each group optional from the end. Throws UsageError.
void apply_camera(std::string_view text, scene::Camera& camera);

/// The one structure to draw with: the one asked for, else the scene's, else bvh-median. Throws
/// UsageError if a device has no way to trace it.
accel::StructureSpec chosen_structure(const RenderOptions& options, const RenderChoice& choice,
                                      const scene::Scene& scene);

}  // namespace encore::app
