#include "accel/kdtree/kdtree_builder.h"

#include "accel/kdtree/kd_node.h"
#include "accel/kdtree/kdtree_top.h"
#include "accel/kdtree/triangle_clip.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::accel {

namespace {

using scene::Bounds;

constexpr std::size_t kSmallScene = 5000;
constexpr std::uint32_t kSmallSceneLeaf = 2;
constexpr std::uint32_t kLeaf = 10;
constexpr std::uint64_t kReferencesOnTop = 65536;
constexpr std::uint64_t kWaitingPerTriangle = 4;
constexpr std::uint64_t kMostReferences = 0xFFFFFFFEU;

template <class T>
void make_room(Array<T>& array, std::size_t size, AllocationCount& count) {
  if (size > array.size()) array.grow(size, count);
}

}  // namespace

KdLimits kd_limits(const KdTreeSettings& settings, std::size_t triangle_count) {
  const double count = std::max<double>(1.0, double(triangle_count));
  const bool natural = settings.depth_logarithm == KdTreeSettings::DepthLogarithm::natural;
  const double logarithm = natural ? std::log(count) : std::log2(count);
  const double depth = std::floor(settings.depth_offset + settings.depth_factor * logarithm);
  KdLimits limits{};
  // Written so that NaN ends up at 0.
  limits.depth = depth > 0.0 ? static_cast<std::uint32_t>(std::min<double>(depth, kKdDepthCap)) : 0;
  limits.leaf_triangles = settings.leaf_triangles > 0
                              ? static_cast<std::uint32_t>(settings.leaf_triangles)
                              : (triangle_count < kSmallScene ? kSmallSceneLeaf : kLeaf);
  limits.bad_splits = static_cast<std::uint32_t>(std::max(0, settings.bad_split_retries));
  limits.bad_margin = settings.bad_split_margin;
  // Two, so that the root may be divided.
  const auto each = static_cast<std::uint64_t>(std::max(2, settings.most_references));
  limits.references =
      std::min<std::uint64_t>(each * triangle_count + kReferencesOnTop, kMostReferences);
  return limits;
}

bool KdDemand::within(const KdLimits& limits, std::size_t triangle_count) const {
  return references <= limits.references && nodes <= limits.references &&
         waiting <= kWaitingPerTriangle * triangle_count + kReferencesOnTop / 4;
}

void KdBuilder::run(const Bounds& bounds, KdSplitter& splitter) {
  memory_.allocations = {};
  memory_.references_classified = 0;
  memory_.triangle_box_tests = 0;
  shared_out_ = false;
  for (;;) {
    start(triangles_.size());
    fill_left();
    if (grow(whole(bounds), splitter)) break;
    shared_out_ = true;
  }
  finish();
}

bool KdBuilder::run_branch(const KdTask& branch, KdSplitter& splitter) {
  start(branch.count);
  if (!grow(branch, splitter)) return false;
  finish();
  return true;
}

bool KdBuilder::run_top(const Bounds& bounds, KdSplitter& splitter, KdTop& top) {
  top_ = &top;
  start(triangles_.size());
  top.fill(triangles_, memory_.left.data());
  if (!grow(whole(bounds), splitter)) return false;
  finish();
  return true;
}

KdTask KdBuilder::whole(const Bounds& bounds) const {
  return {.box = bounds,
          .count = static_cast<std::uint32_t>(triangles_.size()),
          .budget = limits_.references};
}

