#include "scene/scene_toml_model.h"

#include "scene/load_watch.h"
#include "scene/motion.h"
#include "scene/placement.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

namespace encore::scene {
namespace {

glm::vec3 required_axis(TomlTable& table, const glm::vec3& fallback) {
  const glm::vec3 axis = table.vector("axis").value_or(fallback);
  if (axis == glm::vec3(0.0F)) table.fail("axis", "'axis' must not be all zero");
  return axis;
}

/// translate, rotate and scale of a model or a key.
Transform read_transform(TomlTable& table, Warnings& warnings) {
  Transform t;
  t.translation = table.vector("translate").value_or(t.translation);
  t.scale = table.number_or_vector("scale").value_or(t.scale);
  if (auto rotate = table.table("rotate")) {
    t.rotation_axis = required_axis(*rotate, t.rotation_axis);
    t.rotation_degrees = rotate->number("degrees").value_or(0.0F);
    if (!rotate->has("degrees")) rotate->fail("degrees", "'rotate' needs 'degrees'");
    rotate->warn_about_unknown_keys(warnings);
  }
  return t;
}

RigidMotion read_keys(std::vector<TomlTable>& tables, Warnings& warnings) {
  RigidMotion motion;
  for (TomlTable& table : tables) {
    Keyframe key;
    const auto time = table.number("time", kNotNegative);
    if (!time) table.fail("time", "a key needs 'time' (seconds)");
    key.time_s = *time;
    if (!motion.keys.empty() && !(key.time_s > motion.keys.back().time_s)) {
      table.fail("time", fmt::format("'time' must grow from key to key; {} follows {}", key.time_s,
                                     motion.keys.back().time_s));
    }
    key.pose = read_transform(table, warnings);
    table.warn_about_unknown_keys(warnings);
    motion.keys.push_back(key);
  }
  return motion;
}

Deformer read_deformer(TomlTable& table, Warnings& warnings) {
  static constexpr std::string_view kKinds[] = {"wave", "twist", "explode"};
  Deformer deformer;
  const auto kind = table.text("kind");
  if (!kind) table.fail("kind", "a deformer needs 'kind': wave, twist or explode");
  if (*kind == "wave") {
    deformer.kind = Deformer::Kind::wave;
  } else if (*kind == "twist") {
    deformer.kind = Deformer::Kind::twist;
  } else if (*kind == "explode") {
    deformer.kind = Deformer::Kind::explode;
  } else {
    table.fail("kind", fmt::format("'kind' must be wave, twist or explode, not '{}'{}", *kind,
                                   did_you_mean(*kind, kKinds)));
  }
  deformer.axis = required_axis(table, deformer.axis);
  deformer.amplitude = table.number("amplitude").value_or(deformer.amplitude);
  deformer.wavelength = table.number("wavelength", kPositive).value_or(deformer.wavelength);
  deformer.frequency_hz = table.number("frequency", kNotNegative).value_or(deformer.frequency_hz);
  table.warn_about_unknown_keys(warnings);
  return deformer;
}

FrameSequence read_frames(TomlTable& table, Assets& assets, Warnings& warnings) {
  FrameSequence sequence;
  sequence.frames_per_second = table.number("fps", kPositive).value_or(sequence.frames_per_second);
  const auto folder = table.text("folder");
  auto files = table.texts("files");
  if (folder.has_value() == files.has_value()) {
    table.fail("folder", "a frame sequence needs either 'folder' or 'files'");
  }
  const std::string place = table.place(folder ? "folder" : "files");
  if (folder) files = assets.frames_of_folder(*folder, place);
  if (files->empty()) table.fail("files", "'files' must name at least one file");
  if (files->size() > kMaxFrames) {
    table.fail("files", fmt::format("{} frames; the limit is {}", files->size(), kMaxFrames));
  }
  const std::size_t count = files->size();
  for (std::size_t i = 0; i < count; ++i) {
    const FramePart part(i, count);
    sequence.frames.push_back(assets.model((*files)[i], place, warnings));
  }
  table.warn_about_unknown_keys(warnings);
  return sequence;
}

/// The material of a model table: one of the file's by name, or written in place.
std::optional<Material> read_override(TomlTable& table, const NamedMaterials& materials,
                                      Assets& assets, Warnings& warnings) {
  if (!table.has("material")) return std::nullopt;
  if (!table.is_text("material")) {
    auto inner = table.table("material");
    return read_material(*inner, assets, warnings);
  }
  const std::string name = *table.text("material");
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& entry : materials) names.emplace_back(entry.first);
  table.fail("material",
             fmt::format("there is no material '{}'{}", name, did_you_mean(name, names)));
}

/// What a model table asks for, whatever its source.
struct Placing {
  std::string name;
  std::string place;
  std::optional<Material> material;
  std::optional<float> fit;
  glm::mat4 transform{1.0F};
  Motion motion;

