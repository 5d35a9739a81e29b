#include "accel/kdtree/kdtree_build_sah.h"

#include "accel/kdtree/key_sort.h"
#include "accel/shared_meter.h"

#include <algorithm>
#include <limits>

namespace encore::accel {

namespace {

/// The ends of a node's extents on one axis as sortable keys, ascending.
struct Ends {
  std::span<const std::uint32_t> low;
  std::span<const std::uint32_t> high;
  std::span<const std::uint32_t> planar;  ///< of extents without thickness; also in low and high
};

struct Best {
  double cost = std::numeric_limits<double>::infinity();
  float position = 0.0F;
  bool found = false;
  bool planar_below = true;

  void consider(double candidate, float at, bool below) {
    if (candidate < cost) *this = {candidate, at, true, below};
  }
};

/// Sweeps all candidates in ascending order, counting who lies on which side.
Best sweep(const Ends& ends, const SplitCost& cost, float box_min, float box_max,
           std::uint64_t& candidates, BuildMeter& meter) {
  Best best;
  const std::size_t count = ends.low.size();
  std::size_t begun = 0;  // extents that begin below the position
  std::size_t ended = 0;  // extents that end at or below it
  std::size_t planar = 0;
  std::size_t unchecked = 0;
  while (ended < count) {
    if (++unchecked == BuildMeter::kPart) {
      meter.check();
      unchecked = 0;
    }
    std::uint32_t key = ends.high[ended];
    if (begun < count) key = std::min(key, ends.low[begun]);
    while (ended < count && ends.high[ended] == key) ++ended;
    std::size_t in_plane = 0;
    while (planar < ends.planar.size() && ends.planar[planar] == key) ++planar, ++in_plane;

    const float position = float_of_key(key);
    if (position > box_min && position < box_max) {
      const std::size_t above = count - ended;
      best.consider(cost.split(position, begun + in_plane, above), position, true);
      if (in_plane > 0) {
        best.consider(cost.split(position, begun, above + in_plane), position, false);
      }
      ++candidates;
    }
    while (begun < count && ends.low[begun] == key) ++begun;
  }
  return best;
}

}  // namespace

KdSahSplitter::KdSahSplitter(const KdTreeSettings& settings, std::size_t triangle_count,
                             MemoryMode mode, KdSahMemory& memory, BuildMeter& meter,
                             const Workers& workers)
    : settings_(settings),
      capacity_(triangle_count),
      memory_(memory),
      meter_(meter),
      workers_(workers) {
  memory_.forget_counts();
  // Low, high and planar ends, and a second copy for sorting by digits; for several threads two.
  memory_.keys.reset((workers_.parallel() ? 5 : 4) * triangle_count, mode, memory_.allocations);
}

KdSplit KdSahSplitter::choose(const KdTask& task, std::span<const KdReference> references) {
  const int longest = task.box.longest_axis();
  for (int turn = 0; turn < 3; ++turn) {
    const KdSplit split = best_on_axis(task, references, (longest + turn) % 3);
    if (split.axis >= 0) return split;
  }
  return {};
}

std::size_t KdSahSplitter::sort_ends(std::span<const KdReference> references, int axis) {
  const std::size_t count = references.size();
  std::uint32_t* low = memory_.keys.data();
  std::uint32_t* high = low + capacity_;
  std::uint32_t* planar = high + capacity_;
  std::uint32_t* spare = planar + capacity_;
  std::size_t planar_count = 0;
  for (std::size_t i = 0, end = 0; i < count;) {
    for (end = meter_.part_end(i, count); i < end; ++i) {
      low[i] = key_of_float(references[i].min[axis]);
      high[i] = key_of_float(references[i].max[axis]);
      planar[planar_count] = low[i];
      planar_count += low[i] == high[i] ? 1 : 0;
    }
  }
  sort_keys(low, spare, count, &meter_);
  sort_keys(high, spare, count, &meter_);
  sort_keys(planar, spare, planar_count, &meter_);
  return planar_count;
}

std::size_t KdSahSplitter::sort_ends_together(std::span<const KdReference> references, int axis) {
  const std::size_t count = references.size();
  std::uint32_t* low = memory_.keys.data();
  std::uint32_t* high = low + capacity_;
  std::uint32_t* planar = high + capacity_;
  std::uint32_t* spare = planar + capacity_;
  std::size_t planar_count = 0;
  const auto sort_low = [&] {
    TaskMeter own(meter_);
    for (std::size_t i = 0; i < count; ++i) low[i] = key_of_float(references[i].min[axis]);
    sort_keys(low, spare, count, &own.meter());
  };
  const auto sort_high = [&] {
    TaskMeter own(meter_);
    for (std::size_t i = 0; i < count; ++i) {
      high[i] = key_of_float(references[i].max[axis]);
      planar[planar_count] = high[i];
      planar_count += high[i] == key_of_float(references[i].min[axis]) ? 1 : 0;
    }
    sort_keys(high, spare + capacity_, count, &own.meter());
  };
  workers_.both(true, sort_low, sort_high);
  sort_keys(planar, spare, planar_count, &meter_);
  return planar_count;
}

KdSplit KdSahSplitter::best_on_axis(const KdTask& task, std::span<const KdReference> references,
                                    int axis) {
  const std::size_t count = references.size();
  const std::uint32_t* low = memory_.keys.data();
  const std::uint32_t* high = low + capacity_;
  const std::uint32_t* planar = high + capacity_;
  const std::size_t planar_count =
      workers_.parallel() ? sort_ends_together(references, axis) : sort_ends(references, axis);
  memory_.keys_sorted += 2 * count + planar_count;

  const SplitCost cost(task.box, axis, settings_);
  const Best best =
      sweep({{low, count}, {high, count}, {planar, planar_count}}, cost, task.box.min[axis],
            task.box.max[axis], memory_.candidates_examined, meter_);
  if (!best.found) return {};
  return {.axis = axis,
          .position = best.position,
          .planar_below = best.planar_below,
          .worth = best.cost > cost.leaf(count) ? KdSplit::Worth::costs : KdSplit::Worth::pays};
}

}  // namespace encore::accel
