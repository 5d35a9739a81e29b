// A tree that the device builds is sound, the same each time, and loses no hit.
#include "renderer/gpu_build.h"

#include "accel/test_rays.h"
#include "tests/bvh/test_scenes.h"
#include "tests/gpu/gpu_scenes.h"

#include <algorithm>
#include <optional>
#include <span>

namespace encore::renderer::test {
namespace {

using accel::BuildPreset;
using accel::StructureKind;
using accel::test::Triangles;

accel::StructureSpec fast_spec() {
  return {.kind = StructureKind::bvh_sah,
          .settings = accel::BvhSettings{.preset = BuildPreset::fast}};
}

struct Leaf {
  std::uint32_t code;
  std::uint32_t triangle;
};

template <class T>
std::vector<T> contents(const gl::Buffer& buffer, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0) buffer.read(std::as_writable_bytes(std::span(values)));
  return values;
}

class GpuBuildTest : public encore::test::GlTest {
 protected:
  void build(const Triangles& triangles) {
    gl::Buffer buffer("the triangles");
    buffer.reserve(triangles.size() * sizeof(scene::Triangle), 1U << 30);
    if (!triangles.empty()) buffer.write(std::as_bytes(std::span(triangles)));
    if (!build_) build_.emplace(context_);
    build_->run(buffer, static_cast<std::uint32_t>(triangles.size()));
    leaves_ = contents<Leaf>(build_->sorted(), triangles.size());
    nodes_ = contents<gpu::BvhNode>(build_->nodes(), build_->node_count());
  }

  void expect_sorted(std::size_t count) const {
    std::vector<bool> seen(count, false);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_LT(leaves_[i].triangle, count);
      EXPECT_FALSE(seen[leaves_[i].triangle]) << "twice";
      seen[leaves_[i].triangle] = true;
      if (i == 0) continue;
      const Leaf& a = leaves_[i - 1];
      const Leaf& b = leaves_[i];
      ASSERT_TRUE(a.code < b.code || (a.code == b.code && a.triangle < b.triangle)) << i;
    }
  }

  /// Every triangle in one leaf, every box exactly that of what is below it, no path too long.
  void expect_sound(const Triangles& triangles) const {
    std::vector<int> found(triangles.size(), 0);
    std::size_t visited = 0;
    if (!triangles.empty()) walk(0, 0, triangles, found, visited);
    EXPECT_EQ(visited, nodes_.size());
    EXPECT_EQ(std::count(found.begin(), found.end(), 1),
              static_cast<std::ptrdiff_t>(triangles.size()));
  }

  std::optional<GpuBuild> build_;
  std::vector<Leaf> leaves_;
  std::vector<gpu::BvhNode> nodes_;

 private:
  scene::Bounds walk(std::uint32_t index, std::uint32_t depth, const Triangles& triangles,
                     std::vector<int>& found, std::size_t& visited) const {
    scene::Bounds box;
    if (index >= nodes_.size() || ++visited > nodes_.size() || depth > build_->most_depth()) {
      ADD_FAILURE() << "node " << index << " of " << nodes_.size() << ", depth " << depth;
      return box;
    }
    const gpu::BvhNode& node = nodes_[index];
    if (node.count == 0) {
      for (const std::uint32_t child : {node.first, node.first + 1}) {
        box.extend(walk(child, depth + 1, triangles, found, visited));
      }
    } else {
      EXPECT_EQ(node.count, 1U);
      EXPECT_LT(node.first, triangles.size());
      if (node.first >= triangles.size()) return box;
      ++found[node.first];
      const scene::Triangle& t = triangles[node.first];
      for (const glm::vec3& vertex : {t.v0, t.v1, t.v2}) box.extend(vertex);
    }
    EXPECT_EQ(node.min, box.min) << index;
    EXPECT_EQ(node.max, box.max) << index;
    return box;
  }
};

