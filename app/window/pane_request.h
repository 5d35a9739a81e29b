#pragma once

#include "accel/build_place.h"
#include "accel/settings.h"
#include "app/device.h"
#include "energy/phase_log.h"
#include "energy/provenance.h"
#include "scene/camera.h"
#include "scene/ray.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "ui/settings.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace encore::app {

struct PaneOutput;

/// A picture of the structure's 3D view.
struct FreeView {
  scene::Camera camera;
  int width = 0;
  int height = 0;

  friend bool operator==(const FreeView&, const FreeView&) = default;
};

/// A pixel whose ray is asked for.
struct Probe {
  int x = 0;
  int y = 0;

  friend bool operator==(const Probe&, const Probe&) = default;
};

/// A ray that was picked: it stays the same while the camera moves on.
struct PickedRay {
  Probe pixel;
  scene::Ray ray;

  friend bool operator==(const PickedRay& a, const PickedRay& b) {
    return a.pixel == b.pixel && a.ray.origin == b.ray.origin && a.ray.direction == b.ray.direction;
  }
};

/// Everything that a pane is to show. A worker compares it with what it has and does only what
/// differs.
struct PaneRequest {
  std::shared_ptr<const scene::Scene> scene;  ///< null: nothing to do
  std::optional<Device> device;               ///< nothing: the pane is off
  accel::StructureSpec structure;
  accel::Policy policy = accel::Policy::rebuild;
  /// What Policy::automatic weighs seconds with: watts above idle, where they are stated.
  std::optional<energy::PerPhase<double>> phase_watts;
  /// Where a structure for Device::gpu is built frame after frame.
  accel::BuildPlace build_on = accel::BuildPlace::automatic;
  int threads = 0;
  scene::RaySettings rays;
  double time_s = 0.0;
  scene::Camera camera;
  int width = 0;
  int height = 0;
  bool moving = false;        ///< the camera moves: coarse pictures do for now
  std::uint64_t rebuild = 0;  ///< another number: build again
  bool cancelled = false;     ///< the user wants nothing done until `rebuild` changes

  ui::PaneContent content = ui::PaneContent::picture;
  ui::HeatmapSettings heatmap;
  std::optional<double> frame_joules;  ///< what heatmaps of energy share out
  energy::Provenance frame_energy;
  std::shared_ptr<const PaneOutput> other;  ///< of the other pane, for the difference

  bool hits = false;   ///< what each pixel hits and how far away: for hidden lines and differences
  bool nodes = false;  ///< the node table
  ui::OverlayColor node_color = ui::OverlayColor::depth;
  std::optional<std::uint32_t> selected_node;
  std::optional<FreeView> free;
  std::optional<Probe> hover;
  std::optional<PickedRay> pick;

  /// Whether `o` asks for the same scene by the same means: only then a frame that is under way is
  /// worth finishing.
  [[nodiscard]] bool same_frame(const PaneRequest& o) const;
  friend bool operator==(const PaneRequest&, const PaneRequest&) = default;
};

/// The ray through a pixel's centre.
scene::Ray ray_of(const scene::Camera& camera, const Probe& pixel, int width, int height);

}  // namespace encore::app
