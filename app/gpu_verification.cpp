#include "app/gpu_verification.h"

#include "accel/make_structure.h"
#include "accel/test_rays.h"
#include "app/interrupt.h"
#include "renderer/camera_rays.h"
#include "renderer/gl/error.h"

#include <fmt/format.h>

#include <cstring>
#include <memory>
#include <stdexcept>

namespace encore::app {

namespace {

// Of the pixels, as the project demands it of any two devices.
constexpr double kLargestShare = 1e-4;

// What an answer is before the device has written it: one that is right for no ray.
constexpr scene::Hit kNoAnswer{-1.0F, scene::kNoHit - 1, -1.0F, -1.0F};

// The kinds of rays, and the camera's pixels before them.
double steps_a_row() {
  return 1.0 + static_cast<double>(accel::all_ray_kinds().size());
}

/// Compares two devices that have one structure, action by action.
class DeviceComparer {
 public:
  DeviceComparer(const scene::Scene& scene, const DeviceVerificationPlan& plan,
                 renderer::Tracer& reference, renderer::Tracer& device,
                 const DeviceVerificationHooks& hooks)
      : scene_(scene), plan_(plan), reference_(reference), device_(device), hooks_(hooks) {}

  /// The rows of one structure; `first_step` and `steps` place it in the whole.
  void compare_structure(const accel::StructureSpec& spec, const scene::TriangleList& at_start,
                         double first_share, double share, std::vector<DeviceRow>& rows) {
    first_share_ = first_share;
    step_share_ = share / ((scene_.animated() ? 3.0 : 1.0) * steps_a_row());
    steps_done_ = 0;
    triangles_ = at_start;
    structure_ = accel::make_structure(spec);
    structure_->build(triangles_.triangles);
    const bool fits = row("build", rows, [&] {
      const renderer::RenderInput input{&scene_, &triangles_, structure_.get()};
      reference_.init(input);
      device_.init(input);
    });
    if (fits && scene_.animated()) compare_moved(rows);
    progress_to(first_share + share);
  }

 private:
  /// Two other times of the animation.
  void compare_moved(std::vector<DeviceRow>& rows) {
    auto change = go_to(0.37);
    if (change == scene::TriangleChange::moved && structure_->can_refit() && device_.can_refit()) {
      row("refit", rows, [&] {
        // The device has the old nodes and is sent the new triangles alone.
        device_.refresh();
        device_.refit();
        structure_->update(triangles_.triangles);
        reference_.refresh();
      });
      change = go_to(0.71);
    }
    if (change == scene::TriangleChange::none) return;
    row("rebuild", rows, [&] {
      structure_->build(triangles_.triangles);
      reference_.refresh();
      device_.refresh();
    });
  }

  scene::TriangleChange go_to(double share_of_loop) {
    return scene::update_triangles(scene_, plan_.time_s + share_of_loop * scene_.duration_s(),
                                   triangles_);
  }

  /// One row: what `prepare` does, then the comparison. False if there is nothing to go on with.
  template <class Prepare>
  bool row(const std::string& action, std::vector<DeviceRow>& rows, const Prepare& prepare) {
    if (interrupted) return false;
    DeviceRow result;
    result.structure = structure_->name();
    result.action = action;
    try {
      prepare();
      result.triangles = triangles_.triangles.size();
      compare_pixels(result);
      compare_rays(result);
      compare_pictures(result);
    } catch (const renderer::gl::GlUnavailable&) {
      throw;
    } catch (const renderer::gl::GlError& error) {
      result.triangles = triangles_.triangles.size();
      result.problem = error.what();
    }
    if (interrupted) return false;
    rows.push_back(result);
    return result.problem.empty();
  }

  void compare_pixels(DeviceRow& result) {
    const auto [width, height] = plan_.size;
    reference_.trace_hits(scene_.camera, width, height, expected_);
    found_.assign(expected_.size(), kNoAnswer);
    device_.trace_hits(scene_.camera, width, height, found_);
    if (interrupted) return;
    if (found_.size() != expected_.size()) {
      throw std::logic_error("a device returned more or fewer hits than pixels");
    }
    rays_.resize(expected_.size());
    renderer::camera_rays(renderer::make_camera_frame(scene_.camera, width, height),
                          {0, 0, width, height}, rays_);
    differs_.assign(rays_.size(), 0);
    for (std::size_t i = 0; i < rays_.size() && !interrupted; ++i) {
      differs_[i] = file(result, i, [&] {
        const auto columns = static_cast<std::size_t>(width);
        return fmt::format("pixel ({}, {})", i % columns, i / columns);
      });
      result.differing_pixels += differs_[i];
    }
    result.pixels = rays_.size();
    step_done();
  }

