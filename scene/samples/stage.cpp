#include "scene/samples/stage.h"

#include "scene/samples/mesh_tools.h"

#include <stdexcept>
#include <utility>

namespace encore::scene::samples {

Material paint(const std::string& name, const glm::vec3& color, float shine, float exponent) {
  Material material;
  material.name = name;
  material.diffuse = color;
  material.specular = glm::vec3(shine);
  material.ambient = color * 0.2F;
  material.shininess = exponent;
  return material;
}

Scene stage(const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.source = "procedural";
  scene.lights.push_back({{14.0F, 22.0F, 32.0F}, {0.82F, 0.79F, 0.74F}});
  scene.lights.push_back({{-30.0F, 6.0F, 18.0F}, {0.22F, 0.25F, 0.32F}});
  scene.background = {0.07F, 0.08F, 0.1F};
  return scene;
}

std::shared_ptr<const Model> make_model(const std::string& name, Mesh mesh,
                                        std::vector<Material> materials) {
  auto model = std::make_shared<Model>();
  model->name = name;
  model->mesh = std::move(mesh);
  model->materials = std::move(materials);
  return model;
}

Instance& place(Scene& scene, std::shared_ptr<const Model> model, const glm::mat4& transform) {
  Instance instance;
  instance.name = model->name;
  instance.transform = transform;
  bool known = false;
  for (const Instance& other : scene.instances) {
    if (other.model != model) continue;
    instance.first_material = other.first_material;
    known = true;
    break;
  }
  if (!known) {
    instance.first_material = std::uint32_t(scene.materials.size());
    scene.materials.insert(scene.materials.end(), model->materials.begin(), model->materials.end());
  }
  instance.model = std::move(model);
  return scene.instances.emplace_back(std::move(instance));
}

Scene single(const std::string& name, Mesh mesh, std::vector<Material> materials) {
  Scene scene = stage(name);
  place(scene, make_model(name, std::move(mesh), std::move(materials)));
  return scene;
}

std::size_t triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) count += instance.model->mesh.triangles.size();
  return count;
}

std::size_t missing_to(const Scene& scene, std::size_t total) {
  const std::size_t count = triangle_count(scene);
  if (count > total) {
    throw std::logic_error("sample scene " + scene.name + " has " + std::to_string(count) +
                           " triangles, more than its " + std::to_string(total));
  }
  return total - count;
}

RigidMotion looping(const Frame& whole, double seconds, int keys,
                    const std::function<Pose(double)>& pose) {
  RigidMotion motion;
  for (int i = 0; i <= keys; ++i) {
    const double share = double(i) / keys;
    const Pose p = pose(share);
    Keyframe key;
    key.time_s = float(seconds * share);
    key.pose.translation = narrow(whole.world(p.position));
    key.pose.rotation_axis = narrow(whole.world(p.axis) - whole.origin);
    key.pose.rotation_degrees = float(p.degrees);
    motion.keys.push_back(key);
  }
  return motion;
}

}  // namespace encore::scene::samples
