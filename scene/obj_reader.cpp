#include "scene/obj_reader.h"

#include "scene/load_watch.h"
#include "scene/model_cleanup.h"
#include "scene/model_index_table.h"
#include "scene/model_input.h"
#include "scene/model_number.h"
#include "scene/obj_reader_lines.h"
#include "scene/obj_reader_materials.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

namespace encore::scene {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;
constexpr std::uint32_t kBad = 0xFFFFFFFEU;

// Statements of the format beside those that are read; a file with none of all these is no OBJ.
constexpr std::string_view kOtherStatements[] = {
    "p",    "l",      "g",      "o",          "s",        "mg",    "vp",       "cstype",
    "deg",  "bmat",   "step",   "curv",       "curv2",    "surf",  "parm",     "trim",
    "hole", "scrv",   "sp",     "end",        "con",      "bevel", "c_interp", "d_interp",
    "lod",  "usemap", "maplib", "mtllib",     "fo",       "vw",    "t",        "call",
    "csh",  "ctech",  "stech",  "shadow_obj", "trace_obj"};

struct Corner {
  std::uint32_t position = kNone;
  std::uint32_t normal = kNone;
  std::uint32_t texcoord = kNone;
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct Face {
  std::uint32_t corners = 0;
  std::uint32_t material = 0;
  std::uint32_t line = 0;
};

// What the file states, gathered while tinyobjloader goes through it. Faces may name vertices that
// come after them, so nothing is put together before the end.
class ObjContent : public ObjLineFeed {
 public:
  ObjContent(std::string_view text, std::string source, std::filesystem::path folder,
             TextureSet& textures)
      : ObjLineFeed(text),
        source_(std::move(source)),
        materials_(std::move(folder), textures, warnings_) {}

  void parse();
  Model build();

 private:
  void on_other(std::string_view keyword, std::string_view arguments) override;
  void on_numbers(std::string_view keyword) override;
  void on_plain_face(std::span<const ObjCorner> corners) override;
  void on_vertex();
  void on_normal();
  void on_texcoord();
  void on_face(const tinyobj::index_t* corners, int count);
  void add_corner(int position, int texcoord, int normal);
  void add_face(std::size_t corners);
  std::size_t read_numbers(std::span<float> values);
  std::string place() const { return source_ + ":" + std::to_string(line()); }
  void make_vertices(Mesh& mesh, std::vector<std::uint32_t>& corner_vertices);