TEST_F(GpuBuildTest, CodesInterleaveTheBitsOfTheCentres) {
  // Corners of a box fix the scale; one triangle in the middle of a known cell of 1024 an axis.
  const auto at = [](const glm::vec3& center) {
    return scene::make_triangle(center - glm::vec3(0.25F, 0, 0), center + glm::vec3(0.25F, 0, 0),
                                center + glm::vec3(0.0F, 0, 0));
  };
  build({at({1024, 2048, 512}), at({5.5F, 2 * 10.5F, 0.5F * 3.5F}), at({0, 0, 0})});
  ASSERT_EQ(leaves_.size(), 3U);
  EXPECT_EQ(leaves_[0].triangle, 2U);
  EXPECT_EQ(leaves_[0].code, 0U);
  EXPECT_EQ(leaves_[1].triangle, 1U);
  // x = 0101, y = 1010, z = 0011, as zyx from the highest bit on.
  EXPECT_EQ(leaves_[1].code, 0b010'001'110'101U);
  EXPECT_EQ(leaves_[2].triangle, 0U);
  EXPECT_EQ(leaves_[2].code, 0x3FFFFFFFU);
}

TEST_F(GpuBuildTest, SortsAnyNumberOfTrianglesAndBuildsASoundTree) {
  // Around the sizes of work groups, blocks and rows of counts, growing and shrinking.
  for (const std::size_t count :
       {5U, 1U, 2U, 3U, 127U, 129U, 1023U, 1024U, 1025U, 9000U, 0U, 40U}) {
    SCOPED_TRACE(count);
    const Triangles triangles =
        accel::test::soup(count, 3.0F, static_cast<std::uint32_t>(count) + 1);
    build(triangles);
    expect_sorted(count);
    expect_sound(triangles);
  }
}

TEST_F(GpuBuildTest, EqualCodesStayInOrder) {
  const Triangles triangles = accel::test::identical(3000);
  build(triangles);
  expect_sorted(triangles.size());
  expect_sound(triangles);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) ASSERT_EQ(leaves_[i].triangle, i);
  // The bits of a code, and those of 3,000 places.
  EXPECT_EQ(build_->most_depth(), 30U + 12U);
}

TEST_F(GpuBuildTest, IsSoundOnHostileScenes) {
  for (const auto& [name, triangles] : accel::test::all_test_scenes()) {
    SCOPED_TRACE(name);
    build(triangles);
    expect_sorted(triangles.size());
    expect_sound(triangles);
  }
  const Triangles base = accel::test::soup(300, 1.0F, 9);
  for (const float scale : {0x1p-140F, 0x1p-126F, 0x1p-60F, 0x1p60F, 0x1p120F}) {
    SCOPED_TRACE(scale);
    const Triangles triangles = accel::test::scaled(base, scale);
    build(triangles);
    expect_sorted(triangles.size());
    expect_sound(triangles);
  }
}

TEST_F(GpuBuildTest, GivesTheSameTreeEachTime) {
  const Triangles triangles = accel::test::soup(5000, 2.0F, 77);
  build(triangles);
  const std::vector<gpu::BvhNode> first = nodes_;
  build(accel::test::soup(200, 1.0F, 3));
  build(triangles);
  ASSERT_EQ(nodes_.size(), first.size());
  EXPECT_EQ(std::memcmp(nodes_.data(), first.data(), first.size() * sizeof(gpu::BvhNode)), 0);
}

TEST_F(GpuBuildTest, RaysFindTheHitsOfTheCpu) {
  GpuTracer tracer(context_);
  auto scenes = accel::test::all_test_scenes();
  scenes.push_back({"deep", accel::test::one_a_level(300)});
  for (auto& [name, triangles] : scenes) {
    const auto setup = scene_of(std::move(triangles), fast_spec());
    tracer.init(setup->input());
    ASSERT_TRUE(tracer.can_build());
    EXPECT_FALSE(tracer.built());
    tracer.build();
    EXPECT_TRUE(tracer.built());
    for (const accel::RayKind kind : accel::all_ray_kinds()) {
      const auto rays = accel::test_rays(kind, 150, 7, setup->list.triangles, *setup->structure);
      expect_structure_hits(tracer, *setup->structure, rays, name);
    }
  }
}

