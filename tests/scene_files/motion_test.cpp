#include "scene/motion.h"

#include "scene/basic_shapes.h"
#include "scene/deform.h"
#include "scene/placement.h"
#include "scene/rotation.h"
#include "support.h"

#include <cmath>
#include <limits>

namespace encore::scene::test {
namespace {

glm::vec3 moved(const glm::mat4& m, const glm::vec3& p) {
  return PointTransform(m)(p);
}

Transform turn(float degrees, const glm::vec3& axis = {0.0F, 0.0F, 1.0F}) {
  Transform t;
  t.rotation_degrees = degrees;
  t.rotation_axis = axis;
  return t;
}

TEST(Transform, ScalesThenRotatesThenMoves) {
  Transform t = turn(90.0F);
  t.scale = {2.0F, 3.0F, 4.0F};
  t.translation = {10.0F, 20.0F, 30.0F};
  // x is doubled, turned onto y and moved; right angles are exact.
  EXPECT_EQ(moved(t.matrix(), {1.0F, 0.0F, 0.0F}), glm::vec3(10.0F, 22.0F, 30.0F));
  EXPECT_EQ(moved(t.matrix(), {0.0F, 1.0F, 1.0F}), glm::vec3(7.0F, 20.0F, 34.0F));
}

TEST(Transform, TheLengthOfTheAxisDoesNotMatter) {
  EXPECT_EQ(turn(37.0F, {0.0F, 1e-30F, 0.0F}).matrix(), turn(37.0F, {0.0F, 1e30F, 0.0F}).matrix());
  EXPECT_EQ(turn(37.0F, {0.0F, 0.0F, 0.0F}).matrix(), glm::mat4(1.0F));
}

TEST(RigidMotion, HasExactlyTheKeysPoseAtItsTime) {
  RigidMotion motion;
  motion.keys = {{1.0F, turn(0.0F)}, {2.5F, turn(33.0F)}, {4.0F, turn(190.0F, {1.0F, 1.0F, 0.0F})}};
  for (const Keyframe& key : motion.keys) {
    EXPECT_EQ(pose_at(motion, key.time_s), key.pose.matrix());
  }
  // Before the first and after the last the pose is held.
  EXPECT_EQ(pose_at(motion, 0.0), motion.keys.front().pose.matrix());
  EXPECT_EQ(pose_at(motion, 100.0), motion.keys.back().pose.matrix());
}

TEST(RigidMotion, InterpolatesTranslationAndScaleLinearly) {
  RigidMotion motion;
  Transform end;
  end.translation = {8.0F, 0.0F, -4.0F};
  end.scale = {3.0F, 1.0F, 1.0F};
  motion.keys = {{0.0F, {}}, {2.0F, end}};
  EXPECT_TRUE(near(moved(pose_at(motion, 0.5), {1.0F, 1.0F, 1.0F}), {3.5F, 1.0F, 0.0F}));
}

TEST(RigidMotion, TurnsFullCirclesAroundOneAxis) {
  RigidMotion motion;
  motion.keys = {{0.0F, {}}, {4.0F, turn(720.0F)}};
  EXPECT_TRUE(near(moved(pose_at(motion, 0.5), {1.0F, 0.0F, 0.0F}), {0.0F, 1.0F, 0.0F}));
  EXPECT_TRUE(near(moved(pose_at(motion, 1.0), {1.0F, 0.0F, 0.0F}), {-1.0F, 0.0F, 0.0F}));
}

TEST(RigidMotion, TakesTheShorterArcBetweenDifferentAxes) {
  // From 90 degrees around x to 90 around y is a rotation by 120 degrees; halfway lies 60 from
  // both.
  const Rotation a = rotation_around({1.0F, 0.0F, 0.0F}, 90.0);
  const Rotation b = rotation_around({0.0F, 1.0F, 0.0F}, 90.0);
  const Rotation minus_b{-b.w, -b.x, -b.y, -b.z};
  const auto angle = [](const Rotation& p, const Rotation& q) {
    const double dot = std::fabs(p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z);
    return 2.0 * std::acos(dot) * 180.0 / 3.14159265358979;
  };
  for (const Rotation& end : {b, minus_b}) {
    const Rotation half = slerp(a, end, 0.5);
    EXPECT_NEAR(angle(a, half), 30.0 * 2.0, 1e-6);
    EXPECT_NEAR(angle(half, b), 30.0 * 2.0, 1e-6);
  }
  // Equal rotations do not divide by zero.
  const Rotation same = slerp(a, a, 0.3);
  EXPECT_NEAR(same.w, a.w, 1e-15);
}

TEST(WrappedTime, LoopsBothWaysAndSurvivesNonsense) {
  EXPECT_EQ(wrapped_time(7.5, 3.0), 1.5);
  EXPECT_EQ(wrapped_time(3.0, 3.0), 0.0);
  EXPECT_EQ(wrapped_time(-0.5, 3.0), 2.5);
  EXPECT_EQ(wrapped_time(5.0, 0.0), 0.0);
  EXPECT_EQ(wrapped_time(std::numeric_limits<double>::quiet_NaN(), 3.0), 0.0);
  EXPECT_EQ(wrapped_time(std::numeric_limits<double>::infinity(), 3.0), 0.0);
}

TEST(MotionDuration, IsZeroForWhatNeverMoves) {
  EXPECT_EQ(motion_duration_s(RigidMotion{{{1.0F, {}}}}), 0.0);
  EXPECT_EQ(motion_duration_s(RigidMotion{{{0.0F, {}}, {2.0F, {}}}}), 2.0);
  Deformer deformer;
  EXPECT_EQ(motion_duration_s(deformer), 2.0);
  deformer.amplitude = 0.0F;
  EXPECT_EQ(motion_duration_s(deformer), 0.0);
  FrameSequence sequence;
  EXPECT_EQ(motion_duration_s(sequence), 0.0);
  sequence.frames.resize(5);
  EXPECT_EQ(motion_duration_s(sequence), 0.5);
}

TEST(FrameSequence, ShowsEveryFrameOnceALoop) {
  FrameSequence sequence;
  sequence.frames.resize(7);
  sequence.frames_per_second = 30.0F;
  for (std::size_t i = 0; i < 21; ++i) {
    EXPECT_EQ(frame_at(sequence, static_cast<double>(i) / 30.0), i % 7);
  }
}

TEST(Deformer, WaveMovesAlongItsAxisOnly) {
  Deformer wave;
  wave.amplitude = 2.0F;
  wave.wavelength = 4.0F;
  std::vector<glm::vec3> positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 5.0F, 2.0F}, {4.0F, 0.0F, 0.0F}};
  std::vector<glm::vec3> none;
  deform(wave, 0.25, glm::vec3(0.0F), positions, none);
  EXPECT_TRUE(near(positions[0], {0.0F, 2.0F, 0.0F}));  // a quarter of a period: the crest
  EXPECT_TRUE(near(positions[1], {1.0F, 5.0F, 2.0F}));  // a quarter of a wavelength behind: zero
  EXPECT_TRUE(near(positions[2], {4.0F, 2.0F, 0.0F}));  // a whole wavelength: the crest again
}

