// Moving cameras by hand: properties that hold for cameras of every size, drawn with fixed seeds.
#include "scene/camera_motion.h"

#include "scene/camera_basis.h"
#include "scene/triangle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace encore::scene {
namespace {

constexpr std::array<Axis, 3> kAxes{Axis::x, Axis::y, Axis::z};
constexpr std::array<ViewAxis, 6> kViewAxes{ViewAxis::plus_x, ViewAxis::minus_x,
                                            ViewAxis::plus_y, ViewAxis::minus_y,
                                            ViewAxis::plus_z, ViewAxis::minus_z};

glm::dvec3 unit(Axis axis) {
  glm::dvec3 v(0.0);
  v[static_cast<int>(axis)] = 1.0;
  return v;
}

double distance_of(const Camera& camera) {
  return glm::length(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() - std::mt19937::min()) /
                                 static_cast<double>(std::mt19937::max()));
  }
  glm::vec3 vector() {
    return {static_cast<float>(between(-1, 1)), static_cast<float>(between(-1, 1)),
            static_cast<float>(between(-1, 1))};
  }
  Axis axis() { return kAxes[engine_() % 3]; }
  unsigned below(unsigned count) { return static_cast<unsigned>(engine_() % count); }

  /// A camera about `scale` from the origin and from its target; every second one orthographic.
  Camera camera(double scale) {
    Camera made;
    do {
      made.eye = vector() * static_cast<float>(scale);
      made.target = vector() * static_cast<float>(scale);
    } while (distance_of(made) < 0.1 * scale);
    made.up = glm::vec3(unit(axis()));
    made.vertical_fov_degrees = static_cast<float>(between(2.0, 150.0));
    if (below(2) == 0) made.orthographic_height = static_cast<float>(scale * between(0.1, 3.0));
    return made;
  }

 private:
  std::mt19937 engine_;
};

/// Calls `check(camera, scale, random)` for cameras from 1e-15 to 1e15.
template <typename Check>
void for_cameras(unsigned seed, const Check& check) {
  Random random(seed);
  for (int exponent = -15; exponent <= 15; exponent += 3) {
    for (int i = 0; i < 40; ++i) {
      const double scale = std::pow(10.0, exponent);
      check(random.camera(scale), scale, random);
      if (testing::Test::HasFailure()) return;
    }
  }
}

bool usable(const Camera& camera) {
  return is_finite(camera.eye) && is_finite(camera.target) && is_finite(camera.up) &&
         camera.eye != camera.target && std::isfinite(camera.orthographic_height) &&
         camera.orthographic_height >= 0.0F && std::isfinite(camera_basis(camera).right.x) &&
         camera.vertical_fov_degrees > 0.0F && camera.vertical_fov_degrees < 180.0F;
}

/// Where a point falls in the picture, in fractions from its top left.
glm::dvec2 seen_at(const Camera& camera, const glm::dvec3& point, double aspect) {
  const CameraBasis basis = camera_basis(camera);
  const glm::dvec3 from = point - glm::dvec3(camera.eye);
  const double height = camera.orthographic()
                            ? double{camera.orthographic_height}
                            : 2.0 * half_height_at_one(camera) * glm::dot(from, basis.forward);
  return {0.5 + glm::dot(from, basis.right) / (height * aspect),
          0.5 - glm::dot(from, basis.up) / height};
}

/// The point at the target's depth that is seen at a place of the picture.
glm::dvec3 point_at(const Camera& camera, double x, double y, double aspect) {
  const CameraBasis basis = camera_basis(camera);
  const double height = picture_height_at_target(camera);
  return glm::dvec3(camera.target) + (x - 0.5) * height * aspect * basis.right +
         (0.5 - y) * height * basis.up;
}

void expect_same_place(const glm::dvec2& found, const glm::dvec2& expected, double tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
}

TEST(CameraMotion, OrbitingKeepsTargetAndDistanceAndNeverFlips) {
  for_cameras(1, [](Camera camera, double scale, Random& random) {
    const double distance = distance_of(camera);
    const glm::vec3 target = camera.target;
    const Axis axis = random.axis();
    for (int step = 0; step < 30; ++step) {
      camera = orbit(camera, random.between(-3, 3), random.between(-3, 3), axis);
      ASSERT_TRUE(usable(camera)) << scale;
      ASSERT_EQ(camera.target, target);
      ASSERT_NEAR(distance_of(camera), distance, 1e-5 * distance);
      // The axis points up in the picture: it is not upside down.
      ASSERT_GT(glm::dot(camera_basis(camera).up, unit(axis)), 0.001);
    }
  });
}

