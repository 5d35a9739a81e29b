#include "accel/build_watch.h"

#include <cmath>

namespace encore::accel {

void BuildMeter::look() {
  ++watch_->looks;
  const bool asked = watch_->cancel != nullptr && watch_->cancel->load(std::memory_order_relaxed);
  if (asked || watch_->looks >= watch_->last_look) throw BuildCancelled();
}

double BuildMeter::left(std::uint32_t triangles) {
  const double n = triangles;
  return triangles == 0 ? 0.0 : n * (1.0 + std::log2(n));
}

}  // namespace encore::accel
