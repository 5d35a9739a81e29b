// Rays side by side that are not of the plain kind: directions of any length, rays that leave a
// surface, rays that there is nothing to ask of. Bit for bit what each finds alone.
#include "tiles.h"

namespace encore::accel::test {
namespace {

/// A scene of each kind of trouble, less than all there are: each tile goes through every mode and
/// instruction set.
std::vector<Case> some_cases() {
  std::vector<Case> cases;
  for (const Case& c : hard_cases()) {
    for (const char* const name : {"soup", "closed ball", "needles", "without area", "coplanar",
                                   "as large as can be", "below the normal range"}) {
      if (c.name == name) cases.push_back(c);
    }
  }
  return cases;
}

/// The ray with a direction `length` times as long, and ends as many times nearer.
Ray of_length(const Ray& ray, float length) {
  Ray result = ray;
  result.direction = ray.direction * length;
  result.t_min = ray.t_min / length;
  result.t_max = ray.t_max / length;
  return result;
}

Tile of_lengths(const Tile& tile, const std::string& name,
                const std::function<float(std::size_t)>& length) {
  Tile result{tile.name + ", " + name, tile.width, tile.rays};
  for (std::size_t i = 0; i < result.rays.size(); ++i) {
    result.rays[i] = of_length(result.rays[i], length(i));
  }
  return result;
}

Tile camera_tile(const Look& look) {
  const glm::vec3 eye = look.middle + look.size * glm::vec3(-1.5F, 1.2F, 2.5F);
  return make_tile("camera", 16, 16, [&](float x, float y) {
    return through(eye, look.middle + look.half * glm::vec3(x - 0.5F, 0.5F - y, 0.2F * x));
  });
}

/// From a place on a triangle, lifted off by about so much of the scene's size, towards a light.
Tile shadow_tile(const std::vector<Triangle>& triangles, const Look& look, float lift) {
  const glm::vec3 light = look.middle + look.size * glm::vec3(0.7F, 1.9F, 1.3F);
  return make_tile("shadows", 16, 24, [&](float x, float y) {
    const Triangle& t = triangles[static_cast<std::size_t>(y * 2.99F) * 7 % triangles.size()];
    const float u = 0.9F * x, v = (1.0F - u) * (3.0F * y - std::floor(3.0F * y));
    const glm::vec3 on = t.v0 + u * (t.v1 - t.v0) + v * (t.v2 - t.v0);
    Ray ray;
    ray.origin = on + lift * (light - on);
    ray.direction = light - ray.origin;
    ray.t_max = 1.0F;
    return ray;
  });
}

class UnevenTile : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    const Case c = some_cases().at(GetParam());
    name_ = c.name;
    triangles_ = c.triangles;
    look_ = look_at(triangles_);
    wide_.build(triangles_);
  }
  void expect_same(const Tile& tile) { test::expect_same(wide_, name_, tile); }

  std::string name_;
  std::vector<Triangle> triangles_;
  Look look_;
  WideBvh wide_{{}, MemoryMode::pool};
};

TEST_P(UnevenTile, OfDirectionsOfAnyLength) {
  const Tile tile = camera_tile(look_);
  for (const float length : {1e-30F, 1e-18F, 3e-4F, 11.0F, 1e9F, 1e18F, 1e30F}) {
    expect_same(
        of_lengths(tile, "length " + std::to_string(length), [&](std::size_t) { return length; }));
  }
  expect_same(of_lengths(tile, "lengths 1 to 7",
                         [](std::size_t i) { return 1.0F + static_cast<float>(i % 7); }));
  expect_same(of_lengths(tile, "lengths of all sizes", [](std::size_t i) {
    return std::ldexp(1.0F + 0.01F * static_cast<float>(i % 13),
                      static_cast<int>(i * 37 % 141) - 70);
  }));
}

TEST_P(UnevenTile, OfRaysThatLeaveASurface) {
  for (const float lift : {0.0F, 0x1p-24F, 0x1p-16F, -0x1p-16F, 0x1p-6F}) {
    const Tile tile = shadow_tile(triangles_, look_, lift);
    expect_same(tile);
    if (lift == 0x1p-16F) {
      for (const float length : {1e-15F, 1e-3F, 1e15F}) {
        expect_same(of_lengths(tile, "other length", [&](std::size_t) { return length; }));
      }
      Tile before = tile;
      before.name = "shadows, from before the origin";
      for (std::size_t i = 0; i < before.rays.size(); i += 3) before.rays[i].t_min = -0.5F;
      expect_same(before);
    }
  }
}

TEST_P(UnevenTile, WithRaysThatEndBeforeTheyBegin) {
  Ray none;
  none.direction = {0.0F, 0.0F, -1.0F};
  none.t_max = -1.0F;
  for (const bool shadows : {false, true}) {
    const Tile whole = shadows ? shadow_tile(triangles_, look_, 0x1p-16F) : camera_tile(look_);
    Tile tile = whole;
    tile.name += ", some without a ray";
    for (std::size_t i = 0; i < tile.rays.size(); ++i) {
      if (i * 7 % 5 < 2 || i % tile.width < 8) tile.rays[i] = none;
    }
    expect_same(tile);
    tile.name += ", or with one of no length";
    for (std::size_t i = 0; i < tile.rays.size(); i += 11) tile.rays[i].t_min = tile.rays[i].t_max;
    expect_same(tile);
  }
}