TEST(CameraMotion, OrbitingPastThePoleStopsThere) {
  for (const double way : {1.0, -1.0}) {
    Camera camera;
    for (int i = 0; i < 100; ++i) camera = orbit(camera, 0.0, 0.1 * way, Axis::y);
    EXPECT_NEAR(camera.eye.y, 25.0 * way, 0.01);
    EXPECT_GT(camera.eye.z, 0.0F);
    const Camera there = orbit(camera, 0.0, 5.0 * way, Axis::y);
    EXPECT_NEAR(glm::distance(there.eye, camera.eye), 0.0, 1e-4);
  }
}

TEST(CameraMotion, OrbitTurnsByTheAnglesAsked) {
  // Counter-clockwise as seen from above: from +z to +x.
  const Camera turned = orbit({}, std::acos(0.0), 0.0, Axis::y);
  EXPECT_NEAR(turned.eye.x, 25.0, 1e-4);
  EXPECT_NEAR(turned.eye.z, 0.0, 1e-4);
  const Camera lifted = orbit({}, 0.0, std::acos(0.0) / 3.0, Axis::y);
  EXPECT_NEAR(lifted.eye.y, 12.5, 1e-4);
  const Camera full = orbit(orbit({}, 2.0, 0.3, Axis::y), -2.0, -0.3, Axis::y);
  EXPECT_NEAR(glm::distance(full.eye, Camera{}.eye), 0.0, 1e-4);
}

TEST(CameraMotion, OrbitingFromAPoleStartsWithThePictureThatIsSeen) {
  for (const Axis axis : kAxes) {
    for (const ViewAxis view : kViewAxes) {
      const Camera before = view_along_axis({}, view, axis);
      const Camera after = orbit(before, 0.0, 0.0, axis);
      EXPECT_GT(glm::dot(camera_basis(before).right, camera_basis(after).right), 0.99999);
      EXPECT_GT(glm::dot(camera_basis(before).up, camera_basis(after).up), 0.9999);
      const Camera looked = look(before, 0.0, 0.0, axis);
      EXPECT_GT(glm::dot(camera_basis(before).right, camera_basis(looked).right), 0.99999);
    }
  }
}

TEST(CameraMotion, PanningCarriesThePointUnderThePointer) {
  for_cameras(2, [](const Camera& camera, double scale, Random& random) {
    const double aspect = random.between(0.3, 3.0);
    const double x = random.between(0, 1), y = random.between(0, 1);
    const double dx = random.between(-0.5, 0.5), dy = random.between(-0.5, 0.5);
    const glm::dvec3 grabbed = point_at(camera, x, y, aspect);
    const Camera moved = pan(camera, dx, dy, aspect);
    ASSERT_TRUE(usable(moved)) << scale;
    expect_same_place(seen_at(moved, grabbed, aspect), {x + dx, y + dy}, 1e-4);
    EXPECT_NEAR(distance_of(moved), distance_of(camera), 1e-5 * distance_of(camera));
    EXPECT_GT(glm::dot(camera_basis(moved).forward, camera_basis(camera).forward), 1.0 - 1e-9);
  });
}

TEST(CameraMotion, ZoomingKeepsThePointUnderThePointer) {
  for_cameras(3, [](const Camera& camera, double scale, Random& random) {
    const double aspect = random.between(0.3, 3.0);
    const double x = random.between(0, 1), y = random.between(0, 1);
    const double factor = std::exp(random.between(-2, 2));
    const glm::dvec3 kept = point_at(camera, x, y, aspect);
    const Camera zoomed = zoom_at(camera, factor, x, y, aspect);
    ASSERT_TRUE(usable(zoomed)) << scale;
    expect_same_place(seen_at(zoomed, kept, aspect), {x, y}, 2e-4);
    EXPECT_NEAR(picture_height_at_target(zoomed) / picture_height_at_target(camera), factor,
                1e-4 * factor);
    const Camera middle = dolly(camera, factor);
    EXPECT_EQ(middle.target, camera.target);
    if (camera.orthographic()) {
      EXPECT_NEAR(middle.orthographic_height, camera.orthographic_height * factor,
                  1e-6 * camera.orthographic_height * factor);
    } else {
      EXPECT_NEAR(distance_of(middle), distance_of(camera) * factor,
                  1e-4 * distance_of(camera) * factor);
    }
  });
}

TEST(CameraMotion, ZoomingWithoutEndStaysUsableAndCanBeUndone) {
  for_cameras(4, [](const Camera& start, double scale, Random& random) {
    for (const double factor : {0.5, 2.0}) {
      Camera camera = start;
      for (int i = 0; i < 300; ++i) {
        camera = zoom_at(camera, factor, random.between(0, 1), random.between(0, 1), 1.5);
        ASSERT_TRUE(usable(camera)) << scale << ", step " << i;
      }
      const double size = picture_height_at_target(camera);
      for (int i = 0; i < 5; ++i) camera = dolly(camera, 1.0 / factor);
      const double ratio = picture_height_at_target(camera) / size;
      EXPECT_TRUE(factor < 1.0 ? ratio > 20.0 : ratio < 0.05) << ratio;
    }
  });
}

