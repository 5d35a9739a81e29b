// Promises of the sample scenes: the thesis' exact counts, the same bits on every machine, closed
// scans, one strongly uneven scene, and animations that move and loop.
#include "scene/sample_scenes.h"

#include "scene/bounds.h"
#include "scene/needs.h"
#include "scene/ray_settings.h"
#include "scene/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace encore::scene;

/// Scenes are made once a program; the larger ones take most of a second.
const Scene& scene_named(const std::string& name) {
  static std::map<std::string, Scene> made;
  const auto found = made.find(name);
  if (found != made.end()) return found->second;
  std::optional<Scene> scene = make_sample_scene(name);
  EXPECT_TRUE(scene.has_value()) << name;
  return made.emplace(name, std::move(scene).value_or(Scene{})).first->second;
}

std::size_t count_at_start(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) count += instance.model->mesh.triangles.size();
  return count;
}

/// All models of a scene: those of its instances, and every frame of a sequence.
std::vector<const Model*> models_of(const Scene& scene) {
  std::vector<const Model*> models;
  for (const Instance& instance : scene.instances) {
    models.push_back(instance.model.get());
    if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
      for (const auto& frame : sequence->frames) models.push_back(frame.get());
    }
  }
  return models;
}

/// FNV-1a, 64 bits, over the bytes of everything that shapes a scene.
class Fingerprint {
 public:
  template <class T>
  void add(const T* items, std::size_t count) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(items);
    for (std::size_t i = 0; i < count * sizeof(T); ++i) {
      value_ = (value_ ^ bytes[i]) * 1099511628211ULL;
    }
  }
  void add(const Mesh& mesh) {
    add(mesh.positions.data(), mesh.positions.size());
    add(mesh.triangles.data(), mesh.triangles.size());
    add(mesh.normals.data(), mesh.normals.size());
    add(mesh.colors.data(), mesh.colors.size());
    add(mesh.texcoords.data(), mesh.texcoords.size());
    add(mesh.material_of.data(), mesh.material_of.size());
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

std::uint64_t fingerprint(const Scene& scene) {
  Fingerprint print;
  for (const Instance& instance : scene.instances) {
    print.add(&instance.transform, 1);
    const auto* rigid = std::get_if<RigidMotion>(&instance.motion);
    if (rigid == nullptr) continue;
    for (const Keyframe& key : rigid->keys) {
      print.add(&key.time_s, 1);
      print.add(&key.pose.translation, 1);
      print.add(&key.pose.rotation_axis, 1);
      print.add(&key.pose.rotation_degrees, 1);
    }
  }
  for (const Model* model : models_of(scene)) print.add(model->mesh);
  for (const Material& material : scene.materials) {
    const Texture* texture = material.diffuse_texture.get();
    if (texture != nullptr) print.add(texture->texels.data(), texture->texels.size());
  }
  return print.value();
}

struct EdgeUse {
  int along = 0;    ///< triangles that run from the lower to the higher vertex
  int against = 0;  ///< and the other way
};

std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse> edge_uses(const Mesh& mesh) {
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, bool>> all;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      all.push_back({{std::min(a, b), std::max(a, b)}, a < b});
    }
  }
  std::sort(all.begin(), all.end());
  std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse> uses;
  for (const auto& [edge, forwards] : all) {
    // Sorted input makes each insertion at the end cheap.
    EdgeUse& use = uses.emplace_hint(uses.end(), edge, EdgeUse{})->second;
    ++(forwards ? use.along : use.against);
  }
  return uses;
}

/// Six times the enclosed volume; positive if the surface faces outwards.
double volume_times_six(const Mesh& mesh) {
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 b(mesh.positions[t.y]);
    const glm::dvec3 c(mesh.positions[t.z]);
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
           a.z * (b.x * c.y - b.y * c.x);
  }
  return sum;
}

/// How unevenly a scene fills its box: the share of all triangles that the fullest of 9 x 9 x 9
/// equal cells holds (by centre).
double fullest_cell_share(const Scene& scene) {
  std::vector<glm::vec3> centers;
  Bounds box;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = instance.model->mesh;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 c = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F;
      centers.emplace_back(instance.transform * glm::vec4(c, 1.0F));
      box.extend(centers.back());
    }
  }
  std::vector<std::size_t> cells(729, 0);
  for (const glm::vec3& c : centers) {
    const glm::vec3 share = (c - box.min) / box.size() * 8.999F;
    ++cells[std::size_t(share.x) + 9 * std::size_t(share.y) + 81 * std::size_t(share.z)];
  }
  return double(*std::max_element(cells.begin(), cells.end())) / double(centers.size());
}

