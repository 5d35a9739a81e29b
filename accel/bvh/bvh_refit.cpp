#include "accel/bvh/bvh.h"
#include "accel/bvh/four_floats.h"

namespace encore::accel {

namespace {

constexpr unsigned kXyz = 7;  // the lanes that are coordinates

/// A number that depends on both arguments in no visible way (the finaliser of splitmix64, Steele,
/// Lea and Flood 2014): makes a seeded choice a leaf without carrying a generator's state along.
std::uint64_t scramble(std::uint64_t seed, std::uint64_t leaf) {
  std::uint64_t x = seed + (leaf + 1) * 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

/// 60 % of all 64-bit numbers lie below it.
constexpr std::uint64_t kAverageShare = 0x999999999999999AU;

/// Writes a box into a node and leaves the node's integer members as they are.
void write_box(gpu::BvhNode& node, const FourFloats& lower, const FourFloats& upper) {
  const std::uint32_t first = node.first;
  const std::uint32_t count = node.count;
  lower.store(&node.min);
  upper.store(&node.max);
  node.first = first;
  node.count = count;
}

bool differs(const gpu::BvhNode& node, const FourFloats& lower, const FourFloats& upper) {
  return ((not_equal(lower, FourFloats::load(&node.min)) |
           not_equal(upper, FourFloats::load(&node.max))) &
          kXyz) != 0;
}

}  // namespace

/// Refits one node whose children are done; true if its parent must be looked at.
template <UpdateCase Case>
bool Bvh::refit_node(std::uint32_t index) {
  gpu::BvhNode& node = root()[index];
  if (node.count != 0) {
    // Leaf: compare the stored box with the triangle's, then write what the case asks for.
    const Triangle& triangle = triangles_[node.first];
    const FourFloats a = FourFloats::load(&triangle.v0);
    const FourFloats b = FourFloats::load(&triangle.v1);
    const FourFloats c = FourFloats::load(&triangle.v2);
    const FourFloats lower = min(min(a, b), c);
    const FourFloats upper = max(max(a, b), c);
    const bool changed = differs(node, lower, upper);
    refit_.leaves_changed += changed ? 1 : 0;
    bool write = changed;
    if constexpr (Case == UpdateCase::best) write = false;
    if constexpr (Case == UpdateCase::average) {
      write = scramble(settings_.seed, index) < kAverageShare;
    }
    if constexpr (Case == UpdateCase::worst) write = true;
    if (!write) return false;
    write_box(node, lower, upper);
    ++refit_.leaves_written;
    return true;
  }

  // Inner node: nothing to do unless something below changed; then the union of the children, and
  // the news ends here if that is the same box as before.
  if (changed_[(node.first + 1) / 2] == 0) return false;
  const gpu::BvhNode* const children = root() + node.first;
  const FourFloats lower =
      min(FourFloats::load(&children[0].min), FourFloats::load(&children[1].min));
  const FourFloats upper =
      max(FourFloats::load(&children[0].max), FourFloats::load(&children[1].max));
  if (Case == UpdateCase::real && !differs(node, lower, upper)) return false;
  write_box(node, lower, upper);
  ++refit_.inner_written;
  return true;
}

template <UpdateCase Case>
void Bvh::refit() {
  // Children come after their parents, so in reverse every node finds its children done.
  for (std::size_t pair = pairs_.size() - 1; pair > 0; --pair) {
    const auto right = static_cast<std::uint32_t>(2 * pair);
    const bool right_changed = refit_node<Case>(right);
    const bool left_changed = refit_node<Case>(right - 1);
    changed_[pair] = right_changed || left_changed ? 1 : 0;
  }
  refit_node<Case>(0);
}

std::vector<std::uint32_t> Bvh::average_case_leaves() const {
  const auto all = nodes();
  std::vector<std::uint32_t> bits((all.size() + 31) / 32, 0U);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const bool chosen = all[i].count != 0 && scramble(settings_.seed, i) < kAverageShare;
    bits[i / 32] |= (chosen ? 1U : 0U) << (i % 32);
  }
  return bits;
}

void Bvh::update(std::span<const Triangle> triangles) {
  if (triangles.size() != triangles_.size() || triangles.size() != pairs_.size()) {
    build(triangles);
    return;
  }
  mark_changed();
  triangles_ = triangles;
  allocations_ = {};
  refit_ = {};
  quality_.outdate();
  if (triangles.empty()) return;
  changed_.reset(pairs_.size(), memory_, allocations_);
  switch (settings_.update_case) {
    case UpdateCase::real:
      return refit<UpdateCase::real>();
    case UpdateCase::best:
      return refit<UpdateCase::best>();
    case UpdateCase::average:
      return refit<UpdateCase::average>();
    case UpdateCase::worst:
      return refit<UpdateCase::worst>();
  }
}

}  // namespace encore::accel
