#include "scene/triangles.h"

#include "scene/basic_shapes.h"
#include "scene/placement.h"
#include "support.h"

#include <cmath>
#include <limits>

namespace encore::scene::test {
namespace {

Instance instance_of(Model model) {
  Instance instance;
  instance.name = model.name;
  instance.model = std::make_shared<const Model>(std::move(model));
  return instance;
}

RigidMotion sliding() {
  RigidMotion motion;
  Transform end;
  end.translation = {4.0F, 0.0F, 0.0F};
  motion.keys = {{0.0F, {}}, {1.0F, end}, {2.0F, end}, {4.0F, {}}};
  return motion;
}

/// A resting box, a sliding square, a resting sphere.
Scene three_parts() {
  Scene scene;
  scene.materials.resize(3);
  scene.instances = {instance_of(box_model()), instance_of(square_model()),
                     instance_of(sphere_model(8, 4))};
  scene.instances[1].motion = sliding();
  scene.instances[1].first_material = 1;
  scene.instances[2].first_material = 2;
  return scene;
}

FrameSequence frames_of(std::vector<Model> models) {
  FrameSequence sequence;
  for (Model& model : models) {
    sequence.frames.push_back(std::make_shared<const Model>(std::move(model)));
  }
  return sequence;
}

TEST(Triangles, AnEmptySceneIsValid) {
  const Scene scene;
  TriangleList list;
  EXPECT_EQ(update_triangles(scene, 0.0, list), TriangleChange::topology);
  EXPECT_TRUE(list.triangles.empty());
  EXPECT_TRUE(list.bounds().empty());
  EXPECT_EQ(update_triangles(scene, 1.0, list), TriangleChange::none);
}

TEST(Triangles, VerticesAreExactCopiesOfAnUnmovedMesh) {
  Scene scene;
  scene.instances = {instance_of(sphere_model(7, 5))};
  const TriangleList list = triangles_at(scene);
  const Mesh& mesh = scene.instances[0].model->mesh;
  ASSERT_EQ(list.triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < list.triangles.size(); ++i) {
    EXPECT_EQ(list.triangles[i].v0, mesh.positions[mesh.triangles[i].x]);
    EXPECT_EQ(list.triangles[i].v2, mesh.positions[mesh.triangles[i].z]);
  }
}

TEST(Triangles, MaterialsAreOffsetByTheInstancesFirst) {
  Scene scene = three_parts();
  Model model = square_model();
  model.mesh.material_of = {0, 1};
  scene.instances.push_back(instance_of(std::move(model)));
  scene.instances[3].first_material = 5;
  const TriangleList list = triangles_at(scene);
  EXPECT_EQ(list.triangles[0].material, 0U);
  EXPECT_EQ(list.triangles[12].material, 1U);
  EXPECT_EQ(list.triangles[14].material, 2U);
  EXPECT_EQ(list.triangles[list.triangles.size() - 2].material, 5U);
  EXPECT_EQ(list.triangles.back().material, 6U);
}

TEST(Triangles, NothingChangesWhileNothingMoves) {
  const Scene scene = three_parts();
  TriangleList list;
  EXPECT_EQ(update_triangles(scene, 1.0, list), TriangleChange::topology);
  const auto version = list.version;
  const auto topology = list.topology_version;
  // The same time, a held pose and the same pose a loop later.
  EXPECT_EQ(update_triangles(scene, 1.0, list), TriangleChange::none);
  EXPECT_EQ(update_triangles(scene, 1.5, list), TriangleChange::none);
  EXPECT_EQ(update_triangles(scene, 5.0, list), TriangleChange::none);
  EXPECT_EQ(list.version, version);
  EXPECT_EQ(list.topology_version, topology);
}

TEST(Triangles, OnlyMovingInstancesAreRewritten) {
  const Scene scene = three_parts();
  TriangleList list;
  update_triangles(scene, 0.0, list);
  // Spoil a resting triangle on each side and a moving one: only the latter is written again.
  const glm::vec3 mark(123.0F);
  list.triangles[0].v0 = mark;
  list.triangles[12].v0 = mark;
  list.triangles[14].v0 = mark;
  EXPECT_EQ(update_triangles(scene, 0.5, list), TriangleChange::moved);
  EXPECT_EQ(list.triangles[0].v0, mark);
  EXPECT_TRUE(near(list.triangles[12].v0, {1.5F, -0.5F, 0.0F}));
  EXPECT_EQ(list.triangles[14].v0, mark);
}

TEST(Triangles, MovingCountsTheVersionButNotTheTopology) {
  const Scene scene = three_parts();
  TriangleList list;
  update_triangles(scene, 0.0, list);
  const auto version = list.version;
  const auto topology = list.topology_version;
  EXPECT_EQ(update_triangles(scene, 0.25, list), TriangleChange::moved);
  EXPECT_EQ(list.version, version + 1);
  EXPECT_EQ(list.topology_version, topology);
}

TEST(Triangles, WhatChangedSinceAVersionIsKnownByRange) {
  const Scene scene = three_parts();
  TriangleList list;
  update_triangles(scene, 0.0, list);
  const std::uint64_t first = list.version;
  const auto all = changed_since(list, 0);
  ASSERT_EQ(all.size(), 1U) << "neighbours are joined";
  EXPECT_EQ(all[0].first, 0U);
  EXPECT_EQ(all[0].count, list.triangles.size());
  EXPECT_TRUE(changed_since(list, first).empty());

  update_triangles(scene, 0.5, list);
  const auto moved = changed_since(list, first);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].first, 12U);
  EXPECT_EQ(moved[0].count, 2U);
  EXPECT_TRUE(changed_since(list, list.version).empty());

