#pragma once

#include "accel/settings.h"
#include "accel/verify.h"
#include "app/common_options.h"
#include "app/hit_difference.h"
#include "renderer/image_diff.h"
#include "renderer/renderer.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::app {

/// How thoroughly to hold a device to the CPU.
struct DeviceVerificationPlan {
  ImageSize size;                     ///< of the camera's picture, every pixel of which is compared
  std::size_t rays_per_kind = 20000;  ///< of each accel::RayKind besides
  std::uint64_t seed = 1;
  double time_s = 0.0;
};

/// A ray that the two answer differently.
struct DeviceMismatch {
  std::string kind;  ///< "pixel (x, y)", or the kind of ray
  scene::Ray ray;
  scene::Hit expected;
  scene::Hit found;
  HitDifference difference;
};

/// One line of the report: a structure as it is on the device after an action. All pixels and rays
/// are summed; a ray differs unless triangle, t, u and v are equal bit for bit.
struct DeviceRow {
  std::string structure;
  /// "build"; in moving scenes also "refit" (the device fits its own copy to triangles that moved)
  /// and "rebuild" (the host builds afresh, and what changed is sent).
  std::string action;
  std::uint64_t triangles = 0;
  std::uint64_t pixels = 0;
  std::uint64_t differing_pixels = 0;
  accel::HitComparison hits;
  std::uint64_t explained = 0;  ///< differences that rounding explains (explain_difference())
  std::optional<DeviceMismatch> first;  ///< the first unexplained one, else the first
  renderer::ImageDifference picture;    ///< of the two pictures
  std::string problem;                  ///< why nothing could be compared; else empty

  [[nodiscard]] std::uint64_t unexplained() const { return hits.mismatches() - explained; }
  /// Nothing unexplained, and at most 0.01 % of the pixels differ; false if nothing was compared.
  [[nodiscard]] bool passed() const;
};

/// Differences of a row that are looked into; those after that count as unexplained.
inline constexpr std::uint64_t kExaminedDifferences = 1000;

/// What the caller wants to hear; either may be empty.
struct DeviceVerificationHooks {
  std::function<void(double share)> progress;
  /// After each row: both pictures, and for each pixel whether its hits differ.
  std::function<void(const DeviceRow& row, const renderer::Image& expected,
                     const renderer::Image& found, std::span<const std::uint8_t> differs)>
      pictures;
};

/// Holds the hits of `device` to those of `reference`, for every structure: every pixel of the
/// scene's camera and rays of all kinds, after a build, and for scenes that move after a refit on
/// the device (where it can) and after a rebuild. Both are given the scene by init(). What the
/// device cannot hold (GlError) becomes a row's problem; GlUnavailable is thrown. Stops early, with
/// the rows that are complete, once interrupted.
std::vector<DeviceRow> verify_device(const scene::Scene& scene,
                                     const std::vector<accel::StructureSpec>& specs,
                                     const DeviceVerificationPlan& plan,
                                     renderer::Tracer& reference, renderer::Tracer& device,
                                     const DeviceVerificationHooks& hooks);

}  // namespace encore::app
