// bvh-sah, rectangles of rays in packets of 64.
#include "accel/kernels/wide_tile_doubts.h"
#include "accel/kernels/wide_tile_exact.h"
#include "accel/kernels/wide_tile_trace.h"
#include "accel/wide/wide_kernels.h"

namespace encore::accel::ENCORE_ISA {

const WideSingleKernels& single_kernels();
const WideTileKernels& tile_kernels();

namespace {

template <class Tester, bool kAnyHit>
bool trace_packet(const TraceScene& scene, RayPacket& packet) {
  if (!fill_idle_rays(packet)) return true;
  PacketFrustums frustums;
  if (!frustums.set(packet)) return false;
  if constexpr (Tester::kFilter) set_settling(packet, frustums.common_origin);
  return frustums.common_origin
             ? PacketTrace<Tester, kAnyHit, true>(scene, packet, frustums).run()
             : PacketTrace<Tester, kAnyHit, false>(scene, packet, frustums).run();
}

/// The rays of one packet, side by side: single rays are quick only in batches.
template <class Answer>
class LonePacket {
 public:
  /// Calls trace(rays, answers, count) for `rows` times `columns` rays of a rectangle.
  template <class Trace>
  [[gnu::always_inline]] void trace(const scene::Ray* rays, Answer* answers, std::size_t width,
                                    std::size_t columns, std::size_t rows, const Trace& trace) {
    for (std::size_t row = 0; row < rows; ++row) {
      __builtin_memcpy(rays_ + row * columns * sizeof(scene::Ray), rays + row * width,
                       columns * sizeof(scene::Ray));
    }
    trace(reinterpret_cast<const scene::Ray*>(rays_), reinterpret_cast<Answer*>(answers_),
          rows * columns);
    for (std::size_t row = 0; row < rows; ++row) {
      __builtin_memcpy(answers + row * width, answers_ + row * columns * sizeof(Answer),
                       columns * sizeof(Answer));
    }
  }

 private:
  // Bytes, as constructors would be functions that others share.
  alignas(64) std::byte rays_[kPacketRays * sizeof(scene::Ray)];
  alignas(64) std::byte answers_[kPacketRays * sizeof(Answer)];
};

/// Calls together(first ray) for all packets of a rectangle. For those of which it returns false,
/// the rays go alone(rays, answers, count): a whole band of packets at once where none goes
/// together.
template <class Answer, class Together, class Alone>
[[gnu::always_inline]] inline void for_packets(const scene::Ray* rays, Answer* answers,
                                               std::size_t width, std::size_t height,
                                               RayPacket& packet, const Together& together,
                                               const Alone& alone) {
  std::uint32_t columns = 8;
  while (columns > 1 && columns / 2 >= width) columns /= 2;
  while (columns < kPacketRays && kPacketRays / columns / 2 >= height) columns *= 2;
  const std::uint32_t rows = kPacketRays / columns;
  std::uint32_t set_columns = 0, set_rows = 0;
  LonePacket<Answer> lone;
  const auto alone_in = [&](std::size_t y, std::size_t x, std::size_t has_rows) {
    const std::size_t has_columns = width - x < columns ? width - x : columns;
    const std::size_t first = y * width + x;
    lone.trace(rays + first, answers + first, width, has_columns, has_rows, alone);
  };
  for (std::size_t y = 0; y < height; y += rows) {
    const auto has_rows = static_cast<std::uint32_t>(height - y < rows ? height - y : rows);
    // Until the first packet that goes together, those that do not are only counted.
    bool any = false;
    std::size_t left = 0;
    for (std::size_t x = 0; x < width; x += columns) {
      const auto has_columns =
          static_cast<std::uint32_t>(width - x < columns ? width - x : columns);
      if (has_rows != set_rows || has_columns != set_columns) {
        set_places(width, columns, has_columns, has_rows, packet.place);
        set_rows = has_rows;
        set_columns = has_columns;
      }
      prefetch_packet(rays, answers, x, y, width, columns, rows);
      if (together(y * width + x)) {
        for (std::size_t k = 0; k < left; ++k) alone_in(y, k * columns, has_rows);
        left = 0;
        any = true;
      } else if (any) {
        alone_in(y, x, has_rows);
      } else {
        ++left;
      }
    }
    if (left > 0) alone(rays + y * width, answers + y * width, has_rows * width);
  }
}

/// How a mode finds hits and what it then tells of them.
struct MollerTrumborePlan {
  using Tester = MollerTrumborePackets;
  static void finish(const TraceScene& /*scene*/, RayPacket& /*packet*/) {}
};
struct PrecisePlan {
  using Tester = DoubtingPackets<true>;
  static void finish(const TraceScene& scene, RayPacket& packet) { settle_precise(scene, packet); }
};
struct WatertightPlan {
  using Tester = DoubtingPackets<false>;
  static void finish(const TraceScene& /*scene*/, RayPacket& /*packet*/) {}
};

template <class Plan, int kMode>
void intersect(const WideView& tree, const scene::Triangle* triangles, const scene::Ray* rays,
               std::size_t width, std::size_t height, scene::Hit* hits) {
  const auto single = single_kernels().intersect[kMode];
  if (tree.node_count == 0) return single(tree, triangles, rays, width * height, hits);
  RayPacket packet;
  const auto together = [&](std::size_t first) {
    const TraceScene scene{tree, triangles, rays + first};
    load_rays(scene.rays, packet);
    if (!trace_packet<typename Plan::Tester, false>(scene, packet)) return false;
    Plan::finish(scene, packet);
    store_hits(packet, hits + first);
    return true;
  };
  for_packets(rays, hits, width, height, packet, together,
              [&](const scene::Ray* from, scene::Hit* to, std::size_t count) {
                single(tree, triangles, from, count, to);
              });
}

template <class Tester, int kMode>
void occluded(const WideView& tree, const scene::Triangle* triangles, const scene::Ray* rays,
              std::size_t width, std::size_t height, std::uint8_t* blocked) {
  const auto single = single_kernels().occluded[kMode];
  if (tree.node_count == 0) return single(tree, triangles, rays, width * height, blocked);
  RayPacket packet;
  const auto together = [&](std::size_t first) {
    const TraceScene scene{tree, triangles, rays + first};
    load_rays(scene.rays, packet);
    if (!trace_packet<Tester, true>(scene, packet)) return false;
    store_blocked(packet, blocked + first);
    return true;
  };
  for_packets(rays, blocked, width, height, packet, together,
              [&](const scene::Ray* from, std::uint8_t* to, std::size_t count) {
                single(tree, triangles, from, count, to);
              });
}

}  // namespace

const WideTileKernels& tile_kernels() {
  static constexpr WideTileKernels kernels{
      {intersect<PrecisePlan, 0>, intersect<MollerTrumborePlan, 1>, intersect<WatertightPlan, 2>},
      {occluded<DoubtingPackets<true>, 0>, occluded<MollerTrumborePackets, 1>,
       occluded<DoubtingPackets<true>, 2>}};
  return kernels;
}

}  // namespace encore::accel::ENCORE_ISA
