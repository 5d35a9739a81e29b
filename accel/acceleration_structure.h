#pragma once

#include "accel/build_watch.h"
#include "accel/counters.h"
#include "accel/gpu_buffers.h"
#include "accel/inspect/ray_path.h"
#include "accel/inspect/ray_recording.h"
#include "accel/settings.h"
#include "accel/stats.h"
#include "accel/triangle_tester.h"
#include "scene/bounds.h"
#include "scene/ray.h"
#include "scene/triangle.h"
#include "shaders/shared/gpu_types.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

namespace encore::accel {

using scene::Bounds;
using scene::Hit;
using scene::kNoHit;
using scene::Ray;
using scene::Triangle;

/// One node, cell or leaf as a visitor sees it.
struct NodeView {
  Bounds bounds;  ///< the space it stands for
  std::uint32_t depth = 0;
  bool leaf = false;
  int split_axis = -1;                       ///< kd-tree inner nodes only
  float split_position = 0;                  ///< kd-tree inner nodes only
  std::span<const std::uint32_t> triangles;  ///< leaves only
  /// What trace_path() calls this node: a number of its own, at most a few times the number of
  /// nodes (grids: of cells). A refit does not change it.
  std::uint32_t place = 0;
};

/// The interface of every acceleration structure (thesis, appendix B).
///
/// The triangles stay the caller's: they must outlive the structure's use and may change only
/// before the next build() or update(). All triangles must be finite. Rays are traced in batches,
/// one virtual call each; all const members may be called from several threads at once.
///
/// The hit contract, the same for every structure: of all triangles that decide_hit()
/// (triangle_hit.h) accepts, the one with the smallest t, at equal t the lowest index. No structure
/// may lose or add a hit; traversal is conservative by rounding bounds, never by fixed epsilons.
/// IntersectionMode::watertight finds the very same triangles, with t, u and v of single precision
/// (triangle_watertight.h), bit for bit the same in every structure; moller_trumbore promises
/// neither (triangle_moller_trumbore.h).
class AccelerationStructure {
 public:
  virtual ~AccelerationStructure() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;

  /// Builds the structure over the triangles from scratch. Zero triangles are valid. Throws
  /// BuildCancelled if set_build_watch() asks for it; after that, or if memory runs out, the
  /// structure is as if built over no triangles: valid, and without a hit.
  virtual void build(std::span<const Triangle> triangles) = 0;

  /// Adapts the structure to triangles that moved; their number and order must be those of the last
  /// build. Structures that cannot are rebuilt.
  virtual void update(std::span<const Triangle> triangles) { build(triangles); }
  [[nodiscard]] virtual bool can_refit() const { return false; }
  /// Looks at how good the structure is as it stands, for decay() and decayed(); to be called after
  /// every build and update whose quality is to be known.
  virtual void assess() {}
  /// Expected cost of a ray now over that right after the last build. Nothing for structures whose
  /// updates lose nothing, and where assess() was not called after the last change or not between
  /// the last build and the first update after it.
  [[nodiscard]] virtual std::optional<double> decay() const { return std::nullopt; }
  /// Expected cost of a ray (SAH) as assess() last saw it; nothing for structures whose updates
  /// lose nothing, and where nobody looked since the last change. Unlike decay() it tells builds at
  /// different times apart: what a fresh structure costs changes as well.
  [[nodiscard]] virtual std::optional<double> assessed_cost() const { return std::nullopt; }
  /// Whether the structure should be built instead of updated (Policy::automatic): decay() has
  /// reached what the settings allow, or is not known though updates cost quality.
  [[nodiscard]] virtual bool decayed() const { return false; }
  /// Who follows the builds from now on and may end them; null: nobody. The watch must outlive
  /// them. Updates that are no builds are short, and a half-updated structure would be wrong: they
  /// are not watched.
  void set_build_watch(BuildWatch* watch) { watch_ = watch; }

  /// By which arithmetic rays are held against triangles from now on. Takes effect at once: nothing
  /// that was built depends on it.
  void set_intersection(IntersectionMode mode) { intersection_ = mode; }
  [[nodiscard]] IntersectionMode intersection() const { return intersection_; }

  /// Whether intersect_tile() and occluded_tile() may take rays together. Takes effect at once.
  void set_grouping(RayGrouping grouping) { grouping_ = grouping; }
  [[nodiscard]] RayGrouping grouping() const { return grouping_; }

  /// How many threads builds and updates may use, the caller's among them; 0: as many as the
  /// calling thread's arena has. What is built does not depend on it.
  void set_build_threads(int threads) { build_threads_ = threads; }
  [[nodiscard]] int build_threads() const { return build_threads_; }

