#include "accel/kdtree/kdtree_top.h"

#include "accel/kdtree/kd_node.h"
#include "accel/kdtree/kdtree_build_median.h"
#include "accel/shared_meter.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace encore::accel {

namespace {

constexpr std::size_t kPart = 1U << 12U;  ///< references that one thread takes at a time
constexpr double kTopDone = 0.2;

}  // namespace

KdTop::KdTop(std::span<const scene::Triangle> triangles, const KdLimits& limits, MemoryMode mode,
             KdTopMemory& memory, BuildMeter& meter, const Workers& workers)
    : triangles_(triangles),
      limits_(limits),
      mode_(mode),
      memory_(memory),
      meter_(meter),
      workers_(workers),
      // Enough branches for many threads, and large enough to be worth it.
      branch_size_(static_cast<std::uint32_t>(std::max<std::size_t>(triangles.size() / 32, 4096))) {
}

bool KdTop::build(const scene::Bounds& bounds, const KdTreeSettings* settings, KdBuildMemory& tree,
                  KdSahMemory& sah) {
  KdBuildMemory& top = memory_.top;
  top.allocations = {};
  top.references_classified = 0;
  top.triangle_box_tests = 0;
  memory_.sah.forget_counts();
  top.left.reset(triangles_.size(), mode_, top.allocations);
  memory_.lower.reset(triangles_.size(), mode_, top.allocations);
  memory_.upper.reset(triangles_.size(), mode_, top.allocations);
  KdBuilder builder(triangles_, limits_, mode_, top, meter_);
  bool whole = false;
  if (settings != nullptr) {
    KdSahSplitter splitter(*settings, triangles_.size(), mode_, memory_.sah, meter_, workers_);
    whole = builder.run_top(bounds, splitter, *this);
  } else {
    KdMedianSplitter splitter;
    whole = builder.run_top(bounds, splitter, *this);
  }
  if (!whole) return false;
  meter_.report(kTopDone);
  if (!build_branches(settings) || !within_limits()) return false;
  join(tree, sah);
  return true;
}

void KdTop::fill(std::span<const scene::Triangle> triangles, KdReference* references) const {
  SharedMeter shared(meter_, meter_.done(), double(triangles.size()));
  workers_.for_parts(triangles.size(), kPart, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) references[i] = kd_reference(triangles, i);
    shared.add(double(end - begin));
  });
}

bool KdTop::take(const KdBuilder& builder, const KdTask& task,
                 std::span<const KdReference> references) {
  if (task.count > branch_size_) {
    checks_.push_back({builder.demand_of(task), branch_count_});
    return false;
  }
  if (branch_count_ == memory_.branches.size()) memory_.branches.emplace_back();
  KdBranch& branch = memory_.branches[branch_count_++];
  branch.task = task;
  branch.node = static_cast<std::uint32_t>(builder.node_count_);
  branch.waiting = builder.waiting_with(task) - task.count;
  branch.leaf_before = builder.leaf_references_;
  branch.memory.allocations = {};
  branch.memory.references_classified = 0;
  branch.memory.triangle_box_tests = 0;
  branch.memory.left.reset(task.count, mode_, branch.memory.allocations);
  std::copy(references.begin(), references.end(), branch.memory.left.data());
  return true;
}