TEST(SampleScenes, HaveExactlyTheTrianglesOfTheThesisTable) {
  const std::map<std::string, std::uint64_t> table = {
      {"SingleTri", 1},   {"Scissors", 604},   {"Wheel", 1'368},    {"Mug", 3'450},
      {"Cow", 5'804},     {"Porsche", 10'474}, {"Toaster", 11'141}, {"Sdragon", 47'794},
      {"Bbunny", 69'451}, {"Complex", 98'867}, {"200k", 202'520},   {"400k", 436'942},
      {"Fairy", 679'531}, {"990k", 1'087'716}};
  std::map<std::string, std::uint64_t> rows;
  for (const SampleScene& about : sample_scenes()) {
    EXPECT_EQ(count_at_start(scene_named(about.name)), about.triangles) << about.name;
    if (!about.thesis_name.empty()) rows[about.thesis_name] = about.triangles;
  }
  EXPECT_EQ(rows, table);
}

TEST(SampleScenes, AreTheSameBitForBitEverywhere) {
  // Recorded once; equal for g++ -O0 and -O3 and for clang++ -O2. Whoever changes a scene on
  // purpose records its new value, which the failure prints.
  const std::map<std::string, std::uint64_t> recorded = {
      {"triangle", 0xF9BE0B871B6DC8CBULL},    {"scissors", 0xE1E24AA3B2B10BB8ULL},
      {"wheel", 0xEB9FA8EB31D27116ULL},       {"mug", 0xB1221B7D22175E4BULL},
      {"cow", 0x42759F715FBBB82AULL},         {"car", 0x745CDF58EBE17721ULL},
      {"toys", 0xBFC20A980409C14FULL},        {"dragon", 0x3E78D5C06957685AULL},
      {"bunny", 0x3CE6B6D8EDE8D47DULL},       {"still-life", 0x5C8C471272A3F418ULL},
      {"dragon-fine", 0x7C64325660E9F61EULL}, {"hall", 0xFF4DC7A07F38512FULL},
      {"forest", 0xF48D03D109FC202DULL},      {"buddha", 0xD041B1A4BFC7EEEAULL},
      {"wave", 0x5116B10BB3D13300ULL},        {"metaballs", 0xFD598AA49FC6CE66ULL},
      {"mirrors", 0xA3788FF50DCA5411ULL}};
  for (const SampleScene& about : sample_scenes()) {
    ASSERT_TRUE(recorded.contains(about.name)) << about.name;
    EXPECT_EQ(fingerprint(scene_named(about.name)), recorded.at(about.name))
        << about.name << " now has 0x" << std::hex << fingerprint(scene_named(about.name)) << "ULL";
  }
}

TEST(SampleScenes, TheThesisTriangleIsWhereTheThesisPutsIt) {
  const Mesh& mesh = scene_named("triangle").instances.at(0).model->mesh;
  std::set<std::tuple<float, float, float>> corners;
  for (int k = 0; k < 3; ++k) {
    const glm::vec3& p = mesh.positions.at(mesh.triangles.at(0)[k]);
    corners.insert({p.x, p.y, p.z});
  }
  EXPECT_EQ(corners, (std::set<std::tuple<float, float, float>>{
                         {-1.0F, -1.0F, 1.0F}, {1.0F, 1.0F, -1.0F}, {1.0F, -1.0F, 1.0F}}));
}

TEST(SampleScenes, HoldOnlyFiniteNumbersAndValidIndices) {
  for (const SampleScene& about : sample_scenes()) {
    const Scene& scene = scene_named(about.name);
    for (const Model* model : models_of(scene)) {
      const Mesh& mesh = model->mesh;
      const std::size_t count = mesh.positions.size();
      EXPECT_TRUE(std::all_of(mesh.positions.begin(), mesh.positions.end(), [](const glm::vec3& p) {
        return is_finite(p);
      })) << about.name;
      EXPECT_TRUE(std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                              [&](const auto& t) {
                                return t.x < count && t.y < count && t.z < count && t.x != t.y &&
                                       t.y != t.z && t.z != t.x;
                              }))
          << about.name << ", " << model->name;
      EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == count) << about.name;
      EXPECT_TRUE(mesh.colors.empty() || mesh.colors.size() == count) << about.name;
      for (const glm::vec3& n : mesh.normals) {
        const float l = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        ASSERT_NEAR(l, 1.0F, 1e-4F) << about.name << ", " << model->name;
      }
      ASSERT_TRUE(mesh.material_of.empty() || mesh.material_of.size() == mesh.triangles.size());
      for (const std::uint32_t m : mesh.material_of) ASSERT_LT(m, model->materials.size());
    }
    for (const Instance& instance : scene.instances) {
      EXPECT_LE(instance.first_material + instance.model->materials.size(), scene.materials.size());
    }
  }
}

