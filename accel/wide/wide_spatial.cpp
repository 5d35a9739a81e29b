#include "accel/wide/wide_spatial.h"

#include "accel/bvh/four_floats.h"
#include "accel/wide/wide_build_memory.h"
#include "accel/wide/wide_clip.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace encore::accel {

namespace {

constexpr std::uint32_t kMostBins = 16;
constexpr std::uint32_t kBlock = TriangleBlock::kSize;

float half_area(const WideBox& box) {
  const float x = box.ends[0] + box.ends[4], y = box.ends[1] + box.ends[5];
  const float z = box.ends[2] + box.ends[6];
  return (x * y + y * z) + z * x;
}

void extend(WideBox& box, const WideItem& item) {
  for (int k = 0; k < 3; ++k) {
    box.ends[k] = std::min(box.ends[k], item.lower[k]);
    box.ends[k + 4] = std::min(box.ends[k + 4], item.minus_upper[k]);
  }
}

/// Bounds of some points; empty at first.
struct Slice {
  FourFloats lower = FourFloats::all(std::numeric_limits<float>::infinity());
  FourFloats upper = FourFloats::all(-std::numeric_limits<float>::infinity());

  void extend(const FourFloats& point) {
    lower = min(lower, point);
    upper = max(upper, point);
  }
};

/// A triangle that planes across one axis meet.
class Sliced {
 public:
  Sliced(const scene::Triangle& t, int axis)
      : along_{t.v0[axis], t.v1[axis], t.v2[axis]},
        corner_{FourFloats::of(t.v0.x, t.v0.y, t.v0.z, 0.0F),
                FourFloats::of(t.v1.x, t.v1.y, t.v1.z, 0.0F),
                FourFloats::of(t.v2.x, t.v2.y, t.v2.z, 0.0F)} {}

  [[nodiscard]] Slice meet(float plane) const {
    Slice slice;
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      if ((along_[i] < plane) == (along_[j] < plane)) continue;
      const float share = (along_[i] - plane) / (along_[i] - along_[j]);
      slice.extend(corner_[i] - (corner_[i] - corner_[j]) * FourFloats::all(share));
    }
    return slice;
  }
  [[nodiscard]] Slice between(float begin, float end) const {
    Slice slice;
    for (int i = 0; i < 3; ++i) {
      if (along_[i] >= begin && along_[i] <= end) slice.extend(corner_[i]);
    }
    return slice;
  }

 private:
  float along_[3];
  FourFloats corner_[3];
};

/// Slabs of a node's box along one axis, and the items' parts in them.
class Slabs {
 public:
  Slabs(const WideRange& range, int axis, std::uint32_t bins) : axis_(axis), bins_(bins) {
    lower_ = range.box.ends[axis];
    const float size = -range.box.ends[axis + 4] - lower_;
    width_ = size / static_cast<float>(bins);
    scale_ = size > 0x1p-80F ? static_cast<float>(bins) / size : 0.0F;
    for (std::uint32_t i = 0; i < bins; ++i) box_[i] = kEmptyWideBox;
  }

  [[nodiscard]] bool flat() const { return !(scale_ > 0.0F); }
  /// Where slab `bin` begins.
  [[nodiscard]] float plane(std::uint32_t bin) const {
    return lower_ + width_ * static_cast<float>(bin);
  }
  [[nodiscard]] std::uint32_t bin(float at) const {
    const float place = (at - lower_) * scale_;
    return place < 0.0F ? 0 : std::min(static_cast<std::uint32_t>(place), bins_ - 1);
  }

  void add(const scene::Triangle* triangles, const WideItem& item) {
    const std::uint32_t from = bin(item.lower[axis_]), to = bin(-item.minus_upper[axis_]);
    ++enter_[from];
    ++leave_[to];
    if (from == to) return extend(box_[from], item);
    add_across(Sliced(triangles[item.triangle & ~WideItem::kTriangleBit], axis_), item, from, to);
  }

  /// The cheapest of its planes that leaves fewer items on either side and costs less than `best`;
  /// `room` is how many there may be on both sides together.
  bool cheapest(std::uint32_t items, std::uint32_t room, float& best, std::uint32_t& at) const {
    float right_area[kMostBins];
    std::uint32_t right_count[kMostBins];
    WideBox box = kEmptyWideBox;
    std::uint32_t count = 0;
    for (std::uint32_t i = bins_ - 1; i > 0; --i) {
      accel::extend(box, box_[i]);
      right_area[i] = half_area(box);
      right_count[i] = count += leave_[i];
    }
    box = kEmptyWideBox;
    count = 0;
    bool found = false;
    for (std::uint32_t i = 1; i < bins_; ++i) {
      accel::extend(box, box_[i - 1]);
      count += enter_[i - 1];
      const std::uint32_t right = right_count[i];
      if (count == 0 || right == 0 || count >= items || right >= items || count + right > room) {
        continue;
      }
      const float cost = half_area(box) * static_cast<float>((count + kBlock - 1) / kBlock) +
                         right_area[i] * static_cast<float>((right + kBlock - 1) / kBlock);
      if (!(cost < best)) continue;
      best = cost;
      at = i;
      found = true;
    }
    return found;
  }