INSTANTIATE_TEST_SUITE_P(Hard, UnevenTile, testing::Range(std::size_t{0}, some_cases().size()),
                         [](const testing::TestParamInfo<std::size_t>& test) {
                           std::string name = some_cases().at(test.param).name;
                           for (char& c : name) {
                             if (c == ' ') c = '_';
                           }
                           return name;
                         });

/// A tilted square of `side` x `side` squares, two triangles each.
std::vector<Triangle> tilted_squares(int side, float scale) {
  const glm::vec3 u{0.9F, 0.1F, -0.3F}, v{-0.2F, 0.8F, 0.4F};
  const auto corner = [&](int x, int y) {
    const float a = 2.0F * static_cast<float>(x) / static_cast<float>(side) - 1.0F;
    const float b = 2.0F * static_cast<float>(y) / static_cast<float>(side) - 1.0F;
    return scale * (a * u + b * v);
  };
  std::vector<Triangle> squares;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::vec3 a = corner(x, y), b = corner(x + 1, y + 1);
      squares.push_back(scene::make_triangle(a, corner(x + 1, y), b));
      squares.push_back(scene::make_triangle(a, b, corner(x, y + 1)));
    }
  }
  return squares;
}

/// Whole groups of rays that meet large triangles right at their edges and corners: what is thrown
/// out for a group must be what each of its rays misses.
TEST(TileRays, AimedAtEdgesOfLargeTrianglesFromOnePoint) {
  for (const float scale : {1.0F, 0x1p-60F, 0x1p40F}) {
    for (const int side : {1, 2, 4, 8, 16}) {
      WideBvh wide({}, MemoryMode::pool);
      const std::vector<Triangle> squares = tilted_squares(side, scale);
      wide.build(squares);
      for (const glm::vec3& eye : {glm::vec3{0.3F, -0.2F, 2.0F}, glm::vec3{2.5F, 1.5F, 0.4F}}) {
        const glm::vec3 u{0.9F, 0.1F, -0.3F}, v{-0.2F, 0.8F, 0.4F};
        const Tile tile = make_tile("edges", 33, 33, [&](float x, float y) {
          const float a = std::round(33.0F * x - 0.5F) / 16.0F - 1.0F;
          const float b = std::round(33.0F * y - 0.5F) / 16.0F - 1.0F;
          return through(scale * eye, scale * (a * u + b * v));
        });
        const std::string name = std::to_string(side) + " squares a side";
        expect_same(wide, name, tile);
        for (const float length : {0x1p-50F, 0x1p50F}) {
          expect_same(wide, name,
                      of_lengths(tile, "other length", [&](std::size_t) { return length; }));
        }
      }
    }
  }
}

/// Any-hit takes a triangle right before the origin for certain where its distance is not, and a
/// nearest hit does not: both have to agree about which side it is on.
TEST(TileRays, SeeTheSideOfWhatIsRightBeforeThem) {
  std::vector<Triangle> floor;
  for (int i = 0; i < 64; ++i) {
    const auto x = static_cast<float>(i % 8), y = static_cast<float>(i / 8);
    floor.push_back(scene::make_triangle({x, y, 0.0F}, {x + 1, y, 0.0F}, {x, y + 1, 0.0F}));
    floor.push_back(scene::make_triangle({x + 1, y + 1, 0.0F}, {x, y + 1, 0.0F}, {x + 1, y, 0.0F}));
  }
  WideBvh wide({}, MemoryMode::pool);
  wide.build(floor);
  for (const float height : {0x1p-60F, 0x1p-30F, 0x1p-23F, 0x1p-20F, 0x1p-14F}) {
    for (const float side : {1.0F, -1.0F}) {
      const Tile tile = make_tile("floor", 32, 32, [&](float x, float y) {
        Ray ray;
        ray.origin = {1.0F + 6.0F * x, 1.0F + 6.0F * y, side * height};
        ray.direction = glm::vec3(0.1F, -0.3F, -5.0F) - 0.1F * ray.origin;
        return ray;
      });
      expect_same(wide, "floor", tile);
      for (const Isa isa : available_isas()) {
        wide.set_isa(isa);
        wide.set_intersection(IntersectionMode::watertight);
        std::vector<std::uint8_t> blocked(tile.rays.size());
        wide.occluded_tile(tile.rays, tile.width, blocked);
        const auto count = std::count(blocked.begin(), blocked.end(), std::uint8_t{1});
        EXPECT_EQ(static_cast<std::size_t>(count), side > 0.0F ? blocked.size() : 0U);
      }
    }
  }
}

}  // namespace
}  // namespace encore::accel::test