TEST(SampleScenes, ClosedScansShareEveryEdgeBetweenTwoTrianglesAndFaceOutwards) {
  for (const std::string name : {"cow", "dragon", "dragon-fine", "buddha"}) {
    const Mesh& mesh = scene_named(name).instances.at(0).model->mesh;
    std::size_t wrong = 0;
    for (const auto& [edge, use] : edge_uses(mesh)) wrong += use.along != 1 || use.against != 1;
    EXPECT_EQ(wrong, 0U) << name;
    EXPECT_GT(volume_times_six(mesh), 0.0) << name;
  }
}

TEST(SampleScenes, TheBunnyIsOpenOnlyAtItsBottom) {
  const Mesh& mesh = scene_named("bunny").instances.at(0).model->mesh;
  float lowest = mesh.positions.at(0).y;
  for (const glm::vec3& p : mesh.positions) lowest = std::min(lowest, p.y);
  std::size_t open = 0;
  for (const auto& [edge, use] : edge_uses(mesh)) {
    ASSERT_LE(use.along, 1);
    ASSERT_LE(use.against, 1);
    if (use.along + use.against == 2) continue;
    ++open;
    // Relief moves the rim a little off its plane; the rabbit is 27 units tall.
    EXPECT_LT(mesh.positions[edge.first].y, lowest + 1.0F);
    EXPECT_LT(mesh.positions[edge.second].y, lowest + 1.0F);
  }
  EXPECT_GT(open, 0U);
}

TEST(SampleScenes, SingleModelsFillTheThesisWindow) {
  for (const std::string name :
       {"scissors", "wheel", "car", "cow", "dragon", "bunny", "dragon-fine", "buddha"}) {
    const Scene& scene = scene_named(name);
    Bounds box;
    for (const glm::vec3& p : scene.instances.at(0).model->mesh.positions) box.extend(p);
    EXPECT_NEAR(box.size()[box.longest_axis()], 27.0F, 1e-3F) << name;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(box.center()[k], 0.0F, 1e-3F) << name;
    EXPECT_EQ(scene.camera.eye, glm::vec3(0.0F, 0.0F, 25.0F)) << name;
    EXPECT_EQ(scene.camera.vertical_fov_degrees, 90.0F) << name;
  }
}

TEST(SampleScenes, TheHallIsFarMoreUnevenThanAnyScan) {
  const double hall = fullest_cell_share(scene_named("hall"));
  EXPECT_GT(hall, 0.3);
  for (const std::string name : {"dragon", "bunny", "buddha"}) {
    EXPECT_GT(hall, 8.0 * fullest_cell_share(scene_named(name))) << name;
  }
}

TEST(SampleScenes, ToysMoveRigidlyAndLoopWithoutAJump) {
  int moving = 0;
  std::set<float> ends;
  for (const Instance& instance : scene_named("toys").instances) {
    const auto* motion = std::get_if<RigidMotion>(&instance.motion);
    if (motion == nullptr) continue;
    ++moving;
    const Keyframe& first = motion->keys.front();
    const Keyframe& last = motion->keys.back();
    EXPECT_EQ(first.time_s, 0.0F);
    ends.insert(last.time_s);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(first.pose.translation[k], last.pose.translation[k], 1e-4F) << instance.name;
    }
    const float turns = (last.pose.rotation_degrees - first.pose.rotation_degrees) / 360.0F;
    EXPECT_NEAR(turns, std::round(turns), 1e-4F) << instance.name;
    for (std::size_t i = 1; i < motion->keys.size(); ++i) {
      EXPECT_LT(motion->keys[i - 1].time_s, motion->keys[i].time_s);
      // Less than half a turn between two keys, or the interpolation would go the other way.
      EXPECT_LT(std::abs(motion->keys[i].pose.rotation_degrees -
                         motion->keys[i - 1].pose.rotation_degrees),
                180.0F)
          << instance.name;
    }
  }
  EXPECT_GE(moving, 10);
  EXPECT_EQ(ends.size(), 1U) << "all parts share one loop";
}

