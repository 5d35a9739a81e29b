#pragma once

#include "accel/make_structure.h"
#include "renderer/cpu_tracer.h"
#include "renderer/raster_renderer.h"
#include "tests/renderer/test_scenes.h"

#include <cmath>
#include <memory>

namespace encore::renderer::test {

/// The CPU tracer's picture of what a renderer was given without a structure.
inline Image traced_picture(const scene::Scene& scene, const scene::TriangleList& list,
                            const scene::Camera& camera, int width, int height) {
  const auto structure =
      accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  structure->build(list.triangles);
  CpuTracer tracer;
  tracer.init({&scene, &list, structure.get()});
  Image image;
  image.resize(width, height);
  tracer.render(camera, image);
  return image;
}

inline Image raster_picture(std::shared_ptr<gl::Context> context, const scene::Scene& scene,
                            const scene::TriangleList& list, const scene::Camera& camera, int width,
                            int height) {
  RasterRenderer raster(std::move(context));
  raster.init({&scene, &list, nullptr});
  Image image;
  image.resize(width, height);
  raster.render(camera, image);
  return image;
}

/// Multiplies every length in the scene by 2^exponent; its picture must stay as it is.
inline void scale_scene(TestScene& setup, int exponent) {
  const float factor = std::ldexp(1.0F, exponent);
  for (scene::Triangle& triangle : setup.list.triangles) {
    triangle.v0 *= factor;
    triangle.v1 *= factor;
    triangle.v2 *= factor;
  }
  for (scene::Light& light : setup.scene.lights) light.position *= factor;
  setup.scene.camera.eye *= factor;
  setup.scene.camera.target *= factor;
}

}  // namespace encore::renderer::test
