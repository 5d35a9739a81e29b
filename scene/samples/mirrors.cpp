#include "scene/basic_shapes.h"
#include "scene/checker_texture.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/scenes.h"
#include "scene/samples/shapes.h"
#include "scene/samples/stage.h"

#include <utility>

namespace encore::scene::samples {

namespace {

std::shared_ptr<const Texture> checker(const glm::vec3& a, const glm::vec3& b, int cells) {
  return std::make_shared<const Texture>(checker_texture({a, b}, cells));
}

/// A rectangle in the plane of two edges, which faces their cross product and wears `repeats`
/// textures each way.
Mesh board(const glm::vec3& corner, const glm::vec3& across, const glm::vec3& up, float repeats) {
  Mesh mesh;
  mesh.positions = {corner, corner + across, corner + across + up, corner + up};
  mesh.texcoords = {{0.0F, 0.0F}, {repeats, 0.0F}, {repeats, repeats}, {0.0F, repeats}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A ball with the sphere's own normals: light bends by them as in a true sphere.
Mesh round_ball(double radius) {
  Mesh mesh = ball(radius, 48, 24);
  for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(narrow(normalize(widen(p))));
  return mesh;
}

Material mirror(const std::string& name, const glm::vec3& color, float share) {
  Material material = paint(name, color, 0.8F, 200.0F);
  material.reflectivity = share;
  return material;
}

/// Clear glass: nothing of its own but highlights, the rest by Fresnel's equations.
Material glass(float index) {
  Material material = paint("glass", glm::vec3(0.02F), 0.6F, 300.0F);
  material.opacity = 0.05F;
  material.index_of_refraction = index;
  return material;
}

void put(Scene& scene, const std::string& name, Mesh mesh, Material material,
         const Vec& position = Vec(0.0)) {
  place(scene, make_model(name, std::move(mesh), {std::move(material)}),
        matrix_of(Frame{position}));
}

}  // namespace

Scene mirrors() {
  Scene scene = stage("mirrors");
  scene.lights = {{{13.0F, 19.0F, 16.0F}, {0.8F, 0.78F, 0.72F}},
                  {{-15.0F, 14.0F, 10.0F}, {0.32F, 0.35F, 0.42F}}};
  scene.camera.eye = {0.0F, 8.5F, 22.0F};
  scene.camera.target = {0.0F, 2.6F, 0.0F};
  scene.camera.vertical_fov_degrees = 42.0F;
  scene.preferences = {{"rays", "all", "sample scene mirrors"}};

  Material floor = paint("floor", glm::vec3(1.0F), 0.0F);
  floor.diffuse_texture = checker({0.78F, 0.76F, 0.7F}, {0.1F, 0.12F, 0.16F}, 2);
  put(scene, "floor", board({-18, 0, 14}, {36, 0, 0}, {0, 0, -28}, 9.0F), std::move(floor));
  // Leans back a little, so that it shows the floor in front of it.
  put(scene, "looking glass", board({-9, 0.2F, -9}, {18, 0, 0}, {0, 9, -1.2F}, 1.0F),
      mirror("silver", glm::vec3(0.06F), 0.85F));
  put(scene, "mirror ball", round_ball(2.9), mirror("chrome", {0.12F, 0.12F, 0.14F}, 0.8F),
      {-4.6, 2.9, -2.4});
  put(scene, "glass ball", round_ball(2.1), glass(1.5F), {2.3, 2.1, 4.2});
  put(scene, "ring", smooth(torus(2.0, 0.62, 48, 20)), paint("red", {0.8F, 0.1F, 0.08F}, 0.3F),
      {3.6, 0.62, -3.4});
  put(scene, "cube", smooth(rounded_box({2.6, 2.6, 2.6}, 0.25, 6)),
      paint("blue", {0.1F, 0.24F, 0.75F}, 0.3F), {-1.6, 1.3, 1.6});
  // The shape of scene files, which brings texture coordinates; its poles lie on the y axis.
  Model globe = sphere_model(48, 24);
  globe.name = "globe";
  globe.materials = {paint("globe", glm::vec3(1.0F), 0.35F)};
  globe.materials[0].diffuse_texture = checker({0.95F, 0.6F, 0.08F}, {0.12F, 0.4F, 0.16F}, 8);
  place(scene, std::make_shared<const Model>(std::move(globe)),
        matrix_of(Frame{{7.4, 1.9, -0.6}}.turned(kZ, 20.0), 1.9));
  return scene;
}

}  // namespace encore::scene::samples
