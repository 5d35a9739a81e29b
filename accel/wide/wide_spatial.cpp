#include "accel/wide/wide_spatial.h"

#include "accel/bvh/four_floats.h"
#include "accel/wide/wide_build_memory.h"
#include "accel/wide/wide_clip.h"
#include "accel/wide/wide_spatial_parts.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace encore::accel {

namespace {

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

/// Slabs of a range's box along one axis.
class Slabs {
 public:
  Slabs(const WideBox& box, int axis, std::uint32_t bins) : axis_(axis), bins_(bins) {
    lower_ = box.ends[axis];
    const float size = -box.ends[axis + 4] - lower_;
    width_ = size / static_cast<float>(bins);
    scale_ = size > 0x1p-80F ? static_cast<float>(bins) / size : 0.0F;
  }

  [[nodiscard]] bool flat() const { return !(scale_ > 0.0F); }
  [[nodiscard]] int axis() const { return axis_; }
  [[nodiscard]] std::uint32_t bins() const { return bins_; }
  /// Where slab `bin` begins.
  [[nodiscard]] float plane(std::uint32_t bin) const {
    return lower_ + width_ * static_cast<float>(bin);
  }
  [[nodiscard]] std::uint32_t bin(float at) const {
    const float place = (at - lower_) * scale_;
    return place < 0.0F ? 0 : std::min(static_cast<std::uint32_t>(place), bins_ - 1);
  }
  [[nodiscard]] std::uint32_t first_bin(const WideItem& item) const {
    return bin(item.lower[axis_]);
  }
  [[nodiscard]] std::uint32_t last_bin(const WideItem& item) const {
    return bin(-item.minus_upper[axis_]);
  }

  void clear(WideSlabBins& into) const {
    for (std::uint32_t i = 0; i < bins_; ++i) {
      into.box[i] = kEmptyWideBox;
      into.enter[i] = into.leave[i] = 0;
    }
  }

  void add(const scene::Triangle* triangles, const WideItem& item, WideSlabBins& into) const {
    const std::uint32_t from = first_bin(item), to = last_bin(item);
    ++into.enter[from];
    ++into.leave[to];
    if (from == to) return extend(into.box[from], item);
    const Sliced triangle(triangles[item.triangle & ~WideItem::kTriangleBit], axis_);
    add_across(triangle, item, from, to, into);
  }

  void merge(WideSlabBins& into, const WideSlabBins& more) const {
    for (std::uint32_t i = 0; i < bins_; ++i) {
      accel::extend(into.box[i], more.box[i]);
      into.enter[i] += more.enter[i];
      into.leave[i] += more.leave[i];
    }
  }

  /// The cheapest of its planes that leaves fewer items on either side and costs less than `best`;
  /// `room` is how many there may be on both sides together.
  bool cheapest(const WideSlabBins& from, std::uint32_t items, std::uint32_t room, float& best,
                std::uint32_t& at) const {
    float right_area[WideSlabBins::kMost];
    std::uint32_t right_count[WideSlabBins::kMost];
    WideBox box = kEmptyWideBox;
    std::uint32_t count = 0;
    for (std::uint32_t i = bins_ - 1; i > 0; --i) {
      accel::extend(box, from.box[i]);
      right_area[i] = half_area(box);
      right_count[i] = count += from.leave[i];
    }
    box = kEmptyWideBox;
    count = 0;
    bool found = false;
    for (std::uint32_t i = 1; i < bins_; ++i) {
      accel::extend(box, from.box[i - 1]);
      count += from.enter[i - 1];
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
                  std::uint32_t to, WideSlabBins& into) const {
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
      extend(into.box[i], part);
      begin = end;
      before = after;
    }
  }

  int axis_;
  std::uint32_t bins_;
  float lower_, width_, scale_;
};

/// What goes to one side while it fills up.
struct Side {
  WideBox box = kEmptyWideBox;
  WideBox centers = kEmptyWideBox;
  WideItem* to = nullptr;
  std::uint32_t count = 0;
  std::uint32_t most = 0;  ///< as many as reach the side by their boxes

  void add(const WideItem& item) {
    to[count++] = item;
    extend(box, item);
    for (int k = 0; k < 3; ++k) {
      const float center = item.lower[k] - item.minus_upper[k];
      centers.ends[k] = std::min(centers.ends[k], center);
      centers.ends[k + 4] = std::min(centers.ends[k + 4], -center);
    }
  }
};

/// Items [begin, end) go left, right or, what lies across the plane, both ways.
void divide(const WideSpatial& spatial, const WideItem* items, std::size_t begin, std::size_t end,
            const Slabs& slabs, std::uint32_t at, Side& left, Side& right) {
  const float plane = slabs.plane(at);
  for (std::size_t i = begin; i < end; ++i) {
    const WideItem& item = items[i];
    if (slabs.last_bin(item) < at) {
      left.add(item);
    } else if (slabs.first_bin(item) >= at) {
      right.add(item);
    } else {
      WideItem sides[2];
      const scene::Triangle& triangle = spatial.triangles[item.triangle & ~WideItem::kTriangleBit];
      clip_wide_item(triangle, item, slabs.axis(), plane, sides);
      if (!is_empty(sides[0])) left.add(sides[0]);
      if (!is_empty(sides[1])) right.add(sides[1]);
    }
  }
}

/// Puts what the parts have on one side behind each other and returns all of it.
Side joined(const Side* sides, std::size_t parts) {
  Side all = sides[0];
  for (std::size_t part = 1; part < parts; ++part) {
    const Side& side = sides[part];
    // Only where a clipped part turned out to be empty there is a gap.
    if (side.to != all.to + all.count) std::copy_n(side.to, side.count, all.to + all.count);
    all.count += side.count;
    extend(all.box, side.box);
    extend(all.centers, side.centers);
  }
  return all;
}

/// A range that is gone through in at most `MostParts` parts: for_parts(body) calls body(part,
/// begin, end) for each.
template <std::size_t MostParts, class ForParts>
class Split {
 public:
  Split(const WideSpatial& spatial, const WideItem* items, WideRange& range, WideSlabBins* bins,
        std::size_t parts, const ForParts& for_parts)
      : spatial_(spatial),
        items_(items),
        range_(range),
        bins_(bins),
        parts_(parts),
        for_parts_(for_parts) {}