TEST(CameraMotion, FlyingMovesEyeAndTargetAlike) {
  for_cameras(5, [](const Camera& camera, double scale, Random& random) {
    const glm::dvec3 by = glm::dvec3(random.vector()) * scale;
    const CameraBasis basis = camera_basis(camera);
    const Camera flown = fly(camera, by.x, by.y, by.z);
    ASSERT_TRUE(usable(flown));
    const glm::dvec3 way = by.x * basis.forward + by.y * basis.right + by.z * basis.up;
    EXPECT_LT(glm::length(glm::dvec3(flown.eye) - glm::dvec3(camera.eye) - way), 1e-6 * scale);
    EXPECT_LT(glm::length(glm::dvec3(flown.target) - glm::dvec3(camera.target) - way),
              1e-6 * scale);
  });
}

TEST(CameraMotion, LookingAroundKeepsTheEyeAndNeverFlips) {
  for_cameras(6, [](Camera camera, double scale, Random& random) {
    const double distance = distance_of(camera);
    const glm::vec3 eye = camera.eye;
    const Axis axis = random.axis();
    for (int step = 0; step < 20; ++step) {
      camera = look(camera, random.between(-3, 3), random.between(-3, 3), axis);
      ASSERT_TRUE(usable(camera)) << scale;
      ASSERT_EQ(camera.eye, eye);
      ASSERT_NEAR(distance_of(camera), distance, 1e-5 * distance);
      ASSERT_GT(glm::dot(camera_basis(camera).up, unit(axis)), 0.001);
    }
  });
  // To the left: from -z towards -x.
  EXPECT_LT(look({}, 0.5, 0.0, Axis::y).target.x, -1.0F);
  EXPECT_GT(look({}, 0.0, 0.5, Axis::y).target.y, 1.0F);
}

TEST(CameraMotion, FocusShowsTheWholeBoxAndFillsThePicture) {
  for_cameras(7, [](const Camera& camera, double scale, Random& random) {
    // From the camera's own size to a hundred thousandth of it; flat ones, and needles.
    const auto size = static_cast<float>(scale * std::pow(10.0, random.between(-5, 1)));
    Bounds box;
    const glm::vec3 corner = random.vector() * static_cast<float>(scale);
    glm::vec3 extent = glm::abs(random.vector()) * size;
    const unsigned kind = random.below(3);
    if (kind >= 1) extent[static_cast<int>(random.below(3))] = 0.0F;
    if (kind == 2) extent[static_cast<int>(random.below(3))] = 0.0F;
    box.extend(corner);
    box.extend(corner + extent);
    const double aspect = random.between(0.2, 5.0);
    const Camera framed = focus(camera, box, aspect);
    ASSERT_TRUE(usable(framed)) << scale;
    EXPECT_GT(glm::dot(camera_basis(framed).forward, camera_basis(camera).forward), 1.0 - 1e-5);
    EXPECT_EQ(framed.vertical_fov_degrees, camera.vertical_fov_degrees);
    double reach = 0.0;
    for (unsigned i = 0; i < 8; ++i) {
      const glm::dvec3 point((i & 1U) != 0 ? box.min.x : box.max.x,
                             (i & 2U) != 0 ? box.min.y : box.max.y,
                             (i & 4U) != 0 ? box.min.z : box.max.z);
      ASSERT_GT(glm::dot(point - glm::dvec3(framed.eye), camera_basis(framed).forward), 0.0);
      const glm::dvec2 seen = seen_at(framed, point, aspect) - glm::dvec2(0.5);
      reach = std::max({reach, std::abs(seen.x), std::abs(seen.y)});
    }
    EXPECT_LE(reach, 0.5);
    // Thick boxes reach far enough, where they need not be kept apart from the eye.
    const bool roomy = camera.orthographic() || camera.vertical_fov_degrees < 60.0F;
    if (kind == 0 && roomy && size > 0.01 * scale) {
      const double thinnest = std::min({extent.x, extent.y, extent.z});
      if (thinnest > 0.3 * static_cast<double>(glm::length(extent))) {
        EXPECT_GT(reach, 0.4);
      }
    }
  });
}