  std::string source_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<glm::vec2> texcoords_;
  std::vector<glm::vec3> colors_;
  std::vector<Corner> corners_;
  std::vector<Face> faces_;
  Warnings warnings_;
  ObjMaterials materials_;
  std::optional<std::uint32_t> material_;
  std::uint64_t points_ = 0;
  std::uint64_t lines_ = 0;
  std::uint64_t statements_ = 0;
  std::uint64_t unknown_ = 0;
  std::uint64_t missing_attributes_ = 0;
  std::string first_unknown_;
  std::string first_bad_number_;
};

// Reads up to values.size() numbers of the current statement and returns how many there were; what
// is no number becomes NaN, which drops the triangles around it.
std::size_t ObjContent::read_numbers(std::span<float> values) {
  std::string_view rest = arguments();
  std::size_t count = 0;
  while (count < values.size()) {
    if (take_plain_number(rest, values[count])) {
      ++count;
      continue;
    }
    const std::string_view token = take_token(rest);
    if (token.empty() || token.front() == '#') break;
    if (!parse_number(token, values[count])) {
      values[count] = std::numeric_limits<float>::quiet_NaN();
      if (first_bad_number_.empty()) {
        first_bad_number_ = place() + ": \"" + printable(token) + "\" is no number";
      }
    }
    ++count;
  }
  return count;
}

void ObjContent::on_vertex() {
  ++statements_;
  const float missing = std::numeric_limits<float>::quiet_NaN();
  float v[7] = {missing, missing, missing};
  const std::size_t count = read_numbers(v);
  positions_.emplace_back(v[0], v[1], v[2]);
  // Colours follow the position, or its weight if there are seven numbers.
  if (count >= 6) {
    colors_.resize(positions_.size() - 1, glm::vec3(1.0F));
    const std::size_t red = count == 7 ? 4 : 3;
    colors_.emplace_back(v[red], v[red + 1], v[red + 2]);
  }
}

void ObjContent::on_normal() {
  ++statements_;
  float n[3] = {};
  read_numbers(n);
  normals_.emplace_back(n[0], n[1], n[2]);
}

void ObjContent::on_texcoord() {
  ++statements_;
  float t[2] = {};
  read_numbers(t);
  texcoords_.emplace_back(t[0], t[1]);
}

// OBJ counts from 1, or with negative numbers backwards from the latest; 0 stands for none.
std::uint32_t resolve(int index, std::size_t count) {
  if (index > 0) return static_cast<std::uint32_t>(index) - 1;
  if (index == 0) return kNone;
  const std::int64_t from_start = static_cast<std::int64_t>(count) + index;
  return from_start >= 0 ? static_cast<std::uint32_t>(from_start) : kBad;
}

void ObjContent::add_corner(int position, int texcoord, int normal) {
  Corner corner;
  corner.position = resolve(position, positions_.size());
  corner.normal = resolve(normal, normals_.size());
  corner.texcoord = resolve(texcoord, texcoords_.size());
  corners_.push_back(corner);
}

void ObjContent::add_face(std::size_t corners) {
  ++statements_;
  // Faces before the first usemtl get a material of their own, without a name.
  if (!material_) material_ = materials_.use("", place());
  faces_.push_back({static_cast<std::uint32_t>(corners), *material_, line()});
}

void ObjContent::on_face(const tinyobj::index_t* corners, int count) {
  add_face(static_cast<std::size_t>(count));
  for (const tinyobj::index_t& c : std::span(corners, static_cast<std::size_t>(count))) {
    add_corner(c.vertex_index, c.texcoord_index, c.normal_index);
  }
}

void ObjContent::on_plain_face(std::span<const ObjCorner> corners) {
  add_face(corners.size());
  for (const ObjCorner& c : corners) add_corner(c.position, c.texcoord, c.normal);
}

void ObjContent::on_numbers(std::string_view keyword) {
  if (keyword == "v") {
    on_vertex();
  } else if (keyword == "vn") {
    on_normal();
  } else {
    on_texcoord();
  }
}

void ObjContent::on_other(std::string_view keyword, std::string_view arguments) {
  if (keyword == "mtllib") materials_.read_files(arguments, place());
  if (keyword == "p") {
    while (!take_token(arguments).empty()) ++points_;
  }
  if (keyword == "l") ++lines_;
  if (std::ranges::find(kOtherStatements, keyword) != std::end(kOtherStatements)) {
    ++statements_;
    return;
  }
  if (unknown_++ == 0) first_unknown_ = place() + ": \"" + printable(keyword) + "\"";
}

void ObjContent::parse() {
  tinyobj::callback_t callbacks;
  callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
    static_cast<ObjContent*>(self)->on_face(corners, count);
  };
  callbacks.usemtl_cb = [](void* self, const char* name, int) {
    auto* content = static_cast<ObjContent*>(self);
    ++content->statements_;
    content->material_ = content->materials_.use(name, content->place());
  };
  std::istream stream(this);
  // Streams swallow what a buffer throws (out of memory, say) unless asked to pass it on.
  stream.exceptions(std::ios::badbit);
  std::string warning;
  std::string error;
  tinyobj::LoadObjWithCallback(stream, callbacks, this, nullptr, &warning, &error);

