#include "app/accuracy/configuration_tracers.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace encore::app {

ConfigurationTracers::ConfigurationTracers(const scene::Scene& scene,
                                           const scene::TriangleList& triangles,
                                           WorkloadTools tools, const std::atomic<bool>& stop)
    : scene_(scene), triangles_(triangles), tools_(std::move(tools)), stop_(stop) {}

accel::AccelerationStructure& ConfigurationTracers::structure_of(const accel::StructureSpec& spec) {
  accel::StructureSpec build = spec;
  build.intersection = accel::IntersectionMode::precise;
  build.grouping = accel::RayGrouping::packets;
  auto found = std::find_if(built_.begin(), built_.end(),
                            [&](const Built& one) { return one.spec == build; });
  if (found == built_.end()) {
    auto structure = tools_.make_structure(build);
    structure->build(triangles_.triangles);
    built_.push_back({build, std::move(structure)});
    found = built_.end() - 1;
  }
  found->structure->set_intersection(spec.intersection);
  found->structure->set_grouping(spec.grouping);
  return *found->structure;
}

ConfigurationTracers::Made& ConfigurationTracers::make(
    const WorkloadSpec& spec, const accel::AccelerationStructure& structure) {
  Made made{spec.device, spec.threads, spec.structure, spec.rays, nullptr, nullptr};
  made.renderer = tools_.make_renderer(spec.device, spec.threads);
  made.tracer = dynamic_cast<renderer::Tracer*>(made.renderer.get());
  if (made.tracer == nullptr) throw std::logic_error("accuracy is of devices that trace rays");
  made.tracer->set_cancel_flag(&stop_);
  made.tracer->set_rays(spec.rays);
  made.tracer->init({&scene_, &triangles_, &structure});
  made_.push_back(std::move(made));
  return made_.back();
}

renderer::Tracer& ConfigurationTracers::ready(const WorkloadSpec& spec) {
  const accel::AccelerationStructure& structure = structure_of(spec.structure);
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const Made& one) {
    return one.device == spec.device && one.threads == spec.threads && one.spec == spec.structure;
  });
  Made& made = found == made_.end() ? make(spec, structure) : *found;
  if (made.rays != spec.rays) {
    made.rays = spec.rays;
    made.tracer->set_rays(spec.rays);
    made.tracer->refresh();
  }
  return *made.tracer;
}

}  // namespace encore::app
