#pragma once

#include "app/common_options.h"
#include "renderer/image.h"
#include "renderer/renderer.h"
#include "scene/camera.h"
#include "scene/ray.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace encore::app {

/// What the camera's rays (one through each pixel's centre) hit otherwise than in truth.
struct HitErrors {
  std::uint64_t rays = 0;
  std::uint64_t missed = 0;          ///< the truth hits, this does not
  std::uint64_t invented = 0;        ///< this hits, the truth does not
  std::uint64_t wrong_triangle = 0;  ///< both hit, different triangles
  /// Largest |t - truth| / truth where both hit the same triangle; nothing where there is none.
  std::optional<double> largest_t;

  [[nodiscard]] std::uint64_t wrong() const { return missed + invented + wrong_triangle; }
};
HitErrors compare_hits(const std::vector<scene::Hit>& truth, const std::vector<scene::Hit>& found);

/// How far a configuration's picture is from what it would be with ever more samples and no
/// rounding.
struct PictureErrors {
  double rmse = 0.0;     ///< over the channels of linear RGB, against the reference picture
  double largest = 0.0;  ///< of one channel
  HitErrors hits;
};

/// The truth that configurations of one scene are held to: a picture of many samples of other
/// places than theirs (another seed, so that a shared sample hides no error), and the nearest hits
/// of the camera's rays, by the CPU in mode `precise` through a structure that `encore verify`
/// holds to brute force and to the exact oracle bit for bit.
class AccuracyReference {
 public:
  struct Plan {
    std::shared_ptr<const scene::Scene> scene;
    scene::RaySettings rays;  ///< but for the number of samples
    ImageSize size;
    int samples = 256;  ///< of the reference picture
    int threads = 0;
    std::optional<scene::Camera> camera{};  ///< nothing: the scene's own
    double time_s = 0.0;                    ///< of the scene's animation
  };
  /// Draws the reference. `progress` is told the share that is done. Ends early once `stop` is set:
  /// complete() is then false.
  AccuracyReference(const Plan& plan, const std::atomic<bool>& stop,
                    const std::function<void(double)>& progress);

  [[nodiscard]] bool complete() const { return complete_; }
  /// Estimated RMSE of the reference picture itself: errors near it are not resolved.
  [[nodiscard]] std::optional<double> own_error() const { return own_error_; }
  [[nodiscard]] const renderer::Image& image() const { return image_; }

  [[nodiscard]] const scene::Camera& camera() const { return camera_; }
  /// What pictures are drawn of.
  [[nodiscard]] const scene::TriangleList& triangles() const { return triangles_; }

  /// Draws one picture by a tracer over triangles() and compares. Nothing if it was stopped, which
  /// needs the tracer's own cancel flag. Throws as the tracer.
  std::optional<PictureErrors> errors_of(renderer::Tracer& tracer) const;

 private:
  Plan plan_;
  scene::Camera camera_;
  scene::TriangleList triangles_;
  renderer::Image image_;
  std::vector<scene::Hit> hits_;
  std::optional<double> own_error_;
  bool complete_ = false;
};

}  // namespace encore::app