  if (unknown_ > 0 && statements_ <= unknown_ / 4) {
    throw InputError(first_unknown_ + " is no OBJ statement, and nor is most of the file; " +
                     "is it a Wavefront OBJ file?");
  }
  if (unknown_ > 0) {
    warnings_.add(first_unknown_ + " is no OBJ statement; " + counted(unknown_, "line") +
                  " like this skipped");
  }
  if (!first_bad_number_.empty()) warnings_.add(first_bad_number_);
}

// One vertex for each combination of position, normal and texture coordinate that occurs, in the
// order of first use.
void ObjContent::make_vertices(Mesh& mesh, std::vector<std::uint32_t>& corner_vertices) {
  bool any_normal = false;
  bool any_texcoord = false;
  for (Corner& corner : corners_) {
    if (corner.normal != kNone && corner.normal >= normals_.size()) {
      corner.normal = kNone;
      ++missing_attributes_;
    }
    if (corner.texcoord != kNone && corner.texcoord >= texcoords_.size()) {
      corner.texcoord = kNone;
      ++missing_attributes_;
    }
    any_normal = any_normal || corner.normal != kNone;
    any_texcoord = any_texcoord || corner.texcoord != kNone;
  }

  const auto hash = [](const Corner& c) {
    return (std::uint64_t(c.position) * 0x9E3779B97F4A7C15ULL) ^
           (std::uint64_t(c.normal) * 0xC2B2AE3D27D4EB4FULL) ^
           (std::uint64_t(c.texcoord) * 0x165667B19E3779F9ULL);
  };
  IndexTable<Corner, decltype(hash)> vertices(hash);
  corner_vertices.reserve(corners_.size());
  for (const Corner& corner : corners_) {
    report_load(corner_vertices.size(), corners_.size());
    if (corner.position >= positions_.size()) {
      corner_vertices.push_back(kNoVertex);
      continue;
    }
    const auto [vertex, is_new] = vertices.insert(corner);
    corner_vertices.push_back(vertex);
    if (!is_new) continue;
    mesh.positions.push_back(positions_[corner.position]);
    if (!colors_.empty()) mesh.colors.push_back(colors_[corner.position]);
    if (any_normal) {
      mesh.normals.push_back(corner.normal == kNone ? glm::vec3(0.0F) : normals_[corner.normal]);
    }
    if (any_texcoord) {
      mesh.texcoords.push_back(corner.texcoord == kNone ? glm::vec2(0.0F)
                                                        : texcoords_[corner.texcoord]);
    }
  }
}

Model ObjContent::build() {
  if (!colors_.empty()) colors_.resize(positions_.size(), glm::vec3(1.0F));
  Model model;
  std::vector<std::uint32_t> vertices;
  in_load_part(0.0, 0.5, [&] { make_vertices(model.mesh, vertices); });

  const LoadPart part(0.5, 1.0);
  PolygonAssembler assembler(model.mesh);
  std::size_t first = 0;
  for (const Face& face : faces_) {
    report_load(static_cast<std::size_t>(&face - faces_.data()), faces_.size());
    assembler.add(std::span(vertices).subspan(first, face.corners), face.material,
                  [&face] { return std::string(":").append(std::to_string(face.line)); });
    first += face.corners;
  }
  model.materials = materials_.take(!model.mesh.texcoords.empty());
  model.warnings = std::move(warnings_);
  if (missing_attributes_ > 0) {
    model.warnings.add(source_ + ": " + counted(missing_attributes_, "corner") +
                       " without the normal or texture coordinate it names");
  }
  assembler.dropped.points = points_;
  assembler.dropped.lines = lines_;
  finish_model(model, source_, assembler.dropped);
  return model;
}

void reject_binary(std::string_view text, const std::string& source) {
  if (text.empty()) {
    throw InputError(source + ": the file is empty (0 bytes); get a whole copy of it");
  }
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw InputError(source + ": is UTF-16 text; save it as UTF-8 or ASCII");
  }
  // A few zero bytes are a quirk of some programs; many are other data, or UTF-16.
  const std::string_view head = text.substr(0, 1024);
  if (std::ranges::count(head, '\0') * 8 > static_cast<std::ptrdiff_t>(head.size())) {
    throw InputError(source + ": is a binary file, not OBJ text; check its type");
  }
}

}  // namespace

Model read_obj(std::string_view text, const std::string& name,
               const std::filesystem::path& mtl_folder, TextureSet* textures) {
  TextureSet own;
  reject_binary(text, name);
  // Editors may put a byte order mark in front.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  try {
    ObjContent content(text, name, mtl_folder, textures != nullptr ? *textures : own);
    in_load_part(0.0, 0.7, [&content] { content.parse(); });
    Model model = in_load_part(0.7, 1.0, [&content] { return content.build(); });
    model.name = name;
    return model;
  } catch (const std::length_error&) {
    throw InputError(name + ": more vertices than 32-bit indices can name; split the model");
  } catch (const std::bad_alloc&) {
    throw InputError(name + ": the model does not fit into memory; use a smaller one");
  }
}

Model read_obj(const std::filesystem::path& path, TextureSet* textures) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  Model model = read_obj(read_model_file(path), path.string(), folder, textures);
  model.name = path.stem().string();
  return model;
}

}  // namespace encore::scene