  /// Finds the nearest hit of each ray; hits.size() == rays.size().
  virtual void intersect(std::span<const Ray> rays, std::span<Hit> hits) const = 0;
  /// The same, and what each ray cost; counters.size() == rays.size(), overwritten.
  virtual void intersect_counted(std::span<const Ray> rays, std::span<Hit> hits,
                                 std::span<TraceCounters> counters) const = 0;
  /// Whether each ray hits anything at all (any-hit): 1 or 0.
  virtual void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const = 0;

  /// intersect() and occluded() for rays that run side by side: a rectangle of them, row by row,
  /// `width` to a row, neighbours in the rectangle being neighbours in space. The same hits, found
  /// for many rays at once where the structure can and grouping() allows it.
  void intersect_tile(std::span<const Ray> rays, std::size_t width, std::span<Hit> hits) const {
    if (grouping_ == RayGrouping::single) return intersect(rays, hits);
    intersect_together(rays, width, hits);
  }
  void occluded_tile(std::span<const Ray> rays, std::size_t width,
                     std::span<std::uint8_t> blocked) const {
    if (grouping_ == RayGrouping::single) return occluded(rays, blocked);
    occluded_together(rays, width, blocked);
  }

  /// The nearest hit of one ray, the same as intersect()'s, and everything that happens on the way:
  /// the very traversal that intersect_counted() runs, written down. A structure that cannot tell
  /// leaves RayPath::recorded false.
  virtual void trace_path(const Ray& ray, Hit& hit, RayPath& path) const {
    path.clear();
    intersect({&ray, 1}, {&hit, 1});
  }

  /// Figures of the last build and of the structure. Computed when asked, not while building, apart
  /// from what is counted anyway.
  [[nodiscard]] virtual BuildStats stats() const = 0;
  /// What a GPU needs of the structure, valid until the next build or update: the very memory that
  /// the CPU walks, and the few numbers beside it.
  [[nodiscard]] virtual GpuBuffers gpu_buffers() const = 0;
  [[nodiscard]] virtual gpu::StructureParameters gpu_parameters() const { return {}; }
  /// Grows with every build and update: whoever holds a copy compares it to see whether it is old.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Calls `visitor` for every node in depth-first order (grids: every non-empty cell); a visitor
  /// that returns false skips the node's children.
  virtual void visit(const std::function<bool(const NodeView&)>& visitor) const = 0;

 protected:
  /// Every build() and update() calls it.
  void mark_changed() { ++version_; }
  [[nodiscard]] BuildWatch* build_watch() const { return watch_; }

  virtual void intersect_together(std::span<const Ray> rays, std::size_t /*width*/,
                                  std::span<Hit> hits) const {
    intersect(rays, hits);
  }
  virtual void occluded_together(std::span<const Ray> rays, std::size_t /*width*/,
                                 std::span<std::uint8_t> blocked) const {
    occluded(rays, blocked);
  }

 private:
  BuildWatch* watch_ = nullptr;
  IntersectionMode intersection_ = IntersectionMode::precise;
  RayGrouping grouping_ = RayGrouping::packets;
  int build_threads_ = 0;
  std::uint64_t version_ = 0;
};

/// Implements the three batch calls and trace_path() over `Derived::trace<AnyHit, Tester>(ray, hit,
/// counter_policy)`, so that the inner loop is compiled once for each use and no ray pays a virtual
/// call. The tester of the intersection mode (triangle_tester.h) is picked once a batch. `trace`
/// starts from a hit that is a miss with t = ray.t_max and may return early with any hit if AnyHit.
template <class Derived>
class TracedStructure : public AccelerationStructure {
 public:
  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const final {
    with_tester(intersection(), [&]<class Tester>() {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        hits[i] = Hit{.t = rays[i].t_max};
        NotCounting none;
        self().template trace<false, Tester>(rays[i], hits[i], none);
      }
    });
  }
  void intersect_counted(std::span<const Ray> rays, std::span<Hit> hits,
                         std::span<TraceCounters> counters) const final {
    with_tester(intersection(), [&]<class Tester>() {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        hits[i] = Hit{.t = rays[i].t_max};
        counters[i] = {};
        Counting counting{counters[i]};
        self().template trace<false, Tester>(rays[i], hits[i], counting);
      }
    });
  }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const final {
    with_tester(intersection(), [&]<class Tester>() {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        Hit hit{.t = rays[i].t_max};
        NotCounting none;
        self().template trace<true, Tester>(rays[i], hit, none);
        blocked[i] = hit.found() ? 1 : 0;
      }
    });
  }
  void trace_path(const Ray& ray, Hit& hit, RayPath& path) const final {
    hit = Hit{.t = ray.t_max};
    Recording recording(ray, intersection(), path);
    with_tester(intersection(),
                [&]<class Tester>() { self().template trace<false, Tester>(ray, hit, recording); });
    recording.end(hit);
  }

 private:
  [[nodiscard]] const Derived& self() const { return static_cast<const Derived&>(*this); }
};

}  // namespace encore::accel
