// Rays that go through bvh-sah side by side find what they find alone, bit for bit: every
// intersection mode and instruction set, rectangles of any shape, coherent or not.
#include "tiles.h"

namespace encore::accel::test {
namespace {

/// Pinhole cameras that look along an axis, obliquely and from within, at a part of the scene.
std::vector<Tile> camera_tiles(const Look& look) {
  std::vector<Tile> tiles;
  const glm::vec3 eyes[] = {{0.0F, 0.0F, 3.0F}, {-2.5F, 1.5F, 0.5F}, {0.01F, -0.02F, 0.0F}};
  const std::size_t shapes[][2] = {{32, 24}, {13, 7}, {1, 70}, {70, 1}, {3, 3}, {9, 65}};
  for (std::size_t i = 0; i < std::size(shapes); ++i) {
    const glm::vec3 from = look.middle + look.size * eyes[i % std::size(eyes)];
    tiles.push_back(make_tile("camera", shapes[i][0], shapes[i][1], [&](float x, float y) {
      const glm::vec3 place{2.0F * x - 1.0F, 1.0F - 2.0F * y, 0.3F * (x - y)};
      return through(from, look.middle + 0.7F * place * look.half);
    }));
  }
  // A part so small that a tile sees few triangles.
  const glm::vec3 from = look.middle + look.size * glm::vec3(0.4F, 0.3F, 4.0F);
  tiles.push_back(make_tile("close camera", 40, 20, [&](float x, float y) {
    return through(from, look.middle + 0.05F * look.half * glm::vec3(x - 0.5F, y - 0.5F, 0.0F));
  }));
  return tiles;
}

std::vector<Tile> other_tiles(const Look& look) {
  std::vector<Tile> tiles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      tiles.push_back(make_tile("parallel to an axis", 24, 16, [&](float x, float y) {
        Ray ray;
        glm::vec3 place{0.0F};
        place[(axis + 1) % 3] = 2.0F * x - 1.0F;
        place[(axis + 2) % 3] = 2.0F * y - 1.0F;
        place[axis] = -sign * 1.5F;
        ray.origin = look.middle + look.half * place;
        ray.direction = {0.0F, 0.0F, 0.0F};
        ray.direction[axis] = sign;
        return ray;
      }));
    }
  }
  const glm::vec3 light = look.middle + look.size * glm::vec3(0.7F, 2.0F, 1.3F);
  for (const float share : {0.999F, 0.4F}) {
    tiles.push_back(make_tile("towards a light", 21, 17, [&](float x, float y) {
      const glm::vec3 place{2.0F * x - 1.0F, 2.0F * y - 1.0F, std::sin(5.0F * x + y)};
      Ray ray = through(look.middle + 0.8F * look.half * place, light);
      const glm::vec3 way = light - ray.origin;
      const glm::vec3& d = ray.direction;
      const int axis = std::fabs(d.y) > 0.5F ? 1 : std::fabs(d.x) > std::fabs(d.z) ? 0 : 2;
      ray.t_max = share * std::fabs(way[axis] / d[axis]);
      return ray;
    }));
  }
  tiles.push_back(make_tile("limits", 16, 16, [&](float x, float y) {
    Ray ray = through(look.middle + look.size * glm::vec3(0.0F, 0.0F, 3.0F),
                      look.middle + look.half * glm::vec3(x - 0.5F, y - 0.5F, 0.0F));
    ray.t_min = look.size * 2.9F * x;
    ray.t_max = look.size * (2.0F + 2.0F * y);
    return ray;
  }));
  return tiles;
}

class EveryTile : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    const std::vector<Case> cases = hard_cases();
    triangles_ = cases.at(GetParam()).triangles;
    name_ = cases.at(GetParam()).name;
    wide_.build(triangles_);
  }

  void expect_same(const Tile& tile) { test::expect_same(wide_, name_, tile); }

  std::string name_;
  std::vector<Triangle> triangles_;
  WideBvh wide_{{}, MemoryMode::pool};
};

TEST_P(EveryTile, OfACameraGivesTheHitsOfSingleRays) {
  for (const Tile& tile : camera_tiles(look_at(triangles_))) expect_same(tile);
}

TEST_P(EveryTile, OfAnotherKindGivesTheHitsOfSingleRays) {
  for (const Tile& tile : other_tiles(look_at(triangles_))) expect_same(tile);
}

TEST_P(EveryTile, OfRaysThatHaveNothingInCommonGivesTheHitsOfSingleRays) {
  Tile tile{"incoherent", 19, hard_rays(wide_, triangles_, 30, 21)};
  tile.rays.resize(tile.rays.size() / tile.width * tile.width);
  expect_same(tile);
}

TEST_P(EveryTile, TakesEachSettingAtOnce) {
  const Tile tile = camera_tiles(look_at(triangles_)).front();
  std::vector<Hit> packets(tile.rays.size()), single(tile.rays.size());
  wide_.intersect_tile(tile.rays, tile.width, packets);
  wide_.set_grouping(RayGrouping::single);
  wide_.intersect_tile(tile.rays, tile.width, single);
  EXPECT_EQ(std::memcmp(packets.data(), single.data(), packets.size() * sizeof(Hit)), 0);
}

INSTANTIATE_TEST_SUITE_P(Hard, EveryTile, testing::Range(std::size_t{0}, hard_cases().size()),
                         [](const testing::TestParamInfo<std::size_t>& test) {
                           std::string name = hard_cases().at(test.param).name;
                           for (char& c : name) {
                             if (c == ' ') c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace encore::accel::test