TEST(CameraMotion, FocusOnPointsNothingAndHugeBoxes) {
  const Camera camera;
  EXPECT_EQ(focus(camera, {}, 1.0), camera);
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(focus(camera, {glm::vec3(-inf), glm::vec3(inf)}, 1.0), camera);
  const Camera point = focus(camera, {glm::vec3(3.0F), glm::vec3(3.0F)}, 1.0);
  EXPECT_EQ(point.target, glm::vec3(3.0F));
  EXPECT_EQ(distance_of(point), 25.0);
  for (const float size : {1e-40F, 1e20F, 1e30F, 1e36F, 3e38F}) {
    for (const float height : {0.0F, 2.0F}) {
      const Camera huge =
          focus({.orthographic_height = height}, {glm::vec3(-size), glm::vec3(size)}, 2.0);
      EXPECT_TRUE(usable(huge)) << size;
    }
  }
}

TEST(CameraMotion, ViewsAlongAxesLookThatWayWithTheAxisUp) {
  for_cameras(8, [](const Camera& camera, double scale, Random&) {
    for (const Axis up : kAxes) {
      for (const ViewAxis view : kViewAxes) {
        const Camera turned = view_along_axis(camera, view, up);
        ASSERT_TRUE(usable(turned)) << scale;
        const int place = static_cast<int>(view);
        const CameraBasis basis = camera_basis(turned);
        EXPECT_GT(basis.forward[place / 2] * (place % 2 == 0 ? 1.0 : -1.0), 1.0 - 1e-9);
        EXPECT_EQ(turned.target, camera.target);
        EXPECT_NEAR(distance_of(turned), distance_of(camera), 1e-5 * distance_of(camera));
        if (place / 2 != static_cast<int>(up)) {
          EXPECT_GT(glm::dot(basis.up, unit(up)), 0.999);
        }
      }
    }
  });
  // Top views, as maps are drawn.
  EXPECT_GT(camera_basis(view_along_axis({}, ViewAxis::minus_y, Axis::y)).up.z, -1.01);
  EXPECT_LT(camera_basis(view_along_axis({}, ViewAxis::minus_y, Axis::y)).up.z, -0.99);
  EXPECT_GT(camera_basis(view_along_axis({}, ViewAxis::minus_z, Axis::z)).up.y, 0.99);
}

TEST(CameraMotion, TogglingTheProjectionKeepsSizesAtTheTarget) {
  for_cameras(9, [](const Camera& camera, double scale, Random&) {
    const Camera other = toggle_projection(camera);
    ASSERT_TRUE(usable(other)) << scale;
    EXPECT_NE(other.orthographic(), camera.orthographic());
    EXPECT_EQ(other.target, camera.target);
    const double height = picture_height_at_target(camera);
    EXPECT_NEAR(picture_height_at_target(other), height, 1e-4 * height);
    const Camera back = toggle_projection(other);
    EXPECT_EQ(back.orthographic(), camera.orthographic());
    EXPECT_NEAR(picture_height_at_target(back), height, 2e-4 * height);
    EXPECT_EQ(back.vertical_fov_degrees, camera.vertical_fov_degrees);
  });
}

TEST(CameraMotion, AnySequenceOfAnyAmountsGivesUsableCameras) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> amounts{0.0,   1e-300, 1e-15,  1.0, -1.0, 1e15,
                                    -1e15, 1e300,  -1e300, inf, -inf, nan};
  for_cameras(10, [&](Camera camera, double scale, Random& random) {
    const auto any = [&] { return amounts[random.below(static_cast<unsigned>(amounts.size()))]; };
    for (int step = 0; step < 40; ++step) {
      const unsigned action = random.below(9);
      const Axis axis = random.axis();
      const auto far = static_cast<float>(random.between(-1, 1) * 1e15);
      if (action == 0) camera = orbit(camera, any(), any(), axis);
      if (action == 1) camera = pan(camera, any(), any(), any());
      if (action == 2) camera = zoom_at(camera, any(), any(), any(), any());
      if (action == 3) camera = dolly(camera, any());
      if (action == 4) camera = fly(camera, any(), any(), any());
      if (action == 5) camera = look(camera, any(), any(), axis);
      if (action == 6) camera = toggle_projection(camera);
      if (action == 7) camera = view_along_axis(camera, kViewAxes[random.below(6)], axis);
      if (action == 8) camera = focus(camera, {random.vector() - 1.0F, glm::vec3(far)}, any());
      ASSERT_TRUE(usable(camera)) << scale << ", action " << action;
    }
  });
}

TEST(CameraMotion, AmountsThatAreNoNumbersMoveNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Camera camera;
  EXPECT_EQ(fly(camera, nan, nan, nan), camera);
  EXPECT_EQ(pan(camera, nan, nan, 1.0), camera);
  EXPECT_EQ(dolly(camera, nan), camera);
  EXPECT_EQ(dolly(camera, 0.0), camera);
  EXPECT_EQ(dolly(camera, -2.0), camera);
  EXPECT_EQ(with_up_axis(camera, Axis::z).up, glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace encore::scene