TEST(SampleScenes, TheWaveDeformsASurfaceOfFixedTopology) {
  const Scene& scene = scene_named("wave");
  const auto* deformer = std::get_if<Deformer>(&scene.instances.at(0).motion);
  ASSERT_NE(deformer, nullptr);
  EXPECT_GT(deformer->amplitude, 0.0F);
  EXPECT_GT(deformer->frequency_hz, 0.0F);
}

TEST(SampleScenes, MetaballsChangeTheirCountFromFrameToFrame) {
  const auto* sequence =
      std::get_if<FrameSequence>(&scene_named("metaballs").instances.at(0).motion);
  ASSERT_NE(sequence, nullptr);
  std::size_t changes = 0;
  const std::size_t frames = sequence->frames.size();
  for (std::size_t i = 0; i < frames; ++i) {
    const Mesh& here = sequence->frames[i]->mesh;
    // The frame after the last is the first: the loop closes as smoothly as any other step.
    const Mesh& next = sequence->frames[(i + 1) % frames]->mesh;
    changes += here.triangles.size() != next.triangles.size();
    const double volume = volume_times_six(here);
    EXPECT_GT(volume, 0.0);
    EXPECT_NEAR(volume_times_six(next) / volume, 1.0, 0.15) << "frame " << i;
  }
  EXPECT_GT(changes, frames * 3 / 4);
}

TEST(SampleScenes, OnlyMirrorsHasUseForEveryKindOfRay) {
  for (const SampleScene& about : sample_scenes()) {
    const Scene& scene = scene_named(about.name);
    RaySettings rays;
    for (const Preference& one : scene.preferences) {
      EXPECT_EQ(apply_ray_setting(rays, one.key, one.value), "") << about.name;
    }
    TriangleList list;
    if (about.triangles < 20'001) update_triangles(scene, 0.0, list);
    const Needs needs = needs_of(scene, list, rays);
    const bool all = needs.shadows && needs.reflections && needs.refractions && needs.textures;
    EXPECT_EQ(all, about.name == "mirrors") << about.name;
    EXPECT_EQ(needs.paths(), about.name == "mirrors") << about.name;
    EXPECT_EQ(list.texcoords.empty(), about.name != "mirrors") << about.name;
  }
}

TEST(SampleScenes, TheGlassBallIsClosedAndFacesOutwards) {
  for (const Instance& instance : scene_named("mirrors").instances) {
    if (instance.name != "glass ball") continue;
    const Mesh& mesh = instance.model->mesh;
    std::size_t wrong = 0;
    for (const auto& [edge, use] : edge_uses(mesh)) wrong += use.along != 1 || use.against != 1;
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(volume_times_six(mesh), 0.0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::vec3& p = mesh.positions[i];
      EXPECT_GT(p.x * mesh.normals[i].x + p.y * mesh.normals[i].y + p.z * mesh.normals[i].z, 2.09F);
    }
    return;
  }
  FAIL() << "there is no glass ball";
}

TEST(SampleScenes, EveryAnimationWordDescribesTheMotionsPresent) {
  for (const SampleScene& about : sample_scenes()) {
    std::set<std::size_t> kinds;
    for (const Instance& instance : scene_named(about.name).instances) {
      kinds.insert(instance.motion.index());
    }
    const std::map<std::string, std::size_t> index = {
        {"static", 0}, {"rigid parts", 1}, {"deforming", 2}, {"changing count", 3}};
    ASSERT_TRUE(index.contains(about.animation)) << about.name;
    kinds.erase(0);
    const std::size_t expected = index.at(about.animation);
    EXPECT_EQ(kinds, expected == 0 ? std::set<std::size_t>{} : std::set<std::size_t>{expected})
        << about.name;
  }
}

TEST(SampleScenes, AnUnknownNameGivesNothing) {
  EXPECT_FALSE(make_sample_scene("no such scene").has_value());
  EXPECT_FALSE(make_sample_scene("").has_value());
  EXPECT_TRUE(make_sample_scene(kDefaultSceneName).has_value());
}

}  // namespace
