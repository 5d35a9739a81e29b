#include "scene/sample_scenes.h"

#include "scene/load_watch.h"
#include "scene/samples/creatures.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/scenes.h"
#include "scene/samples/stage.h"
#include "scene/samples/things.h"

#include <functional>

namespace encore::scene {

namespace {

using samples::paint;
using samples::single;

/// The thesis' own triangle, where the thesis puts it.
Scene triangle() {
  Mesh mesh;
  mesh.positions = {{-1.0F, -1.0F, 1.0F}, {1.0F, 1.0F, -1.0F}, {1.0F, -1.0F, 1.0F}};
  mesh.triangles = {{0, 2, 1}};
  return single("triangle", std::move(mesh), {paint("yellow", {0.95F, 0.75F, 0.2F})});
}

Scene scissors() {
  return single(
      "scissors", samples::scissors(),
      {paint("steel", {0.72F, 0.74F, 0.78F}, 0.7F, 60.0F),
       paint("grip", {0.85F, 0.2F, 0.12F}, 0.4F), paint("rivet", {0.85F, 0.7F, 0.35F}, 0.6F)});
}

Scene wheel() {
  return single(
      "wheel", samples::steering_wheel(),
      {paint("leather", {0.34F, 0.2F, 0.13F}, 0.3F, 20.0F),
       paint("chrome", {0.75F, 0.77F, 0.8F}, 0.8F, 80.0F), paint("hub", {0.7F, 0.1F, 0.1F}, 0.5F)});
}

Scene mug() {
  return single("mug", samples::mug(),
                {paint("glaze", {0.24F, 0.56F, 0.82F}, 0.6F, 60.0F),
                 paint("handle", {0.93F, 0.88F, 0.78F}, 0.6F, 60.0F)});
}

Scene cow() {
  // White, because the colours are the vertices'.
  return single("cow", samples::cow(5'804), {paint("hide", glm::vec3(1.0F), 0.08F)});
}

Scene car() {
  return single(
      "car", samples::sports_car(),
      {paint("paint", {0.9F, 0.62F, 0.08F}, 0.6F, 80.0F),
       paint("glass", {0.1F, 0.13F, 0.17F}, 0.8F, 120.0F),
       paint("tyre", {0.09F, 0.09F, 0.1F}, 0.1F), paint("rim", {0.75F, 0.76F, 0.78F}, 0.6F),
       paint("head lamp", {0.98F, 0.96F, 0.82F}, 0.8F),
       paint("tail lamp", {0.6F, 0.05F, 0.05F}, 0.6F)});
}

Scene dragon(const std::string& name, std::size_t triangles) {
  return single(name, samples::dragon(triangles),
                {paint("jade", {0.24F, 0.6F, 0.42F}, 0.55F, 45.0F)});
}

Scene bunny() {
  return single("bunny", samples::bunny(69'451), {paint("fur", {0.82F, 0.73F, 0.63F}, 0.05F)});
}

Scene buddha() {
  return single("buddha", samples::sage(1'087'716, 2),
                {paint("gold", {0.85F, 0.62F, 0.22F}, 0.65F, 50.0F)});
}

struct Entry {
  SampleScene about;
  std::function<Scene()> make;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list = {
      {{"triangle", "SingleTri", 1, "static", "one triangle, the thesis' own"}, triangle},
      {{"scissors", "Scissors", 604, "static", "thin blades and rings"}, scissors},
      {{"wheel", "Wheel", 1'368, "static", "a steering wheel: a thin ring around a void"}, wheel},
      {{"mug", "Mug", 3'450, "static", "a hollow cup"}, mug},
      {{"cow", "Cow", 5'804, "static", "a small closed animal with coloured patches"}, cow},
      {{"car", "Porsche", 10'474, "static", "a sports car of several parts"}, car},
      {{"toys", "Toaster", 11'141, "rigid parts", "an open box of moving toys"}, samples::toys},
      {{"dragon", "Sdragon", 47'794, "static", "a closed, scaly dragon"},
       [] { return dragon("dragon", 47'794); }},
      {{"bunny", "Bbunny", 69'451, "static", "a furry rabbit, open at the bottom"}, bunny},
      {{"still-life", "Complex", 98'867, "static", "five models far apart in one scene"},
       samples::still_life},
      {{"dragon-fine", "200k", 202'520, "static", "the dragon with four times the triangles"},
       [] { return dragon("dragon-fine", 202'520); }},
      {{"hall", "400k", 436'942, "static", "a dense statue in a huge, coarse hall: very uneven"},
       samples::hall},
      {{"forest", "Fairy", 679'531, "static", "a clearing with a dragon, a rabbit and trees"},
       samples::forest},
      {{"buddha", "990k", 1'087'716, "static", "a seated figure, closed, over a million triangles"},
       buddha},
      {{"wave", "", 20'000, "deforming", "a checkered cloth under a travelling wave"},
       samples::wave},
      {{"metaballs", "", 8'648, "changing count", "drops that merge and part"}, samples::metaballs},
      {{"mirrors", "", 8'980, "static",
        "mirrors, a glass ball and textures, for rays of every kind"},
       samples::mirrors},
  };
  return list;
}

}  // namespace

const std::vector<SampleScene>& sample_scenes() {
  static const std::vector<SampleScene> list = [] {
    std::vector<SampleScene> scenes;
    for (const Entry& entry : entries()) scenes.push_back(entry.about);
    return scenes;
  }();
  return list;
}

std::optional<Scene> make_sample_scene(std::string_view name) {
  for (const Entry& entry : entries()) {
    if (entry.about.name != name) continue;
    note_load(entry.about.name);
    report_load(0.0);
    return entry.make();
  }
  return std::nullopt;
}

}  // namespace encore::scene
