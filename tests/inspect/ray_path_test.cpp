// A recorded ray does what the traversal does: the same hit, bit for bit, and the same counts, for
// every structure and every way in which a ray can be hard.
#include "accel/inspect/ray_path.h"

#include "accel/test_rays.h"
#include "built.h"

#include <cmath>
#include <cstring>
#include <map>

namespace encore::accel::test {
namespace {

using Event = RayStep::Event;
using Result = RayStep::Result;

struct Told {
  RayPath path;
  Hit hit;
};

Told tell(const Built& built, const Ray& ray) {
  Told told;
  built.structure->trace_path(ray, told.hit, told.path);
  return told;
}

TraceCounters count_events(const RayPath& path) {
  TraceCounters counters;
  for (const RayStep& step : path.steps) {
    counters.steps += step.event == Event::enter ? 1 : 0;
    counters.box_tests += step.event == Event::box ? 1 : 0;
    counters.triangle_tests += step.event == Event::triangle ? 1 : 0;
  }
  return counters;
}

/// The best hit follows from the tests, in order: each hit is nearer than the one before.
void expect_hits_lead_to(const RayPath& path, const Hit& hit) {
  Hit best;
  for (const RayStep& step : path.steps) {
    if (step.event != Event::triangle || step.result != Result::hit) continue;
    EXPECT_LE(step.enter, best.t);
    best = {step.enter, step.triangle, step.u, step.v};
  }
  EXPECT_EQ(best.triangle, hit.triangle);
  if (!hit.found()) return;
  EXPECT_EQ(best.t, hit.t);
  EXPECT_EQ(best.u, hit.u);
  EXPECT_EQ(best.v, hit.v);
}

/// Triangles are tested in the leaf or cell that was entered last, and belong to it.
void expect_triangles_belong(const Built& built, const RayPath& path) {
  std::span<const std::uint32_t> leaf;
  for (const RayStep& step : path.steps) {
    if (step.event == Event::enter) {
      const std::uint32_t node = built.table.index_of(step.place);
      leaf = {};
      if (node == kNoNode) {
        EXPECT_EQ(built.table.kind(), NodeKind::cells) << "only empty cells have no node";
      } else {
        leaf = built.table.triangles_of(*built.structure, node).value();
      }
    } else if (step.event == Event::triangle) {
      EXPECT_NE(std::ranges::find(leaf, step.triangle), leaf.end());
    }
  }
}

void expect_true_path(const Built& built, const Ray& ray) {
  Hit expected;
  TraceCounters counters;
  built.structure->intersect_counted({&ray, 1}, {&expected, 1}, {&counters, 1});
  const auto [path, hit] = tell(built, ray);
  EXPECT_EQ(std::memcmp(&hit, &expected, sizeof(Hit)), 0);
  EXPECT_TRUE(path.recorded);
  EXPECT_FALSE(path.cut());
  EXPECT_EQ(path.counters, counters);
  EXPECT_EQ(count_events(path), counters);
  ASSERT_FALSE(path.steps.empty());
  EXPECT_EQ(path.steps.back().event, Event::end);
  EXPECT_EQ(path.steps.back().triangle, expected.triangle);
  EXPECT_EQ(path.steps.back().enter, expected.t);
  expect_hits_lead_to(path, expected);
  expect_triangles_belong(built, path);
}

std::vector<NamedTriangles> path_scenes() {
  std::vector<NamedTriangles> scenes = all_test_scenes();
  scenes.push_back({"wheel", sample("wheel")});
  scenes.push_back({"stacked", stacked(300)});
  return scenes;
}

TEST(RayPath, IsWhatTheTraversalDoes) {
  for_all_structures(path_scenes(), [](const Built& built) {
    // Brute force tests everything for every ray: a few rays say all there is to say.
    const bool list = built.table.kind() == NodeKind::list;
    for (const RayKind kind : all_ray_kinds()) {
      SCOPED_TRACE(to_string(kind));
      const auto rays = test_rays(kind, list ? 3 : 60, 7, built.triangles, *built.structure);
      for (const Ray& ray : rays) {
        expect_true_path(built, ray);
        if (testing::Test::HasFailure()) return;
      }
    }
    expect_true_path(built, Ray{{1000, 1000, 1000}, 0.0F, {1, 0, 0}});
    expect_true_path(built, Ray{{0, 0, 0}, 0.0F, {0, 0, -1}});
  });
}

TEST(RayPath, OfARefittedTreeToo) {
  Built built(StructureKind::bvh_median, sample("toys"));
  for (Triangle& t : built.triangles) {
    for (vec3* v : {&t.v0, &t.v1, &t.v2}) v->x += 0.3F * std::sin(5.0F * v->y);
  }
  built.structure->update(built.triangles);
  // The table of before still names the nodes.
  for (const RayKind kind : all_ray_kinds()) {
    for (const Ray& ray : test_rays(kind, 40, 8, built.triangles, *built.structure)) {
      expect_true_path(built, ray);
    }
  }
}

TEST(RayPath, EntersOnlyChildrenOfWhatItEntered) {
  for (const StructureKind kind :
       {StructureKind::bvh_median, StructureKind::kd_median, StructureKind::kd_sah}) {
    const Built built(kind, sample("toys"));
    std::map<Event, std::size_t> events;
    for (const Ray& ray : test_rays(RayKind::outside, 200, 9, built.triangles, *built.structure)) {
      std::vector<bool> entered(built.table.size(), false);
      for (const RayStep& step : tell(built, ray).path.steps) {
        ++events[step.event];
        if (step.place == kNoHit) continue;
        const std::uint32_t node = built.table.index_of(step.place);
        ASSERT_NE(node, kNoNode);
        const std::uint32_t parent = built.table[node].parent;
        EXPECT_TRUE(parent == kNoNode || entered[parent]);
        if (step.event == Event::enter) {
          EXPECT_FALSE(entered[node]) << "twice";
          entered[node] = true;
        }
        if (step.event == Event::skipped) {
          EXPECT_FALSE(entered[node]);
          EXPECT_GT(step.enter, step.leave * 0.99999F);
        }
      }
    }
    EXPECT_GT(events[Event::skipped], 0U) << to_string(kind);
    EXPECT_GT(events[kind == StructureKind::bvh_median ? Event::box : Event::plane], 0U);
  }
}

TEST(RayPath, KnowsWhereCellsBegin) {
  const Built built(StructureKind::grid_exact, sample("toys"));
  std::size_t cells = 0;
  for (const Ray& ray : test_rays(RayKind::outside, 100, 9, built.triangles, *built.structure)) {
    float before = 0.0F;
    for (const RayStep& step : tell(built, ray).path.steps) {
      if (step.event != Event::enter || std::isnan(step.enter)) continue;
      EXPECT_GE(step.enter, before * 0.9999F) << "cells come one after the other";
      EXPECT_LE(step.enter, step.leave * 1.0001F);
      before = step.enter;
      ++cells;
    }
  }
  EXPECT_GT(cells, 100U);
}

TEST(RayPath, OfOneTriangle) {
  for (const StructureKind kind : all_structure_kinds()) {
    SCOPED_TRACE(to_string(kind));
    const Built built(kind, {make_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0})});
    const Ray at{{0, 0, 5}, 0.0F, {0, 0, -1}};
    expect_true_path(built, at);
    const RayPath path = tell(built, at).path;
    EXPECT_EQ(path.counters.triangle_tests, 1U);
    EXPECT_EQ(path.steps.back().triangle, 0U);
    EXPECT_EQ(path.steps.back().enter, 5.0F);
    expect_true_path(built, Ray{{0, 0, 0}, 0.0F, {1, 0, 0}});   // inside the plane
    expect_true_path(built, Ray{{-1, 0, 0}, 0.0F, {0, 1, 0}});  // along the box's edge
    const Ray away{{0, 0, 5}, 0.0F, {0, 0, 1}};
    expect_true_path(built, away);
    EXPECT_FALSE(tell(built, away).path.steps.back().hit);
  }
}

