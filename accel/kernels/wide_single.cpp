// bvh-sah, each ray on its own way: several are under way at once, so that the memory and
// arithmetic of one is waited for while others go on.
#include "accel/kernels/block_testers.h"
#include "accel/kernels/child_order.h"
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/slab_ray.h"
#include "accel/wide/wide_kernels.h"

namespace encore::accel::ENCORE_ISA {

namespace {

/// A ray under way.
template <class Blocks>
struct alignas(64) TracedRay {
  SlabRay slabs;
  Blocks blocks;
  std::uint32_t child;  ///< where it is
  std::uint32_t ray;
  std::uint32_t top;  ///< how many nodes wait
  // Nodes that wait, and where the ray enters their boxes: the first stands for the end; at the end
  // is room for what push_in_order() overwrites.
  std::uint32_t places[WideTree::kStackSize + 9];
  float enters[WideTree::kStackSize + 9];
};

[[gnu::always_inline]] inline void write(const BestHit& hit, scene::Hit& to) {
  to.t = hit.t;
  to.triangle = hit.triangle;
  to.u = hit.u;
  to.v = hit.v;
}

/// Has an element on its way from memory.
template <class Element>
[[gnu::always_inline]] inline void prefetch(const Element* element) {
  const auto* const from = reinterpret_cast<const char*>(element);
  for (std::size_t i = 0; i < sizeof(Element); i += 64) __builtin_prefetch(from + i);
}

/// Rounds of all the rays that are under way, in passes that hardly branch: what is unforeseeable
/// about a ray is which list it comes to stand in.
template <bool AnyHit, class Blocks, class Answer>
class Stream {
  using Traveller = TracedRay<Blocks>;

 public:
  static constexpr std::uint32_t kTogether = 32;

  [[gnu::always_inline]] Stream(const WideView& tree, const scene::Triangle* triangles,
                                const scene::Ray* rays, std::size_t count, Answer* answers)
      : tree_(tree), triangles_(triangles), rays_(rays), count_(count), answers_(answers) {}

  [[gnu::always_inline]] void run() {
    if (tree_.node_count == 0) {
      for (std::size_t i = 0; i < count_; ++i) answer(i, miss(rays_[i]));
      return;
    }
    for (Traveller& t : travellers_) {
      t.enters[0] = -__builtin_inff();
      t.places[0] = WideChild::kNoChild;
      start(&t);
    }
    while ((length_.nodes | length_.leaves) != 0) round();
  }

 private:
  /// Where rays stand: at nodes, at leaves or at their end.
  enum List : std::uint32_t { kNode, kLeaf, kEnd };
  struct Lengths {
    std::size_t nodes, leaves, ends;
  };

#if defined(__AVX2__)
  static constexpr bool kTwoAtOnce = true;  ///< two blocks of four fill a register
#else
  static constexpr bool kTwoAtOnce = false;
#endif

  /// Nodes that together are no larger than this are close at hand, so that asking for them ahead
  /// costs more than waiting for them.
  static constexpr std::size_t kCachedNodes = (std::size_t{2} << 20) / sizeof(gpu::WideNode);

  [[gnu::always_inline]] void round() {
    const WideView tree = tree_;  // so that no store makes the compiler read it again
    const std::size_t nodes = length_.nodes, leaves = length_.leaves;
    if (tree.node_count > kCachedNodes) {
      for (std::size_t i = 0; i < leaves; ++i) {
        prefetch(tree.blocks + WideChild::first_block(list_[kLeaf][i]->child));
      }
      for (std::size_t i = 0; i < nodes; ++i) prefetch(tree.nodes + list_[kNode][i]->child);
    }
    for (std::size_t i = 0; i < nodes; ++i) visit(tree, *list_[kNode][i]);
    const std::size_t candidates = look_at_leaves(tree, leaves);
    for (std::size_t i = 0; i < candidates; ++i) judge(*candidate_[i]);
    Lengths now{0, 0, 0};
    // No ray has left its list before what stood in its place was read.
    for (std::size_t i = 0; i < leaves; ++i) candidate_[i] = list_[kLeaf][i];
    for (std::size_t i = 0; i < nodes; ++i) go_on(list_[kNode][i], now);
    for (std::size_t i = 0; i < leaves; ++i) go_on(candidate_[i], now);
    length_ = now;
    for (std::size_t i = 0; i < now.ends; ++i) {
      Traveller* const t = list_[kEnd][i];
      answer(t->ray, t->blocks.hit);
      start(t);
    }
  }

  [[gnu::always_inline]] static const TriangleBlock& block(const WideView& tree,
                                                           const Traveller& t) {
    return tree.blocks[WideChild::first_block(t.child)];
  }

