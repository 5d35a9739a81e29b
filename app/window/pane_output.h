#pragma once

#include "accel/counters.h"
#include "accel/inspect/node_measures.h"
#include "accel/inspect/ray_path.h"
#include "accel/stats.h"
#include "renderer/image.h"
#include "scene/bounds.h"
#include "scene/camera.h"
#include "scene/ray.h"
#include "ui/view.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// A picture as the screen takes it: 8 bits a channel, sRGB, red green blue alpha, row 0 at the
/// top.
struct ScreenPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

/// A picture of the 3D view and how far each pixel's hit is (infinite where there is none).
struct FreePicture {
  ScreenPicture screen;
  std::vector<float> distances;
  scene::Camera camera;
};

/// What a ray was asked about, and its way through the structure.
struct ProbeOutput {
  ui::PixelView pixel;
  scene::Ray ray;
  std::shared_ptr<const accel::RayPath> path;  ///< of picks only
  std::vector<std::string> sentences;
  std::vector<std::optional<std::uint32_t>> nodes;
};

/// What a pane has to show; never changed once it is out. Parts are shared from output to output
/// where they stay the same.
struct PaneOutput {
  std::uint64_t serial = 0;
  std::shared_ptr<const ScreenPicture> screen;  ///< null before the first picture
  std::shared_ptr<const renderer::Image> image;
  std::shared_ptr<const std::vector<float>> distances;
  std::shared_ptr<const std::vector<std::uint32_t>> hit_triangles;
  scene::Camera camera;  ///< of the picture
  int width = 0;         ///< as asked for
  int height = 0;
  bool whole = false;                            ///< not a coarse one, and of all samples
  std::optional<ui::RefinementView> refinement;  ///< of several samples a pixel
  std::vector<scene::LeftOut> left_out;          ///< by the scene and its rays
  std::optional<ui::FrameFigures> frame;
  std::optional<ui::HeatmapView> heatmap;
  std::optional<ui::DifferenceView> difference;
  std::shared_ptr<const accel::BuildStats> stats;
  std::optional<double> sah_decay;
  std::optional<double> break_even_frames;
  std::shared_ptr<const accel::NodeTable> nodes;
  std::shared_ptr<const accel::StructureProfile> profile;
  std::shared_ptr<const accel::NodeValues> node_values;  ///< by the overlay's colour
  std::vector<std::uint32_t> selected_triangles;
  std::vector<scene::Triangle> selected_shapes;  ///< the same, as they lie in the world
  std::shared_ptr<const FreePicture> free;
  std::optional<ProbeOutput> hover;
  std::optional<ProbeOutput> pick;
  scene::Bounds bounds;  ///< of the scene at this time
  std::uint64_t triangles = 0;
  std::string device;
  bool software = false;
  bool refits_on_device = false;
  std::uint64_t memory_bytes = 0;
};

/// Where a worker stands.
struct PaneStatus {
  ui::PaneState state = ui::PaneState::off;
  std::string doing;
  std::optional<double> progress;
  double since_s = 0.0;  ///< of the steady clock
  std::string problem;
};

}  // namespace encore::app