TEST(RayPath, OfAnEmptyScene) {
  for (const StructureKind kind : all_structure_kinds()) {
    const Built built(kind);
    const RayPath path = tell(built, Ray{}).path;
    EXPECT_TRUE(path.recorded);
    EXPECT_EQ(path.steps.back().event, Event::end);
    EXPECT_FALSE(path.steps.back().hit);
    EXPECT_EQ(describe(path.steps.back(), built.table), "end: nothing hit");
  }
}

TEST(RayPath, JudgesEveryTriangleOfALargeLeaf) {
  constexpr std::size_t kCount = 70'000;
  const Built built(StructureKind::kd_sah, stacked(kCount));
  const Ray at{{0.25F, 0.25F, 1}, 0.0F, {0, 0, -1}};
  expect_true_path(built, at);
  const RayPath path = tell(built, at).path;
  EXPECT_EQ(path.counters.triangle_tests, kCount);
  std::size_t hits = 0;
  std::size_t farther = 0;
  for (const RayStep& step : path.steps) {
    if (step.event != Event::triangle) continue;
    hits += step.result == Result::hit ? 1 : 0;
    farther += step.result == Result::farther ? 1 : 0;
  }
  EXPECT_EQ(hits, 1U) << "at equal distance the lowest index stays";
  EXPECT_EQ(farther, kCount - 1);
}