KdBuilder::Counts KdTop::partition(const KdBuilder& builder, const KdTask& task,
                                   const KdSplit& split, const KdReference* source,
                                   KdReference* lower, KdReference* upper) {
  // Each part goes to places of its own, and together once it is known how many there are.
  std::vector<KdBuilder::Counts> counts((task.count + kPart - 1) / kPart);
  std::vector<KdBuilder::Counts> before(counts.size() + 1);
  SharedMeter shared(meter_, meter_.done(), double(task.count));
  workers_.for_parts(task.count, kPart, [&](std::size_t begin, std::size_t end) {
    TaskMeter own(meter_);
    counts[begin / kPart] =
        builder.partition(task, split, source + begin, static_cast<std::uint32_t>(end - begin),
                          memory_.lower.data() + begin, memory_.upper.data() + begin, own.meter());
    shared.add(double(end - begin));
  });
  for (std::size_t p = 0; p < counts.size(); ++p) {
    before[p + 1] = {before[p].lower + counts[p].lower, before[p].upper + counts[p].upper,
                     before[p].straddlers + counts[p].straddlers};
  }
  workers_.for_parts(task.count, kPart, [&](std::size_t begin, std::size_t) {
    const std::size_t p = begin / kPart;
    std::copy_n(memory_.lower.data() + begin, counts[p].lower, lower + before[p].lower);
    std::copy_n(memory_.upper.data() + begin, counts[p].upper, upper + before[p].upper);
  });
  return before.back();
}

// False as soon as one branch is beyond the limits by itself, or the leaves are that are done: they
// are some of those that the whole tree would have had.
bool KdTop::build_branches(const KdTreeSettings* settings) {
  double work = 0.0;
  for (std::size_t b = 0; b < branch_count_; ++b) {
    work += BuildMeter::left(memory_.branches[b].task.count);
  }
  // The largest ones first.
  std::vector<std::size_t> order(branch_count_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return memory_.branches[a].task.count > memory_.branches[b].task.count;
  });
  SharedMeter shared(meter_, 1.0, work);
  std::atomic<std::uint64_t> references{0};
  std::atomic<std::size_t> next{0};
  std::atomic<bool> beyond{false};
  // Any task takes the largest branch that is left.
  workers_.for_parts(branch_count_, 1, [&](std::size_t, std::size_t) {
    KdBranch& branch = memory_.branches[order[next.fetch_add(1)]];
    if (beyond.load(std::memory_order_relaxed)) return;
    TaskMeter own(meter_);
    KdBuilder builder(triangles_, limits_, mode_, branch.memory, own.meter());
    bool whole = false;
    if (settings != nullptr) {
      KdSahSplitter splitter(*settings, branch.task.count, mode_, branch.sah_memory, own.meter());
      whole = builder.run_branch(branch.task, splitter);
      if (mode_ == MemoryMode::fresh) branch.sah_memory.keys.release();
    } else {
      KdMedianSplitter splitter;
      whole = builder.run_branch(branch.task, splitter);
    }
    branch.demand = builder.demand();
    const std::uint64_t added = branch.memory.references.size();
    if (!whole || references.fetch_add(added) + added > limits_.references) beyond = true;
    shared.add(BuildMeter::left(branch.task.count));
  });
  return !beyond;
}

bool KdTop::within_limits() const {
  // What the branches before an event add to what the top knew then.
  std::uint64_t references = 0;
  std::uint64_t nodes = 0;
  KdDemand demand;
  std::size_t check = 0;
  for (std::size_t b = 0; b <= branch_count_; ++b) {
    for (; check < checks_.size() && checks_[check].branches == b; ++check) {
      const KdDemand& top = checks_[check].demand;
      demand.include({top.references + references, top.nodes + nodes, top.waiting});
    }
    if (b == branch_count_) break;
    const KdBranch& branch = memory_.branches[b];
    // One that turned out a leaf asked for nothing.
    if (branch.demand.nodes != 0) {
      demand.include({branch.leaf_before + references + branch.waiting + branch.demand.references,
                      branch.node + nodes + branch.demand.nodes,
                      branch.waiting + branch.demand.waiting});
    }
    references += branch.memory.references.size();
    nodes += branch.memory.nodes.size() - 1;
  }
  return demand.within(limits_, triangles_.size());
}

