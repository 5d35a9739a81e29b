#include "accel/bvh/bvh.h"
#include "accel/bvh/four_floats.h"

namespace encore::accel {

namespace {

constexpr unsigned kXyz = 7;  // the lanes that are coordinates
constexpr std::size_t kBranchPairs = 1U << 13U;

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
bool Bvh::refit_node(std::uint32_t index, RefitCounts& counts) {
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
    counts.leaves_changed += changed ? 1 : 0;
    bool write = changed;
    if constexpr (Case == UpdateCase::best) write = false;
    if constexpr (Case == UpdateCase::average) {
      write = scramble(settings_.seed, index) < kAverageShare;
    }
    if constexpr (Case == UpdateCase::worst) write = true;
    if (!write) return false;
    write_box(node, lower, upper);
    ++counts.leaves_written;
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
  ++counts.inner_written;
  return true;
}

template <UpdateCase Case>
void Bvh::refit_pair(std::size_t pair, RefitCounts& counts) {
  const auto right = static_cast<std::uint32_t>(2 * pair);
  const bool right_changed = refit_node<Case>(right, counts);
  const bool left_changed = refit_node<Case>(right - 1, counts);
  changed_[pair] = right_changed || left_changed ? 1 : 0;
}

template <UpdateCase Case>
void Bvh::refit() {
  // Children come after their parents, so in reverse every node finds its children done.
  RefitCounts counts;
  for (std::size_t pair = pairs_.size() - 1; pair > 0; --pair) refit_pair<Case>(pair, counts);
  refit_node<Case>(0, counts);
  refit_ = counts;
}

/// All that is below a node lies together: cuts the tree into branches of at most kBranchPairs
/// pairs, and the pairs above those, in ascending order.
void Bvh::cut_into_branches(std::vector<PairRange>& branches,
                            std::vector<std::size_t>& above) const {
  struct Waiting {
    std::uint32_t node;
    std::size_t end;  ///< of the pairs below it
  };
  std::vector<Waiting> waiting{{0, pairs_.size()}};
  while (!waiting.empty()) {
    const Waiting task = waiting.back();
    waiting.pop_back();
    const gpu::BvhNode& node = root()[task.node];
    if (node.count != 0) continue;
    const std::size_t pair = (node.first + 1) / 2;
    if (task.end - pair <= kBranchPairs) {
      branches.push_back({pair, task.end});
      continue;
    }
    above.push_back(pair);
    const gpu::BvhNode& right = root()[node.first + 1];
    const std::size_t left_end = right.count == 0 ? (right.first + 1) / 2 : task.end;
    waiting.push_back({node.first + 1, task.end});
    waiting.push_back({node.first, left_end});
  }
}

template <UpdateCase Case>
void Bvh::refit_together(const Workers& workers) {
  std::vector<PairRange> branches;
  std::vector<std::size_t> above;
  cut_into_branches(branches, above);
  std::vector<RefitCounts> counts(branches.size() + 1);
  workers.for_parts(branches.size(), 1, [&](std::size_t k, std::size_t) {
    RefitCounts here;
    for (std::size_t pair = branches[k].end; pair-- > branches[k].begin;) {
      refit_pair<Case>(pair, here);
    }
    counts[k] = here;
  });
  for (std::size_t i = above.size(); i-- > 0;) refit_pair<Case>(above[i], counts.back());
  refit_node<Case>(0, counts.back());
  for (const RefitCounts& each : counts) {
    refit_.leaves_changed += each.leaves_changed;
    refit_.leaves_written += each.leaves_written;
    refit_.inner_written += each.inner_written;
  }
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
  Workers workers(build_threads(), triangles.size());
  const auto run = [&]<UpdateCase Case>() {
    workers.run([&] { workers.parallel() ? refit_together<Case>(workers) : refit<Case>(); });
  };
  switch (settings_.update_case) {
    case UpdateCase::real:
      return run.template operator()<UpdateCase::real>();
    case UpdateCase::best:
      return run.template operator()<UpdateCase::best>();
    case UpdateCase::average:
      return run.template operator()<UpdateCase::average>();
    case UpdateCase::worst:
      return run.template operator()<UpdateCase::worst>();
  }
}

}  // namespace encore::accel