TEST(RayPath, IsCutWhereItsMemoryEnds) {
  const Built built(StructureKind::kd_sah, stacked(500));
  const Ray at{{0.25F, 0.25F, 1}, 0.0F, {0, 0, -1}};
  const RayPath whole = tell(built, at).path;
  RayPath path;
  path.most_steps = 100;
  Hit hit;
  built.structure->trace_path(at, hit, path);
  EXPECT_TRUE(path.cut());
  EXPECT_EQ(path.steps.size(), 101U) << "the end is always there";
  EXPECT_EQ(path.steps.size() + path.left_out, whole.steps.size());
  EXPECT_EQ(path.counters, whole.counters);
  EXPECT_EQ(path.steps.back().triangle, 0U);
  EXPECT_NE(summary(path).find("too many to keep"), std::string::npos);
  // A second ray starts afresh.
  path.most_steps = 10'000;
  built.structure->trace_path(at, hit, path);
  EXPECT_FALSE(path.cut());
  EXPECT_EQ(path.steps.size(), whole.steps.size());
}

TEST(RayPath, SaysWhatHappensInPlainSentences) {
  const Built bvh(StructureKind::bvh_median, soup(2, 1.0F, 2));
  RayStep step{.event = Event::enter, .enter = 12.31F, .leave = NAN};
  bvh.structure->visit([&step](const NodeView& view) {
    if (view.depth == 0) step.place = view.place;
    return true;
  });
  EXPECT_EQ(describe(step, bvh.table), "node 0 (depth 0): entered at 12.31");
  step.event = Event::skipped;
  step.enter = 14.1F;
  step.leave = 12.4F;
  EXPECT_EQ(describe(step, bvh.table),
            "node 0 (depth 0): skipped, begins at 14.1 behind the hit at 12.4");
  step.event = Event::box;
  EXPECT_EQ(describe(step, bvh.table), "node 0 (depth 0): box missed");
  step.hit = true;
  EXPECT_EQ(describe(step, bvh.table), "node 0 (depth 0): box met at 14.1");
  step = {.event = Event::triangle, .triangle = 4711};
  EXPECT_EQ(describe(step, bvh.table), "triangle 4711: missed");
  step.result = Result::hit;
  step.enter = 12.4F;
  step.u = 0.2F;
  step.v = 0.31F;
  EXPECT_EQ(describe(step, bvh.table), "triangle 4711: hit at 12.4, u 0.20, v 0.31");
  const Built grid(StructureKind::grid_box, sample("mug"));
  step = {.event = Event::enter, .place = 0, .enter = 1.0F, .leave = 2.0F};
  EXPECT_EQ(describe(step, grid.table).substr(0, 14), "cell (0, 0, 0)");
}

TEST(RayPath, DescribesEveryStepOfEveryStructure) {
  for_all_structures({{"toys", sample("toys")}}, [](const Built& built) {
    for (const RayKind kind : all_ray_kinds()) {
      for (const Ray& ray : test_rays(kind, 3, 10, built.triangles, *built.structure)) {
        const RayPath path = tell(built, ray).path;
        EXPECT_NE(summary(path), summary(RayPath{}));
        for (std::size_t i = 0; i < std::min<std::size_t>(path.steps.size(), 300); ++i) {
          const std::string text = describe(path.steps[i], built.table);
          EXPECT_EQ(text.find("nan"), std::string::npos) << text;
          EXPECT_EQ(text.find("4294967295"), std::string::npos) << text;
        }
      }
    }
  });
}

/// A structure that knows nothing of recording.
class Silent final : public AccelerationStructure {
 public:
  [[nodiscard]] std::string_view name() const override { return "silent"; }
  void build(std::span<const Triangle>) override { mark_changed(); }
  void intersect(std::span<const Ray>, std::span<Hit> hits) const override {
    for (Hit& hit : hits) hit = {.t = 3.0F, .triangle = 5};
  }
  void intersect_counted(std::span<const Ray> rays, std::span<Hit> hits,
                         std::span<TraceCounters>) const override {
    intersect(rays, hits);
  }
  void occluded(std::span<const Ray>, std::span<std::uint8_t>) const override {}
  [[nodiscard]] BuildStats stats() const override { return {}; }
  [[nodiscard]] GpuBuffers gpu_buffers() const override { return {}; }
  void visit(const std::function<bool(const NodeView&)>&) const override {}
};

TEST(RayPath, OfAStructureThatCannotTellHasTheHitOnly) {
  RayPath path;
  path.steps.resize(3);
  Hit hit;
  Silent().trace_path(Ray{}, hit, path);
  EXPECT_EQ(hit.triangle, 5U);
  EXPECT_FALSE(path.recorded);
  EXPECT_TRUE(path.steps.empty());
  EXPECT_EQ(summary(path), "this structure does not tell what a ray does");
}

}  // namespace
}  // namespace encore::accel::test
