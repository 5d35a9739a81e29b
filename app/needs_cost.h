#pragma once

#include "app/common_options.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// How much longer a frame would take with something that it does without.
struct FeatureCost {
  std::string feature;  ///< as in scene::LeftOut
  /// What is put in is empty and changes nothing to be seen: shading normals of length 0, white
  /// vertex colours and textures, highlights too dark to see, a mirror that no triangle is made of.
  /// Otherwise it is what the picture would cost with it: shadows, more samples.
  bool same_picture = true;
  /// Of the rounds' differences: the median, and the fourth from below and from above. Of
  /// kCostRounds rounds the true median lies between those with a probability of 96.5 %.
  double ms = 0.0;
  double low_ms = 0.0;
  double high_ms = 0.0;
  std::optional<std::uint64_t> worker_bytes{};  ///< queues of rays: what all threads would keep

  /// Whether it is not even sure that it costs, or spares, anything.
  [[nodiscard]] bool below_noise() const { return !(low_ms > 0.0) && !(high_ms < 0.0); }
};

inline constexpr int kCostRounds = 15;

/// What a frame would cost with each of the things that it does without, on the CPU.
struct NeedsCost {
  ImageSize size;         ///< of the pictures that were drawn: not larger than asked for
  double frame_ms = 0.0;  ///< as it is, the median of the rounds
  std::vector<FeatureCost> features;
};

/// How a scene is drawn.
struct NeedsCostCase {
  const scene::Scene* scene = nullptr;
  scene::RaySettings rays;
  ImageSize size;
  int threads = 0;  ///< 0: all
};

/// Draws the scene at rest over a bvh-median, round by round: as it is, then with each thing that
/// is left out put in. About half a second of drawing at most: larger pictures are drawn smaller.
/// Nothing if `stop` is set before the end, or the scene has no triangles.
std::optional<NeedsCost> measure_needs_cost(const NeedsCostCase& what,
                                            const std::atomic<bool>& stop);

}  // namespace encore::app
