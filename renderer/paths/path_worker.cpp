#include "renderer/paths/path_worker.h"

#include "renderer/surface_light.h"

#include <algorithm>

namespace encore::renderer {

namespace {

using scene::Hit;
using scene::Ray;
using scene::RayKind;

/// The shading normals of a triangle; null if nothing asks for them.
const std::array<glm::vec3, 3>* corner_normals(const PathJob& job, std::uint32_t triangle) {
  return job.needs.normals ? &job.input.triangles->normals[triangle] : nullptr;
}

SurfacePoint point_hit(const PathJob& job, const Ray& ray, const Hit& hit) {
  return surface_point(ray, hit, job.input.triangles->triangles[hit.triangle],
                       corner_normals(job, hit.triangle));
}

/// Room for what is needed, none for what is not; what is there already stays.
template <class Space>
void keep_if(bool needed, std::unique_ptr<Space>& space) {
  if (!needed) {
    space.reset();
  } else if (space == nullptr) {
    space = std::make_unique<Space>();
  }
}

}  // namespace

void PathWorker::Queue::push(const Continuation& next, const glm::vec3& weight_before,
                             std::uint32_t pixel) {
  rays[count] = next.ray;
  weights[count] = next.weight * weight_before;
  pixels[count++] = pixel;
}

void PathWorker::fit(const PathJob& job) {
  keep_if(job.needs.shadows || job.bounces(), points_);
  keep_if(job.needs.shadows, shadows_);
  keep_if(job.bounces(), bounces_);
  const std::size_t depth = job.bounces() ? static_cast<std::size_t>(job.rays.depth) : 0;
  levels_.resize(depth);
  levels_.shrink_to_fit();
}

void PathWorker::begin_picture() {
  clock_.reset();
  camera_hits_ = 0;
}

bool PathWorker::draw_tile(const PathJob& job, const CameraFrame& frame, const PixelRect& tile,
                           const SampleRange& samples, const std::atomic<bool>* cancel,
                           std::span<glm::vec3> colors) {
  const std::size_t count = tile.count();
  clock_.resume();
  for (std::uint32_t i = 0; i < samples.count; ++i) {
    if (i > 0 && cancel != nullptr && cancel->load(std::memory_order_relaxed)) return false;
    const CameraSample sample{.sample = samples.first + i,
                              .samples = static_cast<std::uint32_t>(job.rays.samples),
                              .seed = job.rays.seed};
    const std::span<Ray> rays = job.bounces() ? bounces_->camera.rays : rays_;
    camera_rays(frame, tile, sample, rays.first(count));
    if (job.bounces()) {
      job.needs.shadows ? bounce_sample<true>(job, tile) : bounce_sample<false>(job, tile);
    } else {
      const auto width = static_cast<std::size_t>(tile.width());
      job.needs.shadows ? cast_sample<true>(job, rays.first(count), width)
                        : cast_sample<false>(job, rays.first(count), width);
    }
    if (i == 0) {
      std::copy_n(colors_.begin(), count, sums_.begin());
    } else {
      for (std::size_t k = 0; k < count; ++k) sums_[k] += colors_[k];
    }
  }
  const auto divisor = static_cast<float>(samples.count);
  for (std::size_t k = 0; k < count; ++k) colors[k] = sums_[k] / divisor;
  clock_.charge(RayKind::camera);
  return true;
}

template <bool kShadows>
void PathWorker::cast_sample(const PathJob& job, std::span<const Ray> rays, std::size_t width) {
  const auto hits = std::span(hits_).first(rays.size());
  job.input.structure->intersect_tile(rays, width, hits);
  clock_.count(RayKind::camera, rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    ++camera_hits_;
    if constexpr (kShadows) (*points_)[i] = point_hit(job, rays[i], hits[i]);
  }
  shade_batch<kShadows>(job, rays, hits, RayKind::camera);
}

template <bool kShadows>
void PathWorker::shade_batch(const PathJob& job, std::span<const Ray> rays,
                             std::span<const Hit> hits, RayKind kind) {
  const ShadingScene shading{job.input.scene, job.input.triangles};
  const auto colors = std::span(colors_).first(rays.size());
  if constexpr (kShadows) {
    const ShadedBatch batch{rays, hits, std::span(*points_).first(rays.size()), kind};
    job.shade_shadowed(shading, *job.input.structure, batch, *shadows_, clock_, colors);
  } else {
    job.shade(shading, rays, hits, colors);
  }
  clock_.charge(kind);
}

template <bool kShadows>
void PathWorker::bounce_sample(const PathJob& job, const PixelRect& tile) {
  Queue& camera = bounces_->camera;
  const std::size_t count = tile.count();
  camera.count = count;
  for (std::size_t i = 0; i < count; ++i) {
    camera.weights[i] = glm::vec3(1.0F);
    camera.pixels[i] = static_cast<std::uint32_t>(i);
    bounces_->light[i] = glm::vec3(0.0F);
  }
  trace<kShadows>(job, camera, static_cast<std::size_t>(tile.width()), RayKind::camera, 0);
  std::copy_n(bounces_->light.begin(), count, colors_.begin());
}

template <bool kShadows>
void PathWorker::trace(const PathJob& job, const Queue& batch, std::size_t width, RayKind kind,
                       std::size_t depth) {
  job.input.structure->intersect_tile(std::span<const Ray>(batch.rays).first(batch.count), width,
                                      std::span(hits_).first(batch.count));
  clock_.count(kind, batch.count);
  scatter_batch(job, batch, depth);
  const OwnColors& own = bounces_->own;
  if (kind == RayKind::camera) {
    camera_hits_ += static_cast<std::uint64_t>(
        std::count_if(hits_.begin(), hits_.begin() + static_cast<std::ptrdiff_t>(batch.count),
                      [](const Hit& hit) { return hit.found(); }));
  }
  shade_batch<kShadows>(job, std::span(own.rays).first(own.count),
                        std::span(own.hits).first(own.count), kind);
  for (std::size_t i = 0; i < own.count; ++i) {
    bounces_->light[own.pixels[i]] += own.weights[i] * colors_[i];
  }
  if (depth == levels_.size()) return;
  // The deeper batches use the scratch space again, and levels further down.
  const Level& next = levels_[depth];
  if (next.reflections.count > 0) {
    trace<kShadows>(job, next.reflections, next.reflections.count, RayKind::reflection, depth + 1);
  }
  if (next.refractions.count > 0) {
    trace<kShadows>(job, next.refractions, next.refractions.count, RayKind::refraction, depth + 1);
  }
}

void PathWorker::scatter_batch(const PathJob& job, const Queue& batch, std::size_t depth) {
  const Bounces wanted{.reflections = job.needs.reflections, .refractions = job.needs.refractions};
  const bool at_limit = depth == levels_.size();
  Level* const next = at_limit ? nullptr : &levels_[depth];
  if (next != nullptr) next->reflections.count = next->refractions.count = 0;
  OwnColors& own = bounces_->own;
  own.count = 0;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const Ray& ray = batch.rays[i];
    const Hit& hit = hits_[i];
    const glm::vec3& weight = batch.weights[i];
    const std::uint32_t pixel = batch.pixels[i];
    if (!hit.found()) {
      bounces_->light[pixel] += weight * job.input.scene->background;
      continue;
    }
    const SurfacePoint at = point_hit(job, ray, hit);
    const scene::Triangle& triangle = job.input.triangles->triangles[hit.triangle];
    const Scattering onward =
        scatter(ray, at, material_of(*job.input.scene, triangle), wanted, at_limit, weight);
    if (onward.reflection) next->reflections.push(*onward.reflection, weight, pixel);
    if (onward.refraction) next->refractions.push(*onward.refraction, weight, pixel);
    if (!(onward.own > 0.0F)) continue;
    (*points_)[own.count] = at;
    own.rays[own.count] = ray;
    own.hits[own.count] = hit;
    own.weights[own.count] = weight * onward.own;
    own.pixels[own.count++] = pixel;
  }
}

std::uint64_t PathWorker::bytes() const {
  return sizeof(PathWorker) + (points_ ? sizeof(*points_) : 0) +
         (shadows_ ? sizeof(*shadows_) : 0) + (bounces_ ? sizeof(*bounces_) : 0) +
         levels_.capacity() * sizeof(Level);
}

}  // namespace encore::renderer
