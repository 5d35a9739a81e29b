#include "renderer/paths/cpu_paths.h"

namespace encore::renderer {

void CpuPaths::prepare(const RenderInput& input, const scene::Needs& needs,
                       const scene::RaySettings& rays, int workers) {
  const ShadingNeeds shading = shading_needs(needs);
  job_ = {.input = input,
          .needs = needs,
          .rays = rays,
          .shade = choose_shading(shading),
          .shade_shadowed = choose_shadowed_shading(shading)};
  workers_.resize(needs.paths() ? static_cast<std::size_t>(workers) : 0);
  for (auto& worker : workers_) {
    if (worker == nullptr) worker = std::make_unique<PathWorker>();
    worker->fit(job_);
  }
}

void CpuPaths::begin_picture() {
  for (const auto& worker : workers_) worker->begin_picture();
}

bool CpuPaths::draw_tile(const CameraFrame& frame, const PixelRect& tile,
                         const SampleRange& samples, int worker, const std::atomic<bool>* cancel,
                         std::span<glm::vec3> colors) {
  return workers_[static_cast<std::size_t>(worker)]->draw_tile(job_, frame, tile, samples, cancel,
                                                               colors);
}

RayFigures CpuPaths::figures() const {
  RayFigures sum;
  for (const auto& worker : workers_) add_figures(sum, worker->figures());
  return sum;
}

std::uint64_t CpuPaths::camera_hits() const {
  std::uint64_t sum = 0;
  for (const auto& worker : workers_) sum += worker->camera_hits();
  return sum;
}

std::uint64_t CpuPaths::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& worker : workers_) sum += worker->bytes();
  return sum;
}

}  // namespace encore::renderer
