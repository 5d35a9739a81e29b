#pragma once

#include "app/bench/ray_set.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Embree 3 (Wald et al. 2014) as the peer. Where the program was built without its headers, or the
/// library is not installed, there is no device, and nothing else here may be called.
namespace encore::app::bench {

enum class EmbreeQuality { low, medium, high };
/// "LOW", "MEDIUM", "HIGH".
std::string_view to_string(EmbreeQuality quality);

/// How many rays go at once, and what Embree is told of them.
enum class EmbreePackets { one, eight_coherent, eight, sixteen_coherent, sixteen };
/// "1", "8 coherent", "8", …
std::string_view to_string(EmbreePackets packets);
const std::vector<EmbreePackets>& all_embree_packets();

/// What a scene is made for.
struct EmbreeSettings {
  EmbreeQuality quality = EmbreeQuality::medium;
  bool robust = false;   ///< RTC_SCENE_FLAG_ROBUST: watertight
  bool compact = false;  ///< RTC_SCENE_FLAG_COMPACT
  bool refit = false;    ///< geometry of RTC_BUILD_QUALITY_REFIT in a dynamic scene; quality is low
  /// RTC_SCENE_FLAG_DYNAMIC, and builds after the first are new commits of the same scene, which
  /// keeps its memory.
  bool dynamic = false;
};
/// "Embree MEDIUM robust".
std::string embree_name(const EmbreeSettings& settings);

/// Sixteen rays side by side, as structure of arrays.
struct alignas(64) RayPacket {
  /// Lane `lane` from now on.
  void put(const scene::Ray& ray, std::size_t lane);

  static constexpr std::size_t kSize = 16;
  float origin[3][kSize];
  float direction[3][kSize];
  float t_min[kSize];
  float t_max[kSize];
  int valid[kSize];  ///< -1, or 0 for none
};
struct alignas(64) HitPacket {
  float t[RayPacket::kSize];
  std::uint32_t triangle[RayPacket::kSize];  ///< rays that ask for any hit: 0 if blocked, or kNoHit
  float u[RayPacket::kSize];
  float v[RayPacket::kSize];
};

/// A set of rays as Embree takes them best: 4 x 4 neighbouring pixels a packet, made beforehand;
/// pixels without a ray are left out and the next ones move up.
struct EmbreeRays {
  explicit EmbreeRays(const RaySet& set);

  bool any_hit;
  std::vector<RayPacket> packets;
  std::vector<std::size_t> first;    ///< packet of each tile, and one more
  std::vector<std::uint32_t> index;  ///< into RaySet::rays, of each lane of each packet
  [[nodiscard]] std::size_t tile_count() const { return first.size() - 1; }
  /// Whether each of RaySet::rays found something, out of what EmbreeScene::trace() wrote.
  [[nodiscard]] std::vector<std::uint8_t> found(std::span<const HitPacket> hits) const;
};

class EmbreeDevice {
 public:
  /// With so many threads; as long as it lives the whole process has no more. Null if there is no
  /// Embree here.
  static std::unique_ptr<EmbreeDevice> open(int threads);
  ~EmbreeDevice();

  /// "3.13.5"
  [[nodiscard]] std::string version() const;
  /// Bytes that its scenes hold, and the most that they held since forget_peak().
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] std::uint64_t peak_bytes() const;
  void forget_peak();

  struct Handles;
  [[nodiscard]] Handles& handles() const { return *handles_; }

 private:
  explicit EmbreeDevice(std::unique_ptr<Handles> handles);
  std::unique_ptr<Handles> handles_;
};

/// One scene of one mesh, which reads our triangles where they lie.
class EmbreeScene {
 public:
  EmbreeScene(EmbreeDevice& device, const EmbreeSettings& settings);
  ~EmbreeScene();

  /// Builds a fresh scene, or with EmbreeSettings::dynamic the one that there is anew; the
  /// triangles must outlive it.
  void build(std::span<const scene::Triangle> triangles);
  /// Only with EmbreeSettings::refit: fits the boxes to as many triangles as were built.
  void refit(std::span<const scene::Triangle> triangles);

  /// Nearest hits, one ray after the other.
  void intersect(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) const;
  void occluded(std::span<const scene::Ray> rays, std::span<std::uint8_t> blocked) const;
  /// The rays of some tiles of a set, in packets; hits.size() == rays.packets.size(). For
  /// EmbreePackets::one see the two above.
  void trace(const EmbreeRays& rays, EmbreePackets packets, std::size_t first_tile,
             std::size_t end_tile, std::span<HitPacket> hits) const;
  /// The nearest hits of one packet of coherent rays.
  void trace(const RayPacket& packet, HitPacket& hits) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace encore::app::bench