  // Also across updates in which it rested.
  const std::uint64_t second = list.version;
  update_triangles(scene, 1.2, list);
  const std::uint64_t third = list.version;
  update_triangles(scene, 1.8, list);
  EXPECT_EQ(list.version, third);
  EXPECT_EQ(changed_since(list, second).size(), 1U);
  EXPECT_TRUE(changed_since(list, third).empty());
}

TEST(Triangles, NothingIsAllocatedWhileTheCountStays) {
  Scene scene = three_parts();
  Deformer deformer;
  scene.instances[2].motion = deformer;
  TriangleList list;
  update_triangles(scene, 0.0, list);
  const auto* triangles = list.triangles.data();
  const auto* normals = list.normals.data();
  const auto* positions = list.bookkeeping.positions.data();
  const auto capacity = list.triangles.capacity();
  for (int i = 1; i < 20; ++i) update_triangles(scene, 0.1 * i, list);
  EXPECT_EQ(list.triangles.data(), triangles);
  EXPECT_EQ(list.normals.data(), normals);
  EXPECT_EQ(list.bookkeeping.positions.data(), positions);
  EXPECT_EQ(list.triangles.capacity(), capacity);
}

TEST(Triangles, AStaticSceneKeepsNoScratchSpace) {
  Scene scene;
  scene.instances = {instance_of(sphere_model())};
  const TriangleList list = triangles_at(scene);
  EXPECT_EQ(list.bookkeeping.positions.capacity(), 0U);
  EXPECT_EQ(list.bookkeeping.vertex_normals.capacity(), 0U);
}

TEST(Triangles, IncrementalUpdatesEqualAFreshList) {
  Scene scene = three_parts();
  Deformer deformer;
  deformer.kind = Deformer::Kind::explode;
  scene.instances[2].motion = deformer;
  scene.instances.push_back(instance_of(square_model()));
  scene.instances[3].motion =
      frames_of({square_model(), box_model(), sphere_model(5, 3), square_model()});
  TriangleList list;
  for (const double time : {0.0, 0.13, 0.21, 0.35, 1.2, 0.05, 3.9, 0.0}) {
    update_triangles(scene, time, list);
    const TriangleList fresh = triangles_at(scene, time);
    ASSERT_EQ(list.triangles.size(), fresh.triangles.size());
    for (std::size_t i = 0; i < fresh.triangles.size(); ++i) {
      ASSERT_EQ(list.triangles[i].v0, fresh.triangles[i].v0);
      ASSERT_EQ(list.triangles[i].v1, fresh.triangles[i].v1);
      ASSERT_EQ(list.triangles[i].v2, fresh.triangles[i].v2);
      ASSERT_EQ(list.normals[i], fresh.normals[i]);
    }
  }
}

TEST(Triangles, EditsAreSeenByTheScenesVersion) {
  Scene scene = three_parts();
  TriangleList list;
  update_triangles(scene, 0.0, list);
  scene.mark_changed();
  EXPECT_EQ(update_triangles(scene, 0.0, list), TriangleChange::none);  // nothing really changed
  scene.instances[0].transform[3].x = 7.0F;
  scene.mark_changed();
  EXPECT_EQ(update_triangles(scene, 0.0, list), TriangleChange::moved);
  scene.instances.pop_back();
  scene.mark_changed();
  EXPECT_EQ(update_triangles(scene, 0.0, list), TriangleChange::topology);
  EXPECT_EQ(list.triangles.size(), 14U);
}

