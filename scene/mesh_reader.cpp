#include "scene/mesh_reader.h"

#include "scene/assimp_reader.h"
#include "scene/load_watch.h"
#include "scene/model_child_process.h"
#include "scene/model_input.h"
#include "scene/model_sniff.h"
#include "scene/obj_reader.h"
#include "scene/ply_reader.h"

#include <algorithm>
#include <new>

namespace encore::scene {

namespace {

constexpr std::string_view kExtensions[] = {
    ".obj", ".ply",     ".3ds",  ".gltf", ".glb", ".stl",  ".off", ".dae", ".zae",
    ".fbx", ".x",       ".ase",  ".ac",   ".acc", ".lwo",  ".lxo", ".dxf", ".3mf",
    ".amf", ".blend",   ".b3d",  ".x3d",  ".cob", ".ms3d", ".md2", ".mdc", ".iqm",
    ".nff", ".md5mesh", ".ogex", ".q3o",  ".q3s", ".smd",  ".xgl", ".zgl", ".ifc"};

bool is_supported(std::string_view extension) {
  return std::ranges::find(kExtensions, extension) != std::end(kExtensions);
}

std::string all_extensions() {
  std::string list;
  for (const std::string_view extension : kExtensions) list += " " + std::string(extension);
  return list;
}

// Generous for every file that is what it seems (Assimp's own test models take 40 times their size
// at most, beyond a fixed 100 MiB for those that subdivide), tight against those that are not.
ChildLimits limits_for(std::uint64_t bytes) {
  constexpr std::uint64_t kMebibyte = 1ULL << 20U;
  ChildLimits limits;
  limits.memory_bytes = 256 * kMebibyte + 48 * bytes;
  limits.cpu_seconds =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(6 + bytes / kMebibyte, 600));
  // Waiting counts here, and a busy machine makes everything wait.
  limits.wall_seconds = 20 + 10 * limits.cpu_seconds;
  return limits;
}

[[noreturn]] void fail(const std::string& name, ChildResult::Outcome outcome) {
  using Outcome = ChildResult::Outcome;
  std::string what = ": the file is damaged: the importer crashed on it; export the model anew";
  if (outcome == Outcome::out_of_memory) {
    what = ": the importer wanted far more memory than a file of this size needs; the file is " +
           std::string("damaged or extreme, export the model anew");
  }
  if (outcome == Outcome::out_of_time) {
    what =
        ": the importer did not finish in time; the file is damaged or extreme, convert it to PLY";
  }
  if (outcome == Outcome::not_started) {
    what = ": no process could be started to read it; free some memory or convert it to PLY";
  }
  throw InputError(name + what);
}

/// The textures that an imported model names; an empty folder means that none is looked up.
void load_textures(PackedModel& packed, const std::string& name,
                   const std::filesystem::path& folder, TextureSet& textures) {
  if (packed.model.mesh.texcoords.empty()) return;
  Warnings& warnings = packed.model.warnings;
  if (packed.embedded_textures > 0) {
    warnings.add(name + ": " + counted(packed.embedded_textures, "texture") +
                 " within the model file left out; save textures as files of their own");
  }
  const std::size_t count = std::min(packed.textures.size(), packed.model.materials.size());
  for (std::size_t i = 0; i < count && !folder.empty(); ++i) {
    if (packed.textures[i].empty()) continue;
    Material& material = packed.model.materials[i];
    material.diffuse_texture =
        textures.load(packed.textures[i], folder, name, material.name, warnings);
  }
}

/// Where an imported model's textures come from.
struct TextureSource {
  std::filesystem::path folder;  ///< empty: none is looked up
  TextureSet& set;
};

Model import_guarded(const std::function<PackedModel()>& import, std::uint64_t bytes,
                     const std::string& name, const TextureSource& textures) {
  using Outcome = ChildResult::Outcome;
  PackedModel packed;
  report_load(0.0);
  try {
    const ChildResult result =
        run_in_child([&import] { return pack_model(import()); }, limits_for(bytes));
    if (result.outcome == Outcome::cancelled) throw LoadCancelled();
    if (result.outcome != Outcome::finished) fail(name, result.outcome);
    report_load(0.8);
    if (!unpack_model(result.bytes, packed)) fail(name, Outcome::crashed);
  } catch (const std::bad_alloc&) {
    throw InputError(name + ": the model does not fit into memory; use a smaller one");
  }
  if (packed.error.find("bad_alloc") != std::string::npos) fail(name, Outcome::out_of_memory);
  if (!packed.error.empty()) {
    throw InputError(name + ": cannot be read (" + printable(packed.error, 200) +
                     "); the file is damaged or of another format");
  }

  report_load(0.9);
  // What a crashing library could have left in a damaged state is checked like a file.
  const auto& positions = packed.model.mesh.positions;
  for (const glm::uvec3& t : packed.model.mesh.triangles) {
    if (std::max({t.x, t.y, t.z}) >= positions.size()) fail(name, Outcome::crashed);
  }
  const auto fits = [&positions](std::size_t n) { return n == 0 || n == positions.size(); };
  const Mesh& mesh = packed.model.mesh;
  if (!fits(mesh.normals.size()) || !fits(mesh.texcoords.size()) || !fits(mesh.colors.size()) ||
      mesh.material_of.size() != mesh.triangles.size()) {
    fail(name, Outcome::crashed);
  }
  finish_model(packed.model, name, packed.dropped);
  load_textures(packed, name, textures.folder, textures.set);
  packed.model.name = name;
  return std::move(packed.model);
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Content rules over the name, except that a signature shared by a family keeps the name's member.
std::string pick_extension(const std::string& by_name, const std::string& by_content) {
  if (by_content.empty() || (by_content == ".ac" && by_name == ".acc")) return by_name;
  return by_content;
}

void reject_unknown(std::string_view bytes, const std::string& extension, const std::string& name) {
  if (is_supported(extension)) return;
  if (bytes.starts_with("\x1F\x8B") || bytes.starts_with("PK\x03\x04")) {
    throw InputError(name + ": is compressed; unpack it first");
  }
  throw InputError(name + ": not a model format that is known, by neither content nor extension; " +
                   "known are" + all_extensions());
}

Model import_bytes(std::span<const std::byte> bytes, const std::string& extension,
                   const std::string& name, const TextureSource& textures) {
  if (bytes.empty()) {
    throw InputError(name + ": the file is empty (0 bytes); get a whole copy of it");
  }
  const std::string lower = lower_extension("name" + extension);
  if (lower == ".ply") return read_ply(as_text(bytes), name);
  if (lower == ".obj") return read_obj(as_text(bytes), name, {});
  reject_unknown(as_text(bytes), lower, name);
  return import_guarded([&] { return import_with_assimp(as_text(bytes), lower); }, bytes.size(),
                        name, textures);
}

}  // namespace

Model read_model(const std::filesystem::path& path, TextureSet* textures) {
  const std::string name = path.string();
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  TextureSet own;
  TextureSet& set = textures != nullptr ? *textures : own;
  note_load(path.filename().string());
  std::string bytes = in_load_part(0.0, 0.1, [&path] { return read_model_file(path); });
  const LoadPart part(0.1, 1.0);
  const std::string by_name = lower_extension(path);
  const std::string by_content = sniff_extension(bytes);
  const std::string extension = pick_extension(by_name, by_content);
  reject_unknown(bytes, extension, name);

  Model model;
  if (extension == ".obj") {
    model = read_obj(bytes, name, folder, &set);
  } else if (extension == by_name && extension != ".ply") {
    // By path, so that the importer finds the files that this one refers to.
    const std::uint64_t size = bytes.size();
    bytes = {};
    model = import_guarded([&path] { return import_with_assimp(path); }, size, name, {folder, set});
  } else {
    model = import_bytes(std::as_bytes(std::span(bytes)), extension, name, {folder, set});
  }
  if (!by_name.empty() && extension != by_name) {
    model.warnings.add(name + ": named " + by_name + " but holds " + extension + "; read as " +
                       extension);
  }
  model.name = path.stem().string();
  return model;
}

Model read_with_assimp(std::span<const std::byte> bytes, const std::string& extension,
                       const std::string& name) {
  TextureSet none;
  return import_bytes(bytes, extension, name, {{}, none});
}

std::vector<std::string> supported_extensions() {
  return {std::begin(kExtensions), std::end(kExtensions)};
}

}  // namespace encore::scene