  /// Puts the rays for whom a block may hold a hit into candidate_, and returns how many they are.
  [[gnu::always_inline]] std::size_t look_at_leaves(const WideView& tree, std::size_t leaves) {
    std::size_t candidates = 0, i = 0;
    const auto looked = [&](Traveller * t, bool candidate) __attribute__((always_inline)) {
      candidate_[candidates] = t;
      candidates += candidate ? 1 : 0;
      // The leaf's other blocks wait like a node that the ray is in already.
      t->enters[t->top] = -__builtin_inff();
      t->places[t->top] = WideChild::next_block(t->child);
      t->top += WideChild::blocks(t->child) > 1 ? 1 : 0;
    };
    for (; kTwoAtOnce && i + 1 < leaves; i += 2) {
      Traveller* const a = list_[kLeaf][i];
      Traveller* const b = list_[kLeaf][i + 1];
      const unsigned both =
          Blocks::look_both(a->blocks, block(tree, *a), b->blocks, block(tree, *b));
      looked(a, (both & 0xFU) != 0);
      looked(b, (both >> 4U) != 0);
    }
    for (; i < leaves; ++i) {
      Traveller* const t = list_[kLeaf][i];
      looked(t, t->blocks.look(block(tree, *t)));
    }
    return candidates;
  }

  [[gnu::always_inline]] static void visit(const WideView& tree, Traveller& t) {
    const gpu::WideNode& node = tree.nodes[t.child];
    Floats<8> enter;
    const Mask<8> met = t.slabs.test(node, enter);
    if constexpr (AnyHit) {
      t.top += push_as_they_are(met, node.child, t.places + t.top);
    } else {
      t.top += push_in_order(enter, met, node.child, t.enters + t.top, t.places + t.top);
    }
  }

  [[gnu::always_inline]] void judge(Traveller& t) {
    const std::uint32_t block = WideChild::first_block(t.child);
    if (!t.blocks.judge(tree_.blocks[block], tree_.ids + TriangleBlock::kSize * block)) return;
    if constexpr (AnyHit) {
      t.top = 1;
    } else {
      t.slabs.set_limit(t.blocks.limit());
    }
  }

  /// To the nearest node that waits and is not behind the best hit.
  [[gnu::always_inline]] void go_on(Traveller* t, Lengths& now) {
    std::uint32_t top = t->top;
    do --top;
    while (!AnyHit && t->enters[top] > t->slabs.limit());
    t->top = top;
    const std::uint32_t child = t->places[top];
    t->child = child;
    // Into all three lists, of which one keeps it: which one cannot be foreseen.
    const std::size_t outer = child >> 31U;
    const std::size_t end = child == WideChild::kNoChild ? 1 : 0;
    list_[kNode][now.nodes] = t;
    list_[kLeaf][now.leaves] = t;
    list_[kEnd][now.ends] = t;
    now.nodes += 1 - outer;
    now.leaves += outer - end;
    now.ends += end;
  }

  /// Gives the next ray to a place that has none.
  [[gnu::always_inline]] void start(Traveller* t) {
    while (next_ < count_) {
      const std::size_t i = next_++;
      const scene::Ray& ray = rays_[i];
      if (!t->slabs.prepare(ray)) [[unlikely]] {
        answer(i, miss(ray));
        continue;
      }
      t->blocks.start(ray, triangles_);
      t->slabs.set_limit(t->blocks.limit());
      t->ray = static_cast<std::uint32_t>(i);
      t->top = 1;
      t->child = 0;
      list_[kNode][length_.nodes++] = t;
      return;
    }
  }

  [[gnu::always_inline]] void answer(std::size_t ray, const BestHit& hit) {
    if constexpr (AnyHit) {
      answers_[ray] = hit.triangle != scene::kNoHit ? 1 : 0;
    } else {
      write(hit, answers_[ray]);
    }
  }

  const WideView& tree_;
  const scene::Triangle* triangles_;
  const scene::Ray* rays_;
  std::size_t count_;
  std::size_t next_ = 0;
  Answer* answers_;
  Lengths length_{0, 0, 0};
  Traveller* list_[3][kTogether];
  Traveller* candidate_[kTogether];
  Traveller travellers_[kTogether];
};

template <class Blocks>
void intersect(const WideView& tree, const scene::Triangle* triangles, const scene::Ray* rays,
               std::size_t count, scene::Hit* hits) {
  Stream<false, Blocks, scene::Hit>(tree, triangles, rays, count, hits).run();
  if (!Blocks::kNeedsFinish) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (hits[i].triangle == scene::kNoHit) continue;
    const std::uint32_t index = hits[i].triangle;
    if (exact_hit(rays[i], triangles[index], index, hits[i])) continue;
    BestHit hit = miss(rays[i]);
    decide_precisely(rays[i], triangles, index, hit);
    write(hit, hits[i]);
  }
}

template <class Blocks>
void occluded(const WideView& tree, const scene::Triangle* triangles, const scene::Ray* rays,
              std::size_t count, std::uint8_t* blocked) {
  Stream<true, Blocks, std::uint8_t>(tree, triangles, rays, count, blocked).run();
}

}  // namespace

const WideSingleKernels& single_kernels();

const WideSingleKernels& single_kernels() {
  // The precise mode's and the watertight one's any-hit answers are the same.
  static constexpr WideSingleKernels kernels{
      {intersect<PreciseBlocks>, intersect<MollerTrumboreBlocks>, intersect<WatertightBlocks>},
      {occluded<WatertightBlocks>, occluded<MollerTrumboreBlocks>, occluded<WatertightBlocks>}};
  return kernels;
}

}  // namespace encore::accel::ENCORE_ISA
