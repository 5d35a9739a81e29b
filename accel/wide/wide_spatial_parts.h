#pragma once

#include "accel/parallel.h"
#include "accel/wide/wide_spatial.h"

#include <cstddef>
#include <cstdint>

namespace encore::accel {

/// A range that several threads go through in parts.
struct WideParts {
  /// No more parts than this, however many items there are.
  static constexpr std::size_t kMost = 64;

  std::size_t items, size, count;
};

/// The items of a range, or of a part of it, by slabs along one axis.
struct WideSlabBins {
  static constexpr std::uint32_t kMost = 16;
  WideBox box[kMost];                        ///< of the items' parts in each slab
  std::uint32_t enter[kMost], leave[kMost];  ///< how many items begin and end there
};

/// split_wide_space() with several threads: the same for any number of them. `bins`: three a part.
bool split_wide_space(const WideSpatial& spatial, const WideItem* items, float object_cost,
                      WideItem* to, WideRange& range, WideRange& other, const WideParts& parts,
                      const Workers& workers, WideSlabBins* bins);

}  // namespace encore::accel
