#include "app/bench/embree.h"

#if defined(ENCORE_HAVE_EMBREE)

#include "app/bench/embree_library.h"

#include <atomic>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace encore::app::bench {

namespace {

/// Embree reads our triangles where they lie: three vertices of 16 bytes each.
constexpr std::size_t kVertexBytes = 16;
static_assert(sizeof(scene::Triangle) == 3 * kVertexBytes);

const EmbreeLibrary& rtc() {
  return *EmbreeLibrary::get();
}

RTCBuildQuality native(EmbreeQuality quality) {
  switch (quality) {
    case EmbreeQuality::low:
      return RTC_BUILD_QUALITY_LOW;
    case EmbreeQuality::medium:
      return RTC_BUILD_QUALITY_MEDIUM;
    default:
      return RTC_BUILD_QUALITY_HIGH;
  }
}

RTCSceneFlags flags_of(const EmbreeSettings& settings) {
  int flags = RTC_SCENE_FLAG_NONE;
  if (settings.robust) flags |= RTC_SCENE_FLAG_ROBUST;
  if (settings.compact) flags |= RTC_SCENE_FLAG_COMPACT;
  if (settings.refit || settings.dynamic) flags |= RTC_SCENE_FLAG_DYNAMIC;
  return static_cast<RTCSceneFlags>(flags);
}

}  // namespace

struct EmbreeDevice::Handles {
  RTCDevice device = nullptr;
  std::vector<std::uint32_t> indices;  ///< 0, 1, 2 …: shared by all its scenes
  std::atomic<std::int64_t> bytes{0};
  std::atomic<std::int64_t> peak{0};

  static bool note(void* self, ssize_t change, bool /*post*/) {
    auto& handles = *static_cast<Handles*>(self);
    const std::int64_t now = handles.bytes += change;
    std::int64_t peak = handles.peak;
    while (now > peak && !handles.peak.compare_exchange_weak(peak, now)) {
    }
    return true;
  }
};

EmbreeDevice::EmbreeDevice(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}

std::unique_ptr<EmbreeDevice> EmbreeDevice::open(int threads) {
  if (EmbreeLibrary::get() == nullptr) return nullptr;
  auto handles = std::make_unique<Handles>();
  const std::string options = "threads=" + std::to_string(threads) + ",set_affinity=0";
  handles->device = rtc().rtcNewDevice(options.c_str());
  if (handles->device == nullptr) return nullptr;
  rtc().rtcSetDeviceMemoryMonitorFunction(handles->device, Handles::note, handles.get());
  return std::unique_ptr<EmbreeDevice>(new EmbreeDevice(std::move(handles)));
}

EmbreeDevice::~EmbreeDevice() {
  rtc().rtcReleaseDevice(handles_->device);
}