  bool run(float object_cost, WideItem* to, WideRange& other) {
    const std::uint32_t count = range_.end - range_.begin;
    const std::uint32_t spare = range_.room - range_.end;
    if (spare == 0) return false;
    // Of the spare room what two of the levels still to come would get: those further down, where
    // boxes are the emptiest, need it more.
    const auto levels = static_cast<std::uint32_t>(std::bit_width(count / kBlock)) + 1;
    const std::uint32_t room = count + std::min(spare, 1 + 2 * (spare / levels));
    const std::uint32_t bins = std::min(WideSlabBins::kMost, 4 + count / 4);
    const Slabs slabs[3] = {{range_.box, 0, bins}, {range_.box, 1, bins}, {range_.box, 2, bins}};
    for_parts_([&](std::size_t part, std::size_t begin, std::size_t end) {
      for (const Slabs& s : slabs) bin(s, begin, end, bins_[3 * part + std::size_t(s.axis())]);
    });
    float best = object_cost;
    int axis = -1;
    std::uint32_t at = 0;
    for (const Slabs& s : slabs) {
      if (s.flat()) continue;
      WideSlabBins all = bins_[s.axis()];
      for (std::size_t part = 1; part < parts_; ++part) {
        s.merge(all, bins_[3 * part + std::size_t(s.axis())]);
      }
      if (s.cheapest(all, count, room, best, at)) axis = s.axis();
    }
    return axis >= 0 && move(slabs[axis], at, to, other);
  }

 private:
  void bin(const Slabs& slabs, std::size_t begin, std::size_t end, WideSlabBins& into) const {
    if (slabs.flat()) return;
    slabs.clear(into);
    for (std::size_t i = begin; i < end; ++i) slabs.add(spatial_.triangles, items_[i], into);
  }

  bool move(const Slabs& slabs, std::uint32_t at, WideItem* to, WideRange& other) {
    Side left[MostParts], right[MostParts];
    std::uint32_t left_most = 0, right_most = 0;
    for (std::size_t part = 0; part < parts_; ++part) {
      const WideSlabBins& bins = bins_[3 * part + std::size_t(slabs.axis())];
      for (std::uint32_t i = 0; i < at; ++i) left[part].most += bins.enter[i];
      for (std::uint32_t i = at; i < slabs.bins(); ++i) right[part].most += bins.leave[i];
      left_most += left[part].most;
      right_most += right[part].most;
    }
    // What room is left is shared out by the items.
    const std::uint32_t used = left_most + right_most;
    const std::uint32_t spare = range_.room - range_.begin - used;
    const std::uint32_t right_begin =
        range_.begin + left_most +
        static_cast<std::uint32_t>(std::uint64_t{spare} * left_most / used);
    WideItem* next[2] = {to + range_.begin, to + right_begin};
    for (std::size_t part = 0; part < parts_; ++part) {
      left[part].to = std::exchange(next[0], next[0] + left[part].most);
      right[part].to = std::exchange(next[1], next[1] + right[part].most);
    }
    for_parts_([&](std::size_t part, std::size_t begin, std::size_t end) {
      divide(spatial_, items_, begin, end, slabs, at, left[part], right[part]);
    });
    return take(joined(left, parts_), joined(right, parts_), right_begin, other);
  }

  bool take(const Side& left, const Side& right, std::uint32_t right_begin, WideRange& other) {
    const std::uint32_t before = range_.end - range_.begin;
    if (left.count == 0 || right.count == 0 || left.count >= before || right.count >= before) {
      return false;
    }
    const std::uint32_t begin = range_.begin, room = range_.room, array = 1 - range_.array;
    other = {right.box, right.centers, right_begin,         right_begin + right.count,
             room,      array,         half_area(right.box)};
    range_ = {left.box, left.centers,       begin, begin + left.count, right_begin,
              array,    half_area(left.box)};
    return true;
  }

  const WideSpatial& spatial_;
  const WideItem* const items_;
  WideRange& range_;
  WideSlabBins* const bins_;
  const std::size_t parts_;
  const ForParts& for_parts_;
};

}  // namespace

bool split_wide_space(const WideSpatial& spatial, const WideItem* items, float object_cost,
                      WideItem* to, WideRange& range, WideRange& other) {
  WideSlabBins bins[3];
  const auto whole = [&](const auto& body) { body(0, range.begin, range.end); };
  return Split<1, decltype(whole)>(spatial, items, range, bins, 1, whole)
      .run(object_cost, to, other);
}

bool split_wide_space(const WideSpatial& spatial, const WideItem* items, float object_cost,
                      WideItem* to, WideRange& range, WideRange& other, const WideParts& parts,
                      const Workers& workers, WideSlabBins* bins) {
  const std::size_t first = range.begin;
  const auto together = [&](const auto& body) {
    workers.for_parts(parts.items, parts.size, [&](std::size_t begin, std::size_t end) {
      body(begin / parts.size, first + begin, first + end);
    });
  };
  return Split<WideParts::kMost, decltype(together)>(spatial, items, range, bins, parts.count,
                                                     together)
      .run(object_cost, to, other);
}

}  // namespace encore::accel
