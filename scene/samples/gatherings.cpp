#include "scene/load_watch.h"
#include "scene/samples/creatures.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/noise.h"
#include "scene/samples/refine.h"
#include "scene/samples/scenes.h"
#include "scene/samples/sculpture.h"
#include "scene/samples/stage.h"
#include "scene/samples/things.h"

namespace encore::scene::samples {

namespace {

glm::mat4 at(const Vec& position, double yaw = 0.0, double scale = 1.0) {
  return matrix_of(Frame{position}.turned(kY, yaw), scale);
}

/// A column of `sides` flat sides with base and capital; 4 (4 sides - 4) triangles.
Mesh column(double height) {
  Mesh mesh;
  const auto drum = [&](double radius, double low, double high, int sides) {
    std::vector<Vec> outline;
    for (int i = 0; i < sides; ++i) {
      const double degrees = 360.0 * i / sides;
      outline.push_back(
          {radius * portable_cos_degrees(degrees), radius * portable_sin_degrees(degrees), 0.0});
    }
    // The prism's axis is z; turned back by 90 degrees it stands.
    const Frame stand = Frame{{0.0, 0.5 * (low + high), 0.0}}.turned({1.0, 0.0, 0.0}, -90.0);
    append(mesh, moved(prism(outline, high - low), stand));
  };
  drum(16.0, 0.0, 8.0, 8);
  drum(11.0, 8.0, height - 14.0, 12);
  drum(13.0, height - 14.0, height - 8.0, 8);
  drum(17.0, height - 8.0, height, 8);
  return flat_shaded(mesh);
}

/// The inside of a room: six faces that look inwards, 12 triangles; 0 floor, 1 walls, 2 ceiling.
Mesh room(const Vec& half, double floor) {
  Mesh box;
  // The eight corners of a plain box, faces turned inwards.
  for (int c = 0; c < 8; ++c) {
    box.positions.push_back(
        narrow({(c & 1) != 0 ? half.x : -half.x, floor + ((c & 2) != 0 ? 2.0 * half.y : 0.0),
                (c & 4) != 0 ? half.z : -half.z}));
  }
  const std::uint32_t quads[6][4] = {{0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2},
                                     {4, 6, 7, 5}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (int face = 0; face < 6; ++face) {
    const auto& q = quads[face];
    box.triangles.emplace_back(q[0], q[1], q[2]);
    box.triangles.emplace_back(q[0], q[2], q[3]);
    const std::uint32_t material = face == 0 ? 0 : (face == 1 ? 2 : 1);
    box.material_of.insert(box.material_of.end(), 2, material);
  }
  return flat_shaded(box);
}

/// A tree: trunk with boughs (material 0) and a crown of leafy clumps (material 1).
Mesh tree(std::uint32_t seed, std::size_t crown_triangles) {
  Dice dice(seed);
  Mesh wood = tube({{{0.0, -1.0, 0.0}, 2.2},
                    {{0.3, 2.5, 0.1}, 1.35},
                    {{-0.3, 9.0, 0.3}, 1.05},
                    {{0.4, 15.0, 0.0}, 0.8},
                    {{0.0, 21.0, 0.0}, 0.3}},
                   14, 40, true);
  Sculpture crown;
  crown.ellipsoid({{0.0, 22.0, 0.0}}, {6.0, 6.5, 6.0}, 1.0);
  for (int i = 0; i < 11; ++i) {
    const double turn = 137.5 * i + dice.roll(-15.0, 15.0);
    const Vec out(portable_cos_degrees(turn), 0.0, portable_sin_degrees(turn));
    const double height = dice.roll(13.5, 24.0);
    const double reach = dice.roll(4.0, 7.2) * (1.25 - 0.02 * height);
    const Vec tip = out * reach + Vec(0.0, height, 0.0);
    append(wood, tube({{{0.0, height - 5.0, 0.0}, 0.5},
                       {mix(Vec(0.0, height - 3.0, 0.0), tip, 0.5), 0.36},
                       {tip, 0.16}},
                      8, 10, true));
    crown.ball(tip, dice.roll(2.6, 4.2), 0.8);
  }
  emboss(wood, [&](const Vec& p, const Vec&) {
    return 0.16 * fractal_noise(Vec(p.x * 1.6, p.y * 0.5, p.z * 1.6), 3, seed + 1);
  });
  smooth_normals(wood);
  const Relief leaves = [seed](const Vec& p, const Vec&) {
    const Cellular c = cellular_noise(p * 1.15, seed + 2);
    return 0.75 * (c.second - c.nearest) + 0.35 * fractal_noise(p * 1.3, 3, seed + 3) - 0.3;
  };
  wood.material_of.assign(wood.triangles.size(), 0);
  append(wood, finished(crown, crown_triangles, 1, leaves), 1);
  return wood;
}

/// 0 stalk, 1 cap, 2 dots; 2 * 20 * 11 + 2 * 28 * 15 + 9 * 2 * 8 * 3 = 1,712 triangles.
Mesh mushroom() {
  Mesh mesh;
  append(mesh,
         smooth(lathe({{0.0, -0.5}, {1.0, -0.4}, {0.75, 0.6}, {0.55, 1.8}, {0.6, 3.0}, {0.0, 3.4}},
                      20, 12)),
         0);
  append(mesh,
         smooth(lathe({{0.0, 2.9}, {1.6, 2.7}, {2.6, 2.5}, {2.5, 3.2}, {1.6, 4.4}, {0.0, 4.9}}, 28,
                      16)),
         1);
  for (int i = 0; i < 9; ++i) {
    const double turn = 137.5 * i;
    const double out = 0.5 + 0.19 * i;
    const Vec spot(out * portable_cos_degrees(turn), 4.88 - 0.2 * out * out,
                   out * portable_sin_degrees(turn));
    const Frame lid = frame_along(spot, {spot.x * 0.4 * out, 1.0, spot.z * 0.4 * out});
    append(mesh, smooth(moved(stretched(ball(0.34, 8, 4), {1.0, 0.45, 1.0}), lid)), 2);
  }
  return mesh;
}

double ground_height(double x, double z) {
  const double far = std::sqrt(x * x + (z + 10.0) * (z + 10.0));
  // Flat where the animals stand, hills around.
  return smoothstep(22.0, 75.0, far) *
             (7.0 + 9.0 * fractal_noise({x * 0.022, 0.0, z * 0.022}, 3, 61)) +
         0.35 * fractal_noise({x * 0.35, 0.0, z * 0.35}, 3, 62);
}

}  // namespace

Scene still_life() {
  Scene scene = stage("still-life");
  const double floor = -13.5;
  place(scene,
        make_model("bunny", in_load_part(0.0, 0.7, [] { return bunny(69'451); }),
                   {paint("fur", {0.78F, 0.7F, 0.62F}, 0.05F)}),
        at({-44.0, 0.0, -24.0}, 20.0));
  place(scene,
        make_model(
            "car", sports_car(),
            {paint("paint", {0.75F, 0.08F, 0.1F}, 0.6F, 80.0F),
             paint("glass", {0.1F, 0.13F, 0.17F}, 0.8F, 120.0F),
             paint("tyre", {0.09F, 0.09F, 0.1F}, 0.1F), paint("rim", {0.75F, 0.76F, 0.78F}, 0.6F),
             paint("head lamp", {0.98F, 0.96F, 0.82F}, 0.8F),
             paint("tail lamp", {0.6F, 0.05F, 0.05F}, 0.6F)}),
        at({25.0, floor + 8.0, 16.0}, -20.0));
  place(scene,
        make_model(
            "urn", urn(),
            {paint("clay", {0.72F, 0.36F, 0.2F}, 0.3F), paint("band", {0.12F, 0.1F, 0.14F}, 0.4F)}),
        at({0.0, 0.0, -60.0}, 0.0, 1.2));
  place(scene,
        make_model("torus", smooth(torus(10.0, 3.5, 64, 32)),
                   {paint("torus", {0.2F, 0.5F, 0.75F}, 0.6F, 60.0F)}),
        matrix_of(Frame{{60.0, 4.0, -64.0}}.turned({1.0, 0.0, 0.0}, 62.0), 1.2));
  place(scene,
        make_model(
            "spider", in_load_part(0.7, 1.0, [&] { return spider(missing_to(scene, 98'867)); }),
            {paint("body", {0.24F, 0.2F, 0.2F}, 0.5F), paint("legs", {0.5F, 0.32F, 0.16F}, 0.3F)}),
        at({-14.0, floor, 30.0}, 60.0, 0.9));
  scene.camera.eye = {0.0F, 26.0F, 84.0F};
  scene.camera.target = {0.0F, -4.0F, -10.0F};
  scene.camera.vertical_fov_degrees = 60.0F;
  scene.lights[0].position = {60.0F, 110.0F, 130.0F};
  scene.lights[1].position = {-140.0F, 40.0F, 60.0F};
  return scene;
}

Scene hall() {
  Scene scene = stage("hall");
  const double floor = -30.0;
  const double height = 150.0;
  place(scene, make_model("hall", room({170.0, 0.5 * height, 320.0}, floor),
                          {paint("floor", {0.42F, 0.4F, 0.38F}, 0.2F),
                           paint("walls", {0.66F, 0.6F, 0.52F}, 0.0F),
                           paint("ceiling", {0.3F, 0.34F, 0.42F}, 0.0F)}));
  const auto pillar =
      make_model("column", column(height), {paint("marble", {0.78F, 0.76F, 0.72F}, 0.15F)});
  for (const double x : {-95.0, 95.0}) {
    for (int i = 0; i < 8; ++i) place(scene, pillar, at({x, floor, 30.0 - 45.0 * i}));
  }
  Mesh steps;
  append(steps, moved(rounded_box({44.0, 6.0, 44.0}, 0.5, 3), {{0.0, floor + 3.0, 0.0}}));
  append(steps, moved(rounded_box({32.0, 12.0, 32.0}, 0.5, 3), {{0.0, floor + 10.5, 0.0}}));
  place(scene, make_model("plinth", smooth(std::move(steps)),
                          {paint("granite", {0.34F, 0.3F, 0.32F}, 0.3F)}));
  // All the other triangles are in one small statue in the middle.
  place(scene, make_model("statue", sage(missing_to(scene, 436'942), 2),
                          {paint("bronze", {0.72F, 0.52F, 0.24F}, 0.6F, 50.0F)}));
  scene.camera.eye = {14.0F, 8.0F, 62.0F};
  scene.camera.target = {0.0F, 2.0F, 0.0F};
  scene.camera.vertical_fov_degrees = 70.0F;
  scene.lights[0].position = {60.0F, 95.0F, 90.0F};
  scene.lights[1].position = {-80.0F, 30.0F, -40.0F};
  return scene;
}

Scene forest() {
  Scene scene = stage("forest");
  const auto on_ground = [](double x, double z, double lift, double yaw, double scale) {
    return at({x, ground_height(x, z) + lift, z}, yaw, scale);
  };
  place(scene,
        make_model("dragon", in_load_part(0.0, 0.55, [] { return dragon(202'520); }),
                   {paint("jade", {0.2F, 0.52F, 0.36F}, 0.5F)}),
        on_ground(9.0, -14.0, 8.4, 4.0, 0.95));
  place(scene,
        make_model("bunny", in_load_part(0.55, 0.8, [] { return bunny(69'451); }),
                   {paint("fur", {0.8F, 0.74F, 0.66F}, 0.05F)}),
        on_ground(-15.0, 2.0, 4.35, 18.0, 0.34));
  const Material bark = paint("bark", {0.34F, 0.23F, 0.15F}, 0.0F);
  const std::shared_ptr<const Model> trees[2] = {
      make_model("oak", in_load_part(0.8, 0.86, [] { return tree(71, 17'000); }),
                 {bark, paint("oak leaves", {0.22F, 0.45F, 0.14F}, 0.05F)}),
      make_model("beech", in_load_part(0.86, 0.9, [] { return tree(81, 13'000); }),
                 {bark, paint("beech leaves", {0.5F, 0.52F, 0.13F}, 0.05F)})};
  Dice dice(91);
  // Trees stand in a ring around the clearing, open towards the camera.
  for (int i = 0; i < 16; ++i) {
    const double turn = 82.0 + 13.0 * i + dice.roll(-4.0, 4.0);
    const double far = i % 2 == 0 ? dice.roll(34.0, 44.0) : dice.roll(56.0, 74.0);
    const double x = far * 1.15 * portable_sin_degrees(turn);
    const double z = -12.0 + far * portable_cos_degrees(turn);
    const double yaw = dice.roll(0.0, 360.0);
    const double size = dice.roll(1.0, 1.5);
    place(scene, trees[i % 2], on_ground(x, z, -0.5, yaw, size));
  }
  const auto fungus = make_model(
      "mushroom", mushroom(),
      {paint("stalk", {0.92F, 0.88F, 0.78F}, 0.05F), paint("cap", {0.82F, 0.12F, 0.1F}, 0.5F),
       paint("dots", {0.96F, 0.94F, 0.9F}, 0.1F)});
  for (int i = 0; i < 24; ++i) {
    const double x = dice.roll(-34.0, 34.0);
    const double z = dice.roll(-4.0, 16.0);
    const double yaw = dice.roll(0.0, 360.0);
    const double size = dice.roll(0.3, 0.75);
    place(scene, fungus, on_ground(x, z, -0.1, yaw, size));
  }
  // The ground makes up the exact count; it is an open sheet.
  const std::size_t left = missing_to(scene, 679'531);
  const int lines = int(std::sqrt(double(left) / 2.0));
  Mesh ground = uv_grid(lines, lines, false, false, [](double u, double v) {
    const double x = 240.0 * (u - 0.5);
    const double z = 50.0 - 200.0 * v;
    return Vec(x, ground_height(x, z), z);
  });
  check_load();
  split_to(ground, left);
  place(scene, make_model("ground", smooth(std::move(ground)),
                          {paint("grass", {0.3F, 0.42F, 0.16F}, 0.0F)}));
  scene.background = {0.55F, 0.68F, 0.82F};
  scene.camera.eye = {-4.0F, 13.0F, 34.0F};
  scene.camera.target = {0.0F, 8.5F, -12.0F};
  scene.camera.vertical_fov_degrees = 65.0F;
  scene.lights[0].position = {70.0F, 120.0F, 90.0F};
  scene.lights[1].position = {-90.0F, 50.0F, 60.0F};
  return scene;
}

}  // namespace encore::scene::samples
