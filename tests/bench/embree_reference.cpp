#include "tests/bench/embree_reference.h"

#include <embree3/rtcore.h>

#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace encore::bench {

namespace {

/// Embree reads our triangles where they lie: three vertices of 16 bytes each.
constexpr std::size_t kVertexBytes = 16;
static_assert(sizeof(scene::Triangle) == 3 * kVertexBytes);

}  // namespace

struct EmbreeReference::Handles {
  RTCBuildQuality quality;
  RTCDevice device;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  std::vector<std::uint32_t> indices;

  void clear() {
    if (geometry) rtcReleaseGeometry(geometry);
    if (scene) rtcReleaseScene(scene);
    geometry = nullptr;
    scene = nullptr;
  }
  void set_vertices(std::span<const scene::Triangle> triangles) const {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               triangles.data(), 0, kVertexBytes, 3 * triangles.size());
  }
  void commit(std::span<const scene::Triangle> triangles, RTCSceneFlags flags,
              RTCBuildQuality scene_quality, RTCBuildQuality geometry_quality) {
    clear();
    indices.resize(3 * triangles.size());
    std::iota(indices.begin(), indices.end(), 0U);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, flags);
    rtcSetSceneBuildQuality(scene, scene_quality);
    geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, geometry_quality);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(),
                               0, 3 * sizeof(std::uint32_t), triangles.size());
    set_vertices(triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
  }
};

EmbreeReference::EmbreeReference(Quality quality) : handles_(std::make_unique<Handles>()) {
  handles_->quality = quality == Quality::low ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
  handles_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (!handles_->device) throw std::runtime_error("Embree does not start on this machine");
}

EmbreeReference::~EmbreeReference() {
  handles_->clear();
  rtcReleaseDevice(handles_->device);
}

void EmbreeReference::build(std::span<const scene::Triangle> triangles) {
  handles_->commit(triangles, RTC_SCENE_FLAG_NONE, handles_->quality, handles_->quality);
}

void EmbreeReference::build_refittable(std::span<const scene::Triangle> triangles) {
  // Embree refits only in scenes of low quality; others are silently built again.
  handles_->commit(triangles, RTC_SCENE_FLAG_DYNAMIC, RTC_BUILD_QUALITY_LOW,
                   RTC_BUILD_QUALITY_REFIT);
}

void EmbreeReference::refit(std::span<const scene::Triangle> triangles) {
  handles_->set_vertices(triangles);
  rtcUpdateGeometryBuffer(handles_->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(handles_->geometry);
  rtcCommitScene(handles_->scene);
}

void EmbreeReference::intersect(std::span<const scene::Ray> rays,
                                std::span<scene::Hit> hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const scene::Ray& ray = rays[i];
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x;
    query.ray.org_y = ray.origin.y;
    query.ray.org_z = ray.origin.z;
    query.ray.tnear = ray.t_min;
    query.ray.dir_x = ray.direction.x;
    query.ray.dir_y = ray.direction.y;
    query.ray.dir_z = ray.direction.z;
    query.ray.tfar = ray.t_max;
    query.ray.mask = 0xFFFFFFFFU;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = scene::kNoHit;
    rtcIntersect1(handles_->scene, &context, &query);
    hits[i] = {query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
  }
}

}  // namespace encore::bench