TEST(Triangles, AFrameSequenceThatChangesItsCountChangesTheTopology) {
  Scene scene;
  scene.instances = {instance_of(square_model()), instance_of(box_model())};
  scene.instances[0].motion = frames_of({square_model(), sphere_model(4, 2)});
  TriangleList list;
  update_triangles(scene, 0.0, list);
  EXPECT_EQ(list.triangles.size(), 14U);
  const glm::vec3 box_corner = list.triangles[2].v0;
  const auto topology = list.topology_version;
  EXPECT_EQ(update_triangles(scene, 0.1, list), TriangleChange::topology);
  EXPECT_EQ(list.triangles.size(), 20U);
  EXPECT_EQ(list.triangles[8].v0, box_corner);  // what follows moved up
  EXPECT_EQ(list.topology_version, topology + 1);
  EXPECT_EQ(update_triangles(scene, 0.2, list), TriangleChange::topology);
  EXPECT_EQ(list.triangles.size(), 14U);
}

TEST(Triangles, FramesOfOneConnectivityOnlyMove) {
  Model second = box_model();
  for (glm::vec3& p : second.mesh.positions) p *= 2.0F;
  Scene scene;
  scene.instances = {instance_of(box_model())};
  scene.instances[0].motion = frames_of({box_model(), second});
  TriangleList list;
  update_triangles(scene, 0.0, list);
  EXPECT_EQ(update_triangles(scene, 0.1, list), TriangleChange::moved);
  EXPECT_EQ(list.bounds().max, glm::vec3(1.0F));
}

TEST(Triangles, DeformersKeepTheTopology) {
  for (const Deformer::Kind kind :
       {Deformer::Kind::wave, Deformer::Kind::twist, Deformer::Kind::explode}) {
    Scene scene;
    scene.instances = {instance_of(sphere_model(16, 8))};
    Deformer deformer;
    deformer.kind = kind;
    scene.instances[0].motion = deformer;
    TriangleList list;
    update_triangles(scene, 0.0, list);
    const std::size_t count = list.triangles.size();
    for (int i = 1; i < 8; ++i) {
      EXPECT_EQ(update_triangles(scene, 0.23 * i, list), TriangleChange::moved);
      EXPECT_EQ(list.triangles.size(), count);
    }
    EXPECT_EQ(list.topology_version, 1U);
  }
}

TEST(Triangles, ThePlacementComesLast) {
  Transform turned;
  turned.rotation_axis = {0.0F, 0.0F, 1.0F};
  turned.rotation_degrees = 90.0F;
  for (const bool explode : {false, true}) {
    Scene scene;
    scene.instances = {instance_of(square_model())};
    scene.instances[0].placement = turned.matrix();
    if (explode) {
      Deformer deformer;
      deformer.kind = Deformer::Kind::explode;
      deformer.frequency_hz = 0.0F;
      scene.instances[0].motion = deformer;
    } else {
      RigidMotion motion;
      Transform away;
      away.translation = {5.0F, 0.0F, 0.0F};
      motion.keys = {{0.0F, away}};
      scene.instances[0].motion = motion;
    }
    // Moved by 5 along x first, so turned onto y.
    const glm::vec3 centre(0.0F, explode ? 0.0F : 5.0F, 0.0F);
    EXPECT_TRUE(near(triangles_at(scene).bounds().center(), centre));
  }
}

TEST(Triangles, NonFiniteTrianglesAreLeftOutAndCounted) {
  Model model = box_model();
  model.mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  Scene scene;
  scene.instances = {instance_of(std::move(model)), instance_of(square_model())};
  const TriangleList list = triangles_at(scene);
  std::uint64_t with_zero = 0;
  for (const glm::uvec3& t : scene.instances[0].model->mesh.triangles) {
    if (t.x == 0 || t.y == 0 || t.z == 0) ++with_zero;
  }
  EXPECT_EQ(list.dropped_non_finite, with_zero);
  EXPECT_EQ(list.triangles.size(), 14U - with_zero);
}