// Builds all nodes; false if the limit is in the way, which it cannot be once it is shared out.
bool KdBuilder::grow(const KdTask& root, KdSplitter& splitter) {
  std::array<KdTask, kKdDepthCap + 1> waiting;
  std::size_t waiting_count = 0;
  KdTask task = root;
  for (;;) {
    if (task.count >= BuildMeter::kNode && meter_.watched()) {
      report(task, {waiting.data(), waiting_count});
    }
    const std::span<const KdReference> references{references_in_work(task.count), task.count};
    bool may_split = !must_be_leaf(task);
    bool handed_over = false;
    if (may_split && top_ != nullptr) {
      handed_over = top_->take(*this, task, references);
      may_split = !handed_over;
    }
    if (may_split && !shared_out_) {
      demand_.include(demand_of(task));
      if (!demand_.within(limits_, triangles_.size())) return false;
    }
    const KdSplit split = may_split ? splitter.choose(task, references) : KdSplit{};
    make_room(memory_.nodes, node_count_ + 1, memory_.allocations);
    if (split.axis >= 0) {
      // An inner node: put the upper child aside and go on with the lower one, which is the next
      // node and so needs no index.
      const Counts counts = partition(task, split);
      KdTask& upper = waiting[waiting_count++];
      upper = child(task, split, true, counts);
      upper.parent = static_cast<std::uint32_t>(node_count_);
      memory_.nodes[node_count_++] = kd_inner(split.axis, split.position);
      task = child(task, split, false, counts);
      upper.lower_end = spent() + task.budget;
      in_left_ = true;
      continue;
    }

    // A leaf: take the upper child put aside last, whose references lie on top of the stack.
    add_leaf(handed_over ? std::span<const KdReference>{} : references);
    memory_.depth = std::max(memory_.depth, task.depth);
    if (!in_left_) right_count_ -= task.count;
    if (waiting_count == 0) break;
    task = waiting[--waiting_count];
    if (shared_out_) task.budget += task.lower_end - spent();
    in_left_ = false;
    kd_set_upper(memory_.nodes[task.parent], static_cast<std::uint32_t>(node_count_));
  }
  return true;
}

void KdBuilder::finish() {
  memory_.limited = shared_out_;
  memory_.nodes.shrink(node_count_);
  memory_.references.shrink(leaf_references_);
  if (mode_ == MemoryMode::fresh) {
    memory_.left.release();
    memory_.right.release();
  }
}

void KdBuilder::start(std::size_t count) {
  // First guesses of what real scenes need; the arrays grow where more is asked for.
  demand_ = {};
  memory_.depth = 0;
  node_count_ = 0;
  leaf_references_ = 0;
  right_count_ = 0;
  in_left_ = true;
  memory_.nodes.reset(count / 2 + 64, mode_, memory_.allocations);
  memory_.references.reset(2 * count + 64, mode_, memory_.allocations);
  memory_.right.reset(count + count / 2, mode_, memory_.allocations);
}

void KdBuilder::fill_left() {
  memory_.left.reset(triangles_.size(), mode_, memory_.allocations);
  meter_.pass(triangles_.size(), [this](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) memory_.left[i] = kd_reference(triangles_, i);
  });
}

// What is done is what the root was to take and no node that waits will. (Where splits duplicate
// many references the nodes begin with more than the root had, and progress starts late.)
void KdBuilder::report(const KdTask& task, std::span<const KdTask> waiting) {
  if (top_ != nullptr) return meter_.check();
  double left = BuildMeter::left(task.count);
  for (const KdTask& other : waiting) left += BuildMeter::left(other.count);
  meter_.report(1.0 - left / BuildMeter::left(static_cast<std::uint32_t>(triangles_.size())));
}

KdReference* KdBuilder::references_in_work(std::uint32_t count) {
  return in_left_ ? memory_.left.data() : memory_.right.data() + (right_count_ - count);
}

bool KdBuilder::must_be_leaf(const KdTask& task) const {
  if (task.count <= limits_.leaf_triangles) return true;
  if (task.depth >= limits_.depth || task.bad_splits >= limits_.bad_splits) return true;
  if (node_count_ + 2 + kKdDepthCap > kKdMostNodes) return true;
  // Each reference may end up on both sides, and a leaf needs a share for itself and each of its
  // references: what child() hands out is enough for that.
  return shared_out_ && (2 * std::uint64_t{task.count} + 3 > task.budget ||
                         waiting_with(task) + task.count >
                             kWaitingPerTriangle * triangles_.size() + kReferencesOnTop / 4);
}

// Each reference may end up on both sides.
KdDemand KdBuilder::demand_of(const KdTask& task) const {
  const std::uint64_t waiting = waiting_with(task) + task.count;
  return {leaf_references_ + waiting, node_count_ + 2, waiting};
}

std::uint64_t KdBuilder::waiting_with(const KdTask& task) const {
  return right_count_ + (in_left_ ? std::uint64_t{task.count} : 0);
}