TEST(Deformer, TwistTurnsByHeight) {
  Deformer twist;
  twist.kind = Deformer::Kind::twist;
  twist.amplitude = 1.5707964F;
  twist.wavelength = 2.0F;
  std::vector<glm::vec3> positions = {{1.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 0.0F}};
  std::vector<glm::vec3> none;
  deform(twist, 0.25, glm::vec3(0.0F), positions, none);
  EXPECT_TRUE(near(positions[0], {1.0F, 0.0F, 0.0F}));
  EXPECT_TRUE(near(positions[1], {0.0F, 2.0F, -1.0F}));  // a quarter turn around y takes x to -z
}

TEST(Deformer, NormalsStayPerpendicularToTheSurface) {
  for (const Deformer::Kind kind : {Deformer::Kind::wave, Deformer::Kind::twist}) {
    Deformer deformer;
    deformer.kind = kind;
    deformer.axis = {0.3F, 1.0F, -0.2F};
    deformer.amplitude = 0.8F;
    deformer.wavelength = 3.0F;
    // A point, two tiny steps in its plane, and that plane's normal.
    const float h = 1e-3F;
    const glm::vec3 p(0.7F, -0.4F, 0.9F);
    std::vector<glm::vec3> positions = {p, p + glm::vec3(h, 0.0F, 0.0F), p + glm::vec3(0.0F, h, h)};
    std::vector<glm::vec3> normals(3, glm::vec3(0.0F, -1.0F, 1.0F));
    deform(deformer, 0.15, glm::vec3(0.0F), positions, normals);
    const glm::vec3 n = normals[0];
    const double length = std::sqrt(double(n.x) * n.x + double(n.y) * n.y + double(n.z) * n.z);
    for (int i = 1; i < 3; ++i) {
      const glm::vec3 step = (positions[i] - positions[0]) / h;
      EXPECT_NEAR((step.x * n.x + step.y * n.y + step.z * n.z) / length, 0.0, 5e-3);
    }
  }
}

TEST(Deformer, ExplosionStartsAtRestAndGrows) {
  Deformer explode;
  explode.kind = Deformer::Kind::explode;
  explode.amplitude = 10.0F;
  const glm::vec3 centroid(3.0F, 0.0F, 0.0F);
  EXPECT_EQ(explode_offset(explode, 0.0, glm::vec3(0.0F), centroid, 5), glm::vec3(0.0F));
  const glm::vec3 half = explode_offset(explode, 0.5, glm::vec3(0.0F), centroid, 5);
  EXPECT_GE(half.x, 2.5F);
  EXPECT_LT(half.x, 7.5F);
  EXPECT_EQ(explode_offset(explode, 0.5, centroid, centroid, 5), glm::vec3(0.0F));
  // Triangles fly at different speeds.
  EXPECT_NE(half, explode_offset(explode, 0.5, glm::vec3(0.0F), centroid, 6));
}

}  // namespace
}  // namespace encore::scene::test