  void compare_rays(DeviceRow& result) {
    for (const accel::RayKind kind : accel::all_ray_kinds()) {
      if (interrupted) return;
      rays_ = accel::test_rays(kind, plan_.rays_per_kind, plan_.seed, triangles_.triangles,
                               *structure_);
      expected_.resize(rays_.size());
      found_.assign(rays_.size(), kNoAnswer);
      reference_.trace_rays(rays_, expected_);
      device_.trace_rays(rays_, found_);
      for (std::size_t i = 0; i < rays_.size() && !interrupted; ++i) {
        file(result, i, [&] { return fmt::format("{} ray", accel::to_string(kind)); });
      }
      step_done();
    }
  }

  /// Files the answers to one ray; 1 if they differ.
  template <class Kind>
  std::uint8_t file(DeviceRow& result, std::size_t i, const Kind& kind) {
    const scene::Hit& expected = expected_[i];
    const scene::Hit& found = found_[i];
    const bool same = std::memcmp(&expected, &found, sizeof(scene::Hit)) == 0;
    result.hits.add(rays_[i], expected, found, same);
    if (same) return 0;
    HitDifference difference;
    if (result.hits.mismatches() <= kExaminedDifferences) {
      difference = explain_difference(triangles_.triangles, rays_[i], expected, found);
    }
    const bool explained = difference.explanation != Explanation::none;
    result.explained += explained ? 1 : 0;
    const bool first_wrong = !explained && result.unexplained() == 1;
    if (!result.first || first_wrong) {
      result.first = DeviceMismatch{kind(), rays_[i], expected, found, difference};
    }
    return 1;
  }

  void compare_pictures(DeviceRow& result) {
    if (interrupted) return;
    renderer::Image expected;
    renderer::Image found;
    expected.resize(plan_.size.width, plan_.size.height);
    found.resize(plan_.size.width, plan_.size.height);
    reference_.render(scene_.camera, expected);
    device_.render(scene_.camera, found);
    if (interrupted) return;
    result.picture = renderer::compare_images(expected, found);
    if (hooks_.pictures) hooks_.pictures(result, expected, found, differs_);
  }

  void step_done() { progress_to(first_share_ + ++steps_done_ * step_share_); }
  void progress_to(double share) const {
    if (hooks_.progress) hooks_.progress(share);
  }

  const scene::Scene& scene_;
  const DeviceVerificationPlan& plan_;
  renderer::Tracer& reference_;
  renderer::Tracer& device_;
  const DeviceVerificationHooks& hooks_;
  scene::TriangleList triangles_;
  std::unique_ptr<accel::AccelerationStructure> structure_;
  std::vector<scene::Ray> rays_;
  std::vector<scene::Hit> expected_;
  std::vector<scene::Hit> found_;
  std::vector<std::uint8_t> differs_;  ///< of the camera's pixels
  double first_share_ = 0.0;
  double step_share_ = 0.0;
  double steps_done_ = 0.0;
};

}  // namespace

bool DeviceRow::passed() const {
  return problem.empty() && unexplained() == 0 &&
         double(differing_pixels) <= kLargestShare * double(pixels);
}

std::vector<DeviceRow> verify_device(const scene::Scene& scene,
                                     const std::vector<accel::StructureSpec>& specs,
                                     const DeviceVerificationPlan& plan,
                                     renderer::Tracer& reference, renderer::Tracer& device,
                                     const DeviceVerificationHooks& hooks) {
  scene::TriangleList list;
  scene::update_triangles(scene, plan.time_s, list);
  DeviceComparer comparer(scene, plan, reference, device, hooks);
  std::vector<DeviceRow> rows;
  const double share = 1.0 / static_cast<double>(specs.size());
  for (std::size_t i = 0; i < specs.size() && !interrupted; ++i) {
    comparer.compare_structure(specs[i], list, double(i) * share, share, rows);
  }
  return rows;
}

}  // namespace encore::app
