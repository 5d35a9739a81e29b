#include "scene/assets.h"

#include "scene/basic_shapes.h"
#include "scene/mesh_reader.h"
#include "scene/model_input.h"
#include "scene/sample_scenes.h"
#include "scene/text_suggestion.h"
#include "scene/triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

namespace encore::scene {
namespace fs = std::filesystem;
namespace {

bool digit(char c) {
  return c >= '0' && c <= '9';
}

/// Order of file names in which numbers count as numbers: frame2 before frame10.
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    // Compare two runs of digits: without leading zeros the longer one is larger.
    while (i < a.size() && a[i] == '0') ++i;
    while (j < b.size() && b[j] == '0') ++j;
    const std::size_t a_from = i;
    const std::size_t b_from = j;
    while (i < a.size() && digit(a[i])) ++i;
    while (j < b.size() && digit(b[j])) ++j;
    if (i - a_from != j - b_from) return i - a_from < j - b_from;
    const int order = a.compare(a_from, i - a_from, b, b_from, j - b_from);
    if (order != 0) return order < 0;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;
}

/// The largest mesh that an instance shows, and the longest list of materials.
std::pair<std::uint64_t, std::size_t> largest(const Instance& instance) {
  std::uint64_t triangles = 0;
  std::size_t materials = 0;
  const auto look = [&](const Model& model) {
    triangles = std::max<std::uint64_t>(triangles, model.mesh.triangles.size());
    materials = std::max(materials, model.materials.size());
  };
  if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
    for (const auto& frame : sequence->frames) look(*frame);
  } else if (instance.model) {
    look(*instance.model);
  }
  return {triangles, materials};
}

/// The materials of the frame (or model) that has most.
const std::vector<Material>* own_materials(const Instance& instance) {
  const std::vector<Material>* most = instance.model ? &instance.model->materials : nullptr;
  if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
    for (const auto& frame : sequence->frames) {
      if (most == nullptr || frame->materials.size() > most->size()) most = &frame->materials;
    }
  }
  return most;
}

/// Whether some mesh that an instance shows has texture coordinates.
bool has_texcoords(const Instance& instance) {
  if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
    return std::any_of(sequence->frames.begin(), sequence->frames.end(),
                       [](const auto& frame) { return !frame->mesh.texcoords.empty(); });
  }
  return instance.model && !instance.model->mesh.texcoords.empty();
}

void append(Scene& scene, Instance instance, const Material* material, std::size_t material_count) {
  instance.first_material = static_cast<std::uint32_t>(scene.materials.size());
  const auto* own = own_materials(instance);
  if (material != nullptr) {
    // One copy for each material of the model, so that the mesh can be shared as it is.
    scene.materials.insert(scene.materials.end(), std::max<std::size_t>(material_count, 1),
                           *material);
  } else if (own != nullptr && !own->empty()) {
    scene.materials.insert(scene.materials.end(), own->begin(), own->end());
  } else {
    scene.materials.emplace_back();
  }
  scene.instances.push_back(std::move(instance));
}

}  // namespace

Assets::Assets(fs::path folder, std::vector<fs::path> search_path)
    : folder_(std::move(folder)), search_path_(std::move(search_path)), textures_(search_path_) {}

fs::path Assets::find(const std::string& file, bool want_folder, const std::string& what,
                      const std::string& place) const {
  if (file.empty()) throw InputError(fmt::format("{}: the name of the {} is empty", place, what));
  if (folder_.empty()) {
    throw InputError(
        fmt::format("{}: cannot find the {} '{}': no files are looked up here", place, what, file));
  }
  // Its own path first, then each entry of the search path by path and by bare name.
  const fs::path wanted(file);
  std::vector<fs::path> candidates{wanted.is_absolute() ? wanted : folder_ / wanted};
  for (const fs::path& entry : search_path_) {
    if (!wanted.is_absolute()) candidates.push_back(entry / wanted);
    if (wanted.has_filename()) candidates.push_back(entry / wanted.filename());
  }
  std::string tried;
  for (const fs::path& candidate : candidates) {
    // Only real files and folders: a device or a pipe could be read for ever.
    std::error_code error;
    const bool found =
        want_folder ? fs::is_directory(candidate, error) : fs::is_regular_file(candidate, error);
    if (found) return candidate;
    tried += (tried.empty() ? "" : ", ") + candidate.string();
  }
  throw InputError(fmt::format("{}: cannot find the {} '{}' (tried {})", place, what, file, tried));
}

