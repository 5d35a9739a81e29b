#include "accel/kdtree/kdtree_build_median.h"

namespace encore::accel {

KdSplit KdMedianSplitter::choose(const KdTask& task, std::span<const KdReference>) {
  for (int turn = 1; turn <= 3; ++turn) {
    const int axis = (task.last_axis + turn) % 3;
    const float low = task.box.min[axis];
    const float high = task.box.max[axis];
    // Halving first cannot overflow, and adding 0 turns -0 into 0.
    const float middle = low * 0.5F + high * 0.5F + 0.0F;
    if (low < middle && middle < high) return {.axis = axis, .position = middle};
  }
  return {};
}

}  // namespace encore::accel