TEST_F(GpuBuildTest, AMovingSceneSendsItsTrianglesAlone) {
  const auto setup = sample_scene("toys", fast_spec());
  auto host = accel::make_structure(fast_spec());
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  const auto expect_hits = [&](const std::string& what) {
    host->build(setup->list.triangles);
    for (const accel::RayKind kind : {accel::RayKind::inside, accel::RayKind::edge}) {
      const auto rays = accel::test_rays(kind, 700, 8, setup->list.triangles, *host);
      expect_structure_hits(tracer, *host, rays, what);
    }
  };
  for (const double time_s : {0.2, 0.5}) {
    const std::uint64_t before = setup->list.version;
    scene::update_triangles(setup->scene, time_s, setup->list);
    std::size_t moved = 0;
    for (const auto& range : scene::changed_since(setup->list, before)) moved += range.count;
    const std::uint64_t version = setup->structure->version();
    tracer.refresh();
    EXPECT_EQ(tracer.last_transfer().uploaded_bytes,
              moved * (sizeof(scene::Triangle) + (setup->list.normals.empty() ? 0 : 36)));
    tracer.build();
    EXPECT_EQ(setup->structure->version(), version) << "the host's structure is not touched";
    expect_hits("built");
  }
  // It can be fitted instead.
  scene::update_triangles(setup->scene, 0.8, setup->list);
  tracer.refresh();
  ASSERT_TRUE(tracer.built());
  tracer.refit();
  expect_hits("fitted");
  // A build on the host takes its place.
  setup->structure->build(setup->list.triangles);
  tracer.refresh();
  EXPECT_FALSE(tracer.built());
  expect_hits("the host's");
  scene::update_triangles(setup->scene, 0.9, setup->list);
  tracer.refresh();
  tracer.refit();
  expect_hits("the host's, fitted");
}

TEST_F(GpuBuildTest, ItsPicturesAreThoseOfTheHostsStructure) {
  const auto setup = sample_scene("toys", fast_spec());
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  Image expected;
  Image found;
  expected.resize(40, 30);
  found.resize(40, 30);
  tracer.render(setup->scene.camera, expected);
  tracer.build();
  tracer.render(setup->scene.camera, found);
  EXPECT_EQ(std::memcmp(found.pixels.data(), expected.pixels.data(),
                        found.pixels.size() * sizeof(found.pixels[0])),
            0);
  scene::RaySettings rays;
  rays.shadows = true;
  tracer.set_rays(rays);
  tracer.refresh();
  EXPECT_TRUE(tracer.built());
  tracer.render(setup->scene.camera, found);
  GpuTracer other(context_);
  other.set_rays(rays);
  other.init(setup->input());
  other.render(setup->scene.camera, expected);
  EXPECT_EQ(std::memcmp(found.pixels.data(), expected.pixels.data(),
                        found.pixels.size() * sizeof(found.pixels[0])),
            0);
}

TEST_F(GpuBuildTest, FollowsTrianglesThatComeAndGo) {
  const auto setup = scene_of(accel::test::soup(60, 1.0F, 2), fast_spec());
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  tracer.build();
  auto host = accel::make_structure(fast_spec());
  for (const std::size_t count : {1U, 0U, 2000U, 2U}) {
    setup->move_to(accel::test::soup(count, 1.0F, 3));
    ++setup->list.topology_version;
    tracer.refresh();
    EXPECT_FALSE(tracer.built()) << "the old tree is of other triangles";
    tracer.build();
    host->build(setup->list.triangles);
    std::vector<scene::Ray> rays{{{0, 0, 5}, 0, {0, 0, -1}}};
    if (count > 0) {
      rays = accel::test_rays(accel::RayKind::inside, 300, 4, setup->list.triangles, *host);
    }
    expect_structure_hits(tracer, *host, rays, std::to_string(count));
  }
}

TEST_F(GpuBuildTest, IsForTheFastPresetAlone) {
  GpuTracer tracer(context_);
  EXPECT_FALSE(tracer.can_build());
  EXPECT_THROW(tracer.build(), std::logic_error);
  for (const auto& spec : {spec_of(StructureKind::bvh_median), spec_of(StructureKind::bvh_sah),
                           spec_of(StructureKind::grid_box)}) {
    const auto setup = scene_of(accel::test::soup(9, 1.0F, 2), spec);
    tracer.init(setup->input());
    EXPECT_FALSE(tracer.can_build());
    EXPECT_THROW(tracer.build(), std::logic_error);
  }
}

}  // namespace
}  // namespace encore::renderer::test