  /// The transform with the fit, if any, before it.
  [[nodiscard]] glm::mat4 matrix(const Bounds& bounds) const {
    return fit ? transform * fit_matrix(bounds, *fit) : transform;
  }
  [[nodiscard]] const Material* own_material() const { return material ? &*material : nullptr; }
};

void add_generated(TomlTable& table, const Placing& placing, Assets& assets, Scene& scene) {
  const std::string name = *table.text("generator");
  const auto generated = assets.generated(name, table.place("generator"));
  const glm::mat4 matrix = placing.matrix(placing.fit ? bounds_at_start(*generated) : Bounds{});
  const bool moves = !std::holds_alternative<std::monostate>(placing.motion);
  for (const Instance& part : generated->instances) {
    Instance instance = part;
    const bool single = generated->instances.size() == 1;
    const std::string base = placing.name.empty() ? name : placing.name;
    instance.name = single ? base : fmt::format("{}/{}", base, part.name);
    if (std::holds_alternative<std::monostate>(part.motion)) {
      instance.transform = matrix * part.placement * part.transform;
      instance.placement = glm::mat4(1.0F);
      instance.motion = placing.motion;
    } else if (moves) {
      table.fail("generator",
                 fmt::format("'{}' moves by itself; it cannot be given another motion", name));
    } else {
      instance.placement = matrix * part.placement;
    }
    // A sample scene keeps its materials itself, the instance only says where they begin.
    const std::size_t end = scene.materials.size();
    assets.add(scene, std::move(instance), placing.own_material(), placing.place);
    if (placing.material) continue;
    for (std::size_t i = end; i < scene.materials.size(); ++i) {
      const std::size_t own = part.first_material + (i - end);
      if (own < generated->materials.size()) scene.materials[i] = generated->materials[own];
    }
  }
}

void add_file(TomlTable& table, Placing& placing, Assets& assets, Scene& scene) {
  const std::string file = *table.text("file");
  Instance instance;
  instance.model = assets.model(file, table.place("file"), scene.warnings);
  instance.name = placing.name.empty() ? std::filesystem::path(file).stem().string() : placing.name;
  instance.transform =
      placing.matrix(placing.fit ? bounds_under(instance.model->mesh, glm::mat4(1.0F)) : Bounds{});
  instance.motion = std::move(placing.motion);
  assets.add(scene, std::move(instance), placing.own_material(), placing.place);
}

void add_frames(TomlTable frames, Placing& placing, Assets& assets, Scene& scene) {
  if (!std::holds_alternative<std::monostate>(placing.motion)) {
    throw InputError(
        fmt::format("{}: a frame sequence cannot also have keys or a deformer", frames.place()));
  }
  FrameSequence sequence = read_frames(frames, assets, scene.warnings);
  Instance instance;
  instance.model = sequence.frames.front();
  instance.name = placing.name.empty() ? instance.model->name : placing.name;
  // One scale for the whole sequence, that of its first frame, or the model would pulse.
  instance.transform =
      placing.matrix(placing.fit ? bounds_under(instance.model->mesh, glm::mat4(1.0F)) : Bounds{});
  instance.motion = std::move(sequence);
  assets.add(scene, std::move(instance), placing.own_material(), placing.place);
}

}  // namespace

void read_model_table(TomlTable& table, const NamedMaterials& materials, Assets& assets,
                      Scene& scene) {
  const bool file = table.has("file");
  const bool generator = table.has("generator");
  const bool frames = table.has("frames");
  if (int(file) + int(generator) + int(frames) != 1) {
    throw InputError(fmt::format(
        "{}: a model needs exactly one of 'file', 'generator' and 'frames'", table.place()));
  }
  Placing placing;
  placing.place = table.place(file ? "file" : generator ? "generator" : "frames");
  placing.name = table.text("name").value_or("");
  placing.fit = table.number("fit", kPositive);
  placing.transform = read_transform(table, scene.warnings).matrix();
  placing.material = read_override(table, materials, assets, scene.warnings);

  // At most one motion.
  auto keys = table.tables("key");
  auto deform = table.table("deform");
  if (!keys.empty() && deform) table.fail("deform", "a model cannot have keys and a deformer");
  if (!keys.empty()) placing.motion = read_keys(keys, scene.warnings);
  if (deform) placing.motion = read_deformer(*deform, scene.warnings);

  if (file) {
    add_file(table, placing, assets, scene);
  } else if (generator) {
    add_generated(table, placing, assets, scene);
  } else {
    add_frames(*table.table("frames"), placing, assets, scene);
  }
  table.warn_about_unknown_keys(scene.warnings);
}

}  // namespace encore::scene