std::string EmbreeDevice::version() const {
  const auto part = [&](RTCDeviceProperty property) {
    return std::to_string(rtc().rtcGetDeviceProperty(handles_->device, property));
  };
  return part(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + '.' + part(RTC_DEVICE_PROPERTY_VERSION_MINOR) +
         '.' + part(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

std::uint64_t EmbreeDevice::bytes() const {
  return static_cast<std::uint64_t>(handles_->bytes.load());
}

std::uint64_t EmbreeDevice::peak_bytes() const {
  return static_cast<std::uint64_t>(handles_->peak.load());
}

void EmbreeDevice::forget_peak() {
  handles_->peak = handles_->bytes.load();
}

struct EmbreeScene::Handles {
  EmbreeDevice::Handles& device;
  EmbreeSettings settings;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  std::size_t built = 0;  ///< triangles

  void clear() {
    if (geometry != nullptr) rtc().rtcReleaseGeometry(geometry);
    if (scene != nullptr) rtc().rtcReleaseScene(scene);
    geometry = nullptr;
    scene = nullptr;
  }
  void set_vertices(std::span<const scene::Triangle> triangles) const {
    rtc().rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                     triangles.data(), 0, kVertexBytes, 3 * triangles.size());
  }
};

EmbreeScene::EmbreeScene(EmbreeDevice& device, const EmbreeSettings& settings)
    : handles_(new Handles{device.handles(), settings}) {}

EmbreeScene::~EmbreeScene() {
  handles_->clear();
}

void EmbreeScene::build(std::span<const scene::Triangle> triangles) {
  Handles& h = *handles_;
  if (h.settings.dynamic && h.scene != nullptr && h.built == triangles.size()) {
    return refit(triangles);
  }
  h.clear();
  h.built = triangles.size();
  if (h.device.indices.size() < 3 * triangles.size()) {
    h.device.indices.resize(3 * triangles.size());
    std::iota(h.device.indices.begin(), h.device.indices.end(), 0U);
  }
  const RTCBuildQuality quality =
      h.settings.refit ? RTC_BUILD_QUALITY_LOW : native(h.settings.quality);
  h.scene = rtc().rtcNewScene(h.device.device);
  rtc().rtcSetSceneFlags(h.scene, flags_of(h.settings));
  rtc().rtcSetSceneBuildQuality(h.scene, quality);
  h.geometry = rtc().rtcNewGeometry(h.device.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree refits only in scenes of low quality; others are silently built again.
  rtc().rtcSetGeometryBuildQuality(h.geometry,
                                   h.settings.refit ? RTC_BUILD_QUALITY_REFIT : quality);
  rtc().rtcSetSharedGeometryBuffer(h.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   h.device.indices.data(), 0, 3 * sizeof(std::uint32_t),
                                   triangles.size());
  h.set_vertices(triangles);
  rtc().rtcCommitGeometry(h.geometry);
  rtc().rtcAttachGeometry(h.scene, h.geometry);
  rtc().rtcCommitScene(h.scene);
}

void EmbreeScene::refit(std::span<const scene::Triangle> triangles) {
  handles_->set_vertices(triangles);
  rtc().rtcUpdateGeometryBuffer(handles_->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtc().rtcCommitGeometry(handles_->geometry);
  rtc().rtcCommitScene(handles_->scene);
}

namespace {

RTCRay single_ray(const scene::Ray& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x;
  result.org_y = ray.origin.y;
  result.org_z = ray.origin.z;
  result.tnear = ray.t_min;
  result.dir_x = ray.direction.x;
  result.dir_y = ray.direction.y;
  result.dir_z = ray.direction.z;
  result.tfar = ray.t_max;
  result.mask = 0xFFFFFFFFU;
  return result;
}

/// Lanes [from, from + size of the arrays of `query`) of a packet.
template <class Query>
void fill(const RayPacket& packet, std::size_t from, Query& query) {
  constexpr std::size_t kBytes = sizeof query.org_x;
  std::memcpy(query.org_x, packet.origin[0] + from, kBytes);
  std::memcpy(query.org_y, packet.origin[1] + from, kBytes);
  std::memcpy(query.org_z, packet.origin[2] + from, kBytes);
  std::memcpy(query.dir_x, packet.direction[0] + from, kBytes);
  std::memcpy(query.dir_y, packet.direction[1] + from, kBytes);
  std::memcpy(query.dir_z, packet.direction[2] + from, kBytes);
  std::memcpy(query.tnear, packet.t_min + from, kBytes);
  std::memcpy(query.tfar, packet.t_max + from, kBytes);
  std::memset(query.time, 0, kBytes);
  std::memset(query.mask, 0xFF, kBytes);
  std::memset(query.flags, 0, kBytes);
}

template <class Query, class Call>
void trace_nearest(const RayPacket& packet, std::size_t from, const Call& call, HitPacket& out) {
  Query query;
  fill(packet, from, query.ray);
  constexpr std::size_t kBytes = sizeof query.hit.primID;
  std::memset(query.hit.geomID, 0xFF, kBytes);
  std::memset(query.hit.primID, 0xFF, kBytes);
  call(packet.valid + from, &query);
  std::memcpy(out.t + from, query.ray.tfar, kBytes);
  std::memcpy(out.triangle + from, query.hit.primID, kBytes);
  std::memcpy(out.u + from, query.hit.u, kBytes);
  std::memcpy(out.v + from, query.hit.v, kBytes);
}

template <class Query, class Call>
void trace_any(const RayPacket& packet, std::size_t from, const Call& call, HitPacket& out) {
  Query query;
  fill(packet, from, query);
  call(packet.valid + from, &query);
  // Blocked rays come back with tfar = -inf.
  for (std::size_t i = 0; i < sizeof query.tfar / sizeof(float); ++i) {
    out.triangle[from + i] = query.tfar[i] < 0.0F ? 0 : scene::kNoHit;
  }
}

RTCIntersectContext context_for(EmbreePackets packets) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const bool coherent =
      packets == EmbreePackets::eight_coherent || packets == EmbreePackets::sixteen_coherent;
  context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

void trace_packet(RTCScene scene, const EmbreeRays& rays, bool sixteen,
                  RTCIntersectContext& context, std::size_t k, HitPacket& out) {
  const RayPacket& packet = rays.packets[k];
  if (sixteen) {
    if (rays.any_hit) {
      trace_any<RTCRay16>(
          packet, 0,
          [&](const int* valid, RTCRay16* q) { rtc().rtcOccluded16(valid, scene, &context, q); },
          out);
    } else {
      trace_nearest<RTCRayHit16>(
          packet, 0,
          [&](const int* valid, RTCRayHit16* q) {
            rtc().rtcIntersect16(valid, scene, &context, q);
          },
          out);
    }
    return;
  }
  for (std::size_t from = 0; from < RayPacket::kSize; from += 8) {
    if (rays.any_hit) {
      trace_any<RTCRay8>(
          packet, from,
          [&](const int* valid, RTCRay8* q) { rtc().rtcOccluded8(valid, scene, &context, q); },
          out);
    } else {
      trace_nearest<RTCRayHit8>(
          packet, from,
          [&](const int* valid, RTCRayHit8* q) { rtc().rtcIntersect8(valid, scene, &context, q); },
          out);
    }
  }
}

}  // namespace

void EmbreeScene::intersect(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) const {
  RTCIntersectContext context = context_for(EmbreePackets::one);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit query{};
    query.ray = single_ray(rays[i]);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = scene::kNoHit;
    rtc().rtcIntersect1(handles_->scene, &context, &query);
    hits[i] = {query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
  }
}

void EmbreeScene::occluded(std::span<const scene::Ray> rays,
                           std::span<std::uint8_t> blocked) const {
  RTCIntersectContext context = context_for(EmbreePackets::one);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRay query = single_ray(rays[i]);
    rtc().rtcOccluded1(handles_->scene, &context, &query);
    blocked[i] = query.tfar < 0.0F ? 1 : 0;
  }
}

void EmbreeScene::trace(const EmbreeRays& rays, EmbreePackets packets, std::size_t first_tile,
                        std::size_t end_tile, std::span<HitPacket> hits) const {
  RTCIntersectContext context = context_for(packets);
  const bool sixteen =
      packets == EmbreePackets::sixteen || packets == EmbreePackets::sixteen_coherent;
  for (std::size_t k = rays.first[first_tile]; k < rays.first[end_tile]; ++k) {
    trace_packet(handles_->scene, rays, sixteen, context, k, hits[k]);
  }
}

void EmbreeScene::trace(const RayPacket& packet, HitPacket& hits) const {
  RTCIntersectContext context = context_for(EmbreePackets::sixteen_coherent);
  trace_nearest<RTCRayHit16>(
      packet, 0,
      [&](const int* valid, RTCRayHit16* q) {
        rtc().rtcIntersect16(valid, handles_->scene, &context, q);
      },
      hits);
}

}  // namespace encore::app::bench

#endif