// Puts all nodes and references together, in the order of a single builder.
void KdTop::join(KdBuildMemory& tree, KdSahMemory& sah) {
  KdBuildMemory& top = memory_.top;
  tree.allocations = top.allocations;
  tree.depth = top.depth;
  tree.limited = false;
  tree.references_classified = top.references_classified;
  tree.triangle_box_tests = top.triangle_box_tests;
  sah.forget_counts();
  const auto add = [&sah](const KdSahMemory& part) {
    sah.allocations.requests += part.allocations.requests;
    sah.allocations.bytes += part.allocations.bytes;
    sah.keys_sorted += part.keys_sorted;
    sah.candidates_examined += part.candidates_examined;
  };
  add(memory_.sah);
  std::size_t nodes = top.nodes.size();
  std::size_t references = top.references.size();
  struct Place {
    std::size_t node, reference;
  };
  std::vector<Place> places(branch_count_);
  for (std::size_t b = 0, added_nodes = 0, added_references = 0; b < branch_count_; ++b) {
    KdBranch& branch = memory_.branches[b];
    places[b] = {branch.node + added_nodes, branch.leaf_before + added_references};
    added_nodes += branch.memory.nodes.size() - 1;
    added_references += branch.memory.references.size();
    nodes += branch.memory.nodes.size() - 1;
    references += branch.memory.references.size();
    tree.allocations.requests += branch.memory.allocations.requests;
    tree.allocations.bytes += branch.memory.allocations.bytes;
    tree.depth = std::max(tree.depth, branch.memory.depth);
    tree.references_classified += branch.memory.references_classified;
    tree.triangle_box_tests += branch.memory.triangle_box_tests;
    add(branch.sah_memory);
  }
  tree.nodes.reset(nodes, mode_, tree.allocations);
  tree.references.reset(references, mode_, tree.allocations);
  join_top(tree);
  workers_.for_parts(branch_count_, 1, [&](std::size_t b, std::size_t) {
    const KdBuildMemory& branch = memory_.branches[b].memory;
    const auto first_node = static_cast<std::uint32_t>(places[b].node);
    const auto first_reference = static_cast<std::uint32_t>(places[b].reference);
    for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
      gpu::KdNode node = branch.nodes[i];
      if (kd_tag(node) == kKdLeafTag) {
        node.data += first_reference;
      } else {
        kd_set_upper(node, kd_upper(node) + first_node);
      }
      tree.nodes[first_node + i] = node;
    }
    std::copy_n(branch.references.data(), branch.references.size(),
                tree.references.data() + first_reference);
  });
}

void KdTop::join_top(KdBuildMemory& tree) {
  const KdBuildMemory& top = memory_.top;
  // Where each node of the top comes to lie, and how many references come before it.
  std::vector<std::uint32_t> places(top.nodes.size());
  std::vector<std::uint32_t> references(top.nodes.size());
  std::vector<std::uint8_t> taken(top.nodes.size(), 0);
  std::uint32_t more_nodes = 0;
  std::uint32_t more_references = 0;
  for (std::size_t i = 0, b = 0; i < top.nodes.size(); ++i) {
    places[i] = static_cast<std::uint32_t>(i) + more_nodes;
    references[i] = more_references;
    if (b == branch_count_ || memory_.branches[b].node != i) continue;
    taken[i] = 1;
    more_nodes += static_cast<std::uint32_t>(memory_.branches[b].memory.nodes.size() - 1);
    more_references += static_cast<std::uint32_t>(memory_.branches[b].memory.references.size());
    ++b;
  }
  for (std::size_t i = 0; i < top.nodes.size(); ++i) {
    if (taken[i] != 0) continue;
    gpu::KdNode node = top.nodes[i];
    if (kd_tag(node) == kKdLeafTag) {
      const std::uint32_t* const from = top.references.data() + kd_first(node);
      node.data += references[i];
      std::copy_n(from, kd_count(node), tree.references.data() + kd_first(node));
    } else {
      kd_set_upper(node, places[kd_upper(node)]);
    }
    tree.nodes[places[i]] = node;
  }
}

}  // namespace encore::accel
