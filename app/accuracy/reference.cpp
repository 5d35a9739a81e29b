#include "app/accuracy/reference.h"

#include "accel/make_structure.h"
#include "renderer/cpu_tracer.h"
#include "renderer/image_diff.h"
#include "renderer/paths/progressive_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace encore::app {

HitErrors compare_hits(const std::vector<scene::Hit>& truth, const std::vector<scene::Hit>& found) {
  if (truth.size() != found.size()) {
    throw std::invalid_argument("hits of two pictures of different sizes cannot be compared");
  }
  HitErrors errors;
  errors.rays = truth.size();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const scene::Hit& expected = truth[i];
    const scene::Hit& hit = found[i];
    if (expected.found() != hit.found()) {
      ++(expected.found() ? errors.missed : errors.invented);
    } else if (expected.found() && expected.triangle != hit.triangle) {
      ++errors.wrong_triangle;
    } else if (expected.found()) {
      const double t = expected.t;
      const double off = std::fabs(static_cast<double>(hit.t) - t) / t;
      errors.largest_t = std::max(errors.largest_t.value_or(0.0), off);
    }
  }
  return errors;
}

AccuracyReference::AccuracyReference(const Plan& plan, const std::atomic<bool>& stop,
                                     const std::function<void(double)>& progress)
    : plan_(plan), camera_(plan.camera.value_or(plan.scene->camera)) {
  scene::update_triangles(*plan_.scene, plan_.time_s, triangles_);
  const auto structure =
      accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  structure->build(triangles_.triangles);

  renderer::CpuTracer tracer(plan_.threads);
  tracer.set_cancel_flag(&stop);
  scene::RaySettings rays = plan_.rays;
  rays.samples = plan_.samples;
  rays.seed = plan_.rays.seed + 1;
  tracer.set_rays(rays);
  tracer.init({plan_.scene.get(), &triangles_, structure.get()});
  tracer.trace_hits(camera_, plan_.size.width, plan_.size.height, hits_);

  renderer::ProgressiveImage picture;
  picture.reset(plan_.size.width, plan_.size.height);
  renderer::Image part;
  const auto all = static_cast<std::uint32_t>(plan_.samples);
  for (std::uint32_t first = 0, count = 1; first < all && !stop; first += count) {
    // Powers of two, as the error estimate wants them, but not so long that nobody is told.
    count = std::min(first == 0 ? 1U : std::min(first, 16U), all - first);
    tracer.draw_samples(camera_, plan_.size.width, plan_.size.height, first, count);
    if (!tracer.complete()) return;
    tracer.read(part);
    picture.add(part, count);
    progress(static_cast<double>(first + count) / plan_.samples);
  }
  if (stop) return;
  image_ = picture.mean();
  own_error_ = picture.error();
  complete_ = true;
}

std::optional<PictureErrors> AccuracyReference::errors_of(renderer::Tracer& tracer) const {
  PictureErrors errors;
  std::vector<scene::Hit> hits;
  tracer.trace_hits(camera_, plan_.size.width, plan_.size.height, hits);
  if (!tracer.complete()) return std::nullopt;
  errors.hits = compare_hits(hits_, hits);
  renderer::Image picture;
  tracer.draw(camera_, plan_.size.width, plan_.size.height);
  if (!tracer.complete()) return std::nullopt;
  tracer.read(picture);
  const renderer::ImageDifference difference = renderer::compare_images(image_, picture);
  errors.rmse = difference.rmse;
  errors.largest = difference.largest;
  return errors;
}

}  // namespace encore::app