void KdBuilder::add_leaf(std::span<const KdReference> references) {
  make_room(memory_.references, leaf_references_ + references.size(), memory_.allocations);
  memory_.nodes[node_count_++] = kd_leaf(static_cast<std::uint32_t>(leaf_references_),
                                         static_cast<std::uint32_t>(references.size()));
  std::uint32_t* out = memory_.references.data() + leaf_references_;
  for (std::size_t i = 0; i < references.size(); ++i) out[i] = references[i].triangle;
  leaf_references_ += references.size();
}

// Lower references go to the front of `left`. Upper ones go on top of the stack, or over the node's
// own batch if that is where it lies: no more is ever written than was read before.
KdBuilder::Counts KdBuilder::partition(const KdTask& task, const KdSplit& split) {
  if (in_left_) make_room(memory_.right, right_count_ + task.count, memory_.allocations);
  const KdReference* const source = references_in_work(task.count);
  const std::size_t upper_base = in_left_ ? right_count_ : right_count_ - task.count;
  KdReference* const lower = memory_.left.data();
  KdReference* const upper = memory_.right.data() + upper_base;
  const Counts counts = top_ != nullptr
                            ? top_->partition(*this, task, split, source, lower, upper)
                            : partition(task, split, source, task.count, lower, upper, meter_);
  right_count_ = upper_base + counts.upper;
  memory_.references_classified += task.count;
  memory_.triangle_box_tests += 2 * counts.straddlers;
  return counts;
}

KdBuilder::Counts KdBuilder::partition(const KdTask& task, const KdSplit& split,
                                       const KdReference* source, std::uint32_t count,
                                       KdReference* lower, KdReference* upper,
                                       BuildMeter& meter) const {
  const int axis = split.axis;
  Counts counts;
  for (std::uint32_t i = 0, end = 0; i < count;) {
    for (end = meter.part_end(i, count); i < end; ++i) {
      const KdReference reference = source[i];
      const bool below = reference.min[axis] < split.position;
      const bool above = reference.max[axis] > split.position;
      if (below && above) {
        partition_straddler(reference, task, split, lower + counts.lower, upper + counts.upper,
                            counts);
        continue;
      }
      // Write to both ends, count on one: no branch to mispredict.
      const bool to_lower = below || (!above && split.planar_below);
      lower[counts.lower] = reference;
      upper[counts.upper] = reference;
      counts.lower += to_lower ? 1 : 0;
      counts.upper += to_lower ? 0 : 1;
    }
  }
  return counts;
}

void KdBuilder::partition_straddler(const KdReference& reference, const KdTask& task,
                                    const KdSplit& split, KdReference* lower_end,
                                    KdReference* upper_end, Counts& counts) const {
  ++counts.straddlers;
  const SplitExtent parts =
      split_extent(triangles_[reference.triangle], task.box, {reference.min, reference.max},
                   split.axis, split.position);
  if (!parts.lower.empty()) {
    *lower_end = {parts.lower.min, reference.triangle, parts.lower.max, 0};
    ++counts.lower;
  }
  if (!parts.upper.empty()) {
    *upper_end = {parts.upper.min, reference.triangle, parts.upper.max, 0};
    ++counts.upper;
  }
}

KdTask KdBuilder::child(const KdTask& parent, const KdSplit& split, bool upper,
                        const Counts& counts) const {
  // A split that is known to pay is bad only if neither child has fewer triangles: cutting off
  // empty space or an outlier serves the child that keeps the rest.
  const std::uint32_t count = upper ? counts.upper : counts.lower;
  const bool pays = split.worth == KdSplit::Worth::pays;
  const std::uint32_t judged = pays ? std::min(counts.lower, counts.upper) : count;
  const std::int64_t fewer = std::int64_t{parent.count} - std::int64_t{judged};
  const bool bad = split.worth == KdSplit::Worth::costs || fewer <= limits_.bad_margin;

  KdTask task = parent;
  (upper ? task.box.min : task.box.max)[split.axis] = split.position;
  task.count = count;
  task.depth = parent.depth + 1;
  task.bad_splits = parent.bad_splits + (bad ? 1 : 0);
  task.last_axis = split.axis;
  if (shared_out_) {
    const std::uint64_t both = std::uint64_t{counts.lower} + counts.upper + 2;
    task.budget = (parent.budget - 1) * (std::uint64_t{count} + 1) / both;
  }
  return task;
}

}  // namespace encore::accel
