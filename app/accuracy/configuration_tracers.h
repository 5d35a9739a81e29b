#pragma once

#include "accel/acceleration_structure.h"
#include "app/workloads.h"
#include "renderer/renderer.h"
#include "scene/ray_settings.h"
#include "scene/triangles.h"

#include <atomic>
#include <memory>
#include <vector>

namespace encore::app {

/// The structures and tracers of several configurations over the same triangles. Each is made when
/// it is first asked for and kept, so that configurations can be drawn by turns without building or
/// sending anything in between. One structure serves all intersection modes. Used by one thread.
class ConfigurationTracers {
 public:
  /// `scene`, `triangles` and `stop`, which ends pictures early, must outlive this.
  ConfigurationTracers(const scene::Scene& scene, const scene::TriangleList& triangles,
                       WorkloadTools tools, const std::atomic<bool>& stop);

  /// The tracer of a configuration, ready to draw it; what else was asked for is ready no more.
  /// Throws as the renderer of its device, and std::logic_error for one that traces no rays.
  renderer::Tracer& ready(const WorkloadSpec& spec);

 private:
  struct Built {
    accel::StructureSpec spec;  ///< in mode `precise`, whatever the mode in use
    std::unique_ptr<accel::AccelerationStructure> structure;
  };
  struct Made {
    Device device = Device::cpu;
    int threads = 0;
    accel::StructureSpec spec;
    scene::RaySettings rays;
    std::unique_ptr<renderer::Renderer> renderer;
    renderer::Tracer* tracer = nullptr;
  };
  accel::AccelerationStructure& structure_of(const accel::StructureSpec& spec);
  Made& make(const WorkloadSpec& spec, const accel::AccelerationStructure& structure);

  const scene::Scene& scene_;
  const scene::TriangleList& triangles_;
  WorkloadTools tools_;
  const std::atomic<bool>& stop_;
  std::vector<Built> built_;
  std::vector<Made> made_;
};

}  // namespace encore::app