TEST(Triangles, WhatBecomesInfiniteOnTheWayChangesTheTopology) {
  Scene scene = three_parts();
  RigidMotion growing;
  Transform end;
  end.scale = glm::vec3(3e38F);
  end.translation = glm::vec3(3e38F);
  growing.keys = {{0.0F, {}}, {1.0F, end}, {2.0F, end}};
  scene.instances[1].motion = growing;
  TriangleList list;
  update_triangles(scene, 0.0, list);
  const std::size_t count = list.triangles.size();
  EXPECT_EQ(update_triangles(scene, 1.0, list), TriangleChange::topology);
  EXPECT_EQ(list.triangles.size(), count - 2);
  EXPECT_EQ(list.dropped_non_finite, 2U);
  EXPECT_EQ(update_triangles(scene, 1.5, list), TriangleChange::none);
  EXPECT_EQ(list.dropped_non_finite, 2U);
  EXPECT_EQ(update_triangles(scene, 0.0, list), TriangleChange::topology);
  EXPECT_EQ(list.dropped_non_finite, 0U);
}

TEST(Triangles, AttributesExistOnlyIfSomeMeshHasThem) {
  Scene scene;
  scene.instances = {instance_of(box_model())};
  TriangleList list = triangles_at(scene);
  EXPECT_TRUE(list.normals.empty());
  EXPECT_TRUE(list.colors.empty());

  Model colored = square_model();
  colored.mesh.colors.assign(4, glm::vec3(0.25F));
  scene.instances.push_back(instance_of(std::move(colored)));
  scene.instances.push_back(instance_of(sphere_model(4, 2)));
  scene.mark_changed();
  update_triangles(scene, 0.0, list);
  ASSERT_EQ(list.normals.size(), list.triangles.size());
  ASSERT_EQ(list.colors.size(), list.triangles.size());
  EXPECT_EQ(list.normals[0][1], glm::vec3(0.0F));  // without normals: zeros
  EXPECT_EQ(list.colors[0][2], glm::vec3(1.0F));   // without colours: ones
  EXPECT_EQ(list.colors[12][0], glm::vec3(0.25F));
  EXPECT_EQ(list.normals[14][0], list.triangles[14].v0);  // a unit sphere's normals

  scene.instances.resize(1);
  scene.mark_changed();
  update_triangles(scene, 0.0, list);
  EXPECT_EQ(list.normals.capacity() + list.colors.capacity(), 0U);
}

TEST(Triangles, NormalsFollowTheInverseTranspose) {
  Scene scene;
  scene.instances = {instance_of(sphere_model(12, 8))};
  Transform squashed;
  squashed.scale = {1.0F, 0.25F, 3.0F};
  squashed.rotation_axis = {1.0F, 2.0F, 0.5F};
  squashed.rotation_degrees = 40.0F;
  scene.instances[0].transform = squashed.matrix();
  const TriangleList list = triangles_at(scene);
  const Mesh& mesh = scene.instances[0].model->mesh;
  for (std::size_t i = 0; i < list.triangles.size(); ++i) {
    // Tangents of the sphere at the vertex, taken along by the matrix, stay perpendicular.
    const glm::vec3 p = mesh.positions[mesh.triangles[i].x];
    const glm::vec3 tangent =
        std::abs(p.y) < 0.9F ? glm::vec3(p.z, 0.0F, -p.x) : glm::vec3(p.y, -p.x, 0.0F);
    const PointTransform move(scene.instances[0].transform);
    const glm::vec3 along = move(tangent) - move(glm::vec3(0.0F));
    const glm::vec3 n = list.normals[i][0];
    EXPECT_NEAR(along.x * n.x + along.y * n.y + along.z * n.z, 0.0, 1e-5);
  }
}

TEST(Triangles, AMirroredMeshKeepsItsNormalsOutside) {
  Scene scene;
  scene.instances = {instance_of(sphere_model(12, 8))};
  scene.instances[0].transform[0].x = -1.0F;
  const TriangleList list = triangles_at(scene);
  for (std::size_t i = 0; i < list.triangles.size(); ++i) {
    const glm::vec3 p = list.triangles[i].v0;
    const glm::vec3 n = list.normals[i][0];
    EXPECT_GT(p.x * n.x + p.y * n.y + p.z * n.z, 0.0F);
  }
}

TEST(Triangles, AFarAwayModelKeepsItsShape) {
  // A square of side 1 at a distance of 1e6, where floats are 1/16 apart, brought back to the
  // middle.
  Model model = square_model();
  for (glm::vec3& p : model.mesh.positions) p += glm::vec3(1e6F, -1e6F, 1e6F);
  const Scene scene = place_model(std::move(model));
  const Bounds b = triangles_at(scene).bounds();
  EXPECT_TRUE(near(b.size(), {27.0F, 27.0F, 0.0F}, 1e-4F));
}

}  // namespace
}  // namespace encore::scene::test