std::shared_ptr<const Model> Assets::model(const std::string& file, const std::string& place,
                                           Warnings& warnings) {
  const fs::path path = find(file, false, "model file", place);
  auto& slot = models_[path];
  if (slot) return slot;
  try {
    Model model = read_model(path, &textures_);
    warnings.add(model.warnings);
    slot = std::make_shared<const Model>(std::move(model));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place, error.what()));
  }
  return slot;
}

std::shared_ptr<const Texture> Assets::texture(const std::string& file, const std::string& place) {
  const fs::path path = find(file, false, "texture", place);
  try {
    return textures_.read(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place, error.what()));
  }
}

std::shared_ptr<const Scene> Assets::generated(const std::string& name, const std::string& place) {
  auto& slot = generated_[name];
  if (slot) return slot;
  if (auto shape = make_basic_shape(name)) {
    Scene scene;
    Instance instance;
    instance.name = name;
    instance.model = std::move(shape);
    append(scene, std::move(instance), nullptr, 1);
    return slot = std::make_shared<const Scene>(std::move(scene));
  }
  if (auto sample = make_sample_scene(name)) {
    return slot = std::make_shared<const Scene>(std::move(*sample));
  }
  std::vector<std::string_view> names = basic_shape_names();
  for (const SampleScene& sample : sample_scenes()) names.emplace_back(sample.name);
  throw InputError(
      fmt::format("{}: no generator is called '{}'{}", place, name, did_you_mean(name, names)));
}

std::vector<std::string> Assets::frames_of_folder(const std::string& folder,
                                                  const std::string& place) {
  const fs::path path = find(folder, true, "folder of frames", place);
  const std::vector<std::string> extensions = supported_extensions();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string extension = lower_extension(entry->path());
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) {
      names.push_back(entry->path().filename().string());
    }
  }
  if (names.empty()) {
    throw InputError(fmt::format("{}: the folder {} holds no model files", place, path.string()));
  }
  std::sort(names.begin(), names.end(), natural_less);
  for (std::string& name : names) name = fs::absolute(path / name).string();
  return names;
}

void Assets::add(Scene& scene, Instance instance, const Material* material,
                 const std::string& place) {
  const auto [triangles, material_count] = largest(instance);
  triangles_ += triangles;
  if (triangles_ > kMaxSceneTriangles) {
    throw InputError(fmt::format("{}: the scene would have {} triangles; the limit is {}", place,
                                 triangles_, kMaxSceneTriangles));
  }
  if (scene.instances.size() >= kMaxInstances) {
    throw InputError(fmt::format("{}: more than {} models in one scene", place, kMaxInstances));
  }
  if (scene.materials.size() + material_count > kMaxMaterials) {
    throw InputError(fmt::format("{}: more than {} materials in one scene", place, kMaxMaterials));
  }
  if (material == nullptr || material->diffuse_texture == nullptr || has_texcoords(instance)) {
    append(scene, std::move(instance), material, material_count);
    return;
  }
  scene.warnings.add(fmt::format(
      "{}: the material's texture is left out: the model has no texture coordinates", place));
  Material plain = *material;
  plain.diffuse_texture = nullptr;
  append(scene, std::move(instance), &plain, material_count);
}

Bounds bounds_at_start(const Scene& scene) {
  // One instance at a time, so that no second copy of the whole scene is ever needed.
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    Scene part;
    part.instances.push_back(instance);
    TriangleList list;
    update_triangles(part, 0.0, list);
    bounds.extend(list.bounds());
  }
  return bounds;
}

std::string read_scene_text(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    throw InputError(fmt::format("{}: is a folder; give a scene or model file", path.string()));
  }
  std::ifstream file(path, std::ios::binary);
  std::string text;
  if (file) {
    // Read by pieces: the size is not known of everything that can be opened.
    std::string piece(64U << 10U, '\0');
    while (text.size() <= kMaxSceneFileBytes) {
      file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
      text.append(piece, 0, static_cast<std::size_t>(file.gcount()));
      if (!file) break;
    }
  }
  if (!file && !file.eof()) throw InputError(fmt::format("{}: cannot be read", path.string()));
  if (text.size() > kMaxSceneFileBytes) {
    throw InputError(fmt::format("{}: larger than {} MiB, so not a scene file", path.string(),
                                 kMaxSceneFileBytes >> 20U));
  }
  return text;
}

void add_default_light(Scene& scene) {
  if (!scene.lights.empty()) return;
  scene.lights.push_back(Light{scene.camera.eye, glm::vec3(1.0F)});
}

}  // namespace encore::scene