 private:
  /// The parts of a triangle in several slabs, good enough to judge planes by: between two planes
  /// lie the corners that are there and where its edges meet the planes.
  void add_across(const Sliced& triangle, const WideItem& item, std::uint32_t from,
                  std::uint32_t to) {
    const FourFloats lowest = FourFloats::of(item.lower[0], item.lower[1], item.lower[2], 0.0F);
    const FourFloats highest =
        FourFloats::of(-item.minus_upper[0], -item.minus_upper[1], -item.minus_upper[2], 0.0F);
    float begin = item.lower[axis_];
    Slice before = triangle.meet(begin);
    for (std::uint32_t i = from; i <= to; ++i) {
      const float end = i < to ? plane(i + 1) : -item.minus_upper[axis_];
      const Slice after = triangle.meet(end);
      Slice all = triangle.between(begin, end);
      all.lower = min(all.lower, min(before.lower, after.lower));
      all.upper = max(all.upper, max(before.upper, after.upper));
      FourFloats lower = max(all.lower, lowest), upper = min(all.upper, highest);
      WideItem part;
      lower.store(part.lower);
      (FourFloats::all(0.0F) - upper).store(part.minus_upper);
      extend(box_[i], part);
      begin = end;
      before = after;
    }
  }

  int axis_;
  std::uint32_t bins_;
  float lower_, width_, scale_;
  WideBox box_[kMostBins];
  std::uint32_t enter_[kMostBins] = {}, leave_[kMostBins] = {};
};

/// One side while it fills up.
struct Side {
  WideBox box = kEmptyWideBox;
  WideBox centers = kEmptyWideBox;
  std::uint32_t count = 0;

  void add(const WideItem& item) {
    extend(box, item);
    for (int k = 0; k < 3; ++k) {
      const float center = item.lower[k] - item.minus_upper[k];
      centers.ends[k] = std::min(centers.ends[k], center);
      centers.ends[k + 4] = std::min(centers.ends[k + 4], -center);
    }
    ++count;
  }
};

/// Left items go to the front of the range's room, right ones to its end, back to front.
bool divide(const WideSpatial& spatial, const WideItem* items, const Slabs& slabs, int axis,
            std::uint32_t at, WideItem* to, WideRange& range, WideRange& other) {
  Side left, right;
  const float plane = slabs.plane(at);
  WideItem* const front = to + range.begin;
  WideItem* const back = to + range.room - 1;
  const auto add_left = [&](const WideItem& item) {
    front[left.count] = item;
    left.add(item);
  };
  const auto add_right = [&](const WideItem& item) {
    *(back - right.count) = item;
    right.add(item);
  };
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const WideItem& item = items[i];
    if (slabs.bin(-item.minus_upper[axis]) < at) {
      add_left(item);
    } else if (slabs.bin(item.lower[axis]) >= at) {
      add_right(item);
    } else {
      WideItem sides[2];
      const scene::Triangle& triangle = spatial.triangles[item.triangle & ~WideItem::kTriangleBit];
      clip_wide_item(triangle, item, axis, plane, sides);
      if (!is_empty(sides[0])) add_left(sides[0]);
      if (!is_empty(sides[1])) add_right(sides[1]);
    }
  }
  const std::uint32_t items_before = range.end - range.begin;
  if (left.count == 0 || right.count == 0 || left.count >= items_before ||
      right.count >= items_before) {
    return false;
  }
  // What room is left is shared out by the items.
  const std::uint32_t used = left.count + right.count;
  const std::uint32_t spare = range.room - range.begin - used;
  const auto left_spare = static_cast<std::uint32_t>(std::uint64_t{spare} * left.count / used);
  const std::uint32_t begin = range.begin, room = range.room, array = 1 - range.array;
  const std::uint32_t right_begin = begin + left.count + left_spare;
  const std::uint32_t right_at = room - right.count;
  std::copy(to + right_at, to + room, to + right_begin);
  other = {right.box, right.centers, right_begin,         right_begin + right.count,
           room,      array,         half_area(right.box)};
  range = {left.box, left.centers,       begin, begin + left.count, right_begin,
           array,    half_area(left.box)};
  return true;
}

}  // namespace

bool split_wide_space(const WideSpatial& spatial, const WideItem* items, float object_cost,
                      WideItem* to, WideRange& range, WideRange& other) {
  const std::uint32_t count = range.end - range.begin;
  const std::uint32_t spare = range.room - range.end;
  if (spare == 0) return false;
  // Of the spare room what two of the levels still to come would get: those further down, where
  // boxes are the emptiest, need it more.
  const auto levels = static_cast<std::uint32_t>(std::bit_width(count / kBlock)) + 1;
  const std::uint32_t room = count + std::min(spare, 1 + 2 * (spare / levels));
  const std::uint32_t bins = std::min(kMostBins, 4 + count / 4);
  float best = object_cost;
  bool found = false;
  int axis = 0;
  std::uint32_t at = 0;
  for (int k = 0; k < 3; ++k) {
    Slabs slabs(range, k, bins);
    if (slabs.flat()) continue;
    for (std::uint32_t i = range.begin; i < range.end; ++i) slabs.add(spatial.triangles, items[i]);
    if (slabs.cheapest(count, room, best, at)) {
      found = true;
      axis = k;
    }
  }
  if (!found) return false;
  return divide(spatial, items, Slabs(range, axis, bins), axis, at, to, range, other);
}

}  // namespace encore::accel
