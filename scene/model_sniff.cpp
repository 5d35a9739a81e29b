#include "scene/model_sniff.h"

#include "scene/model_number.h"
#include "scene/ply_reader.h"

#include <algorithm>
#include <cstdint>

namespace encore::scene {

namespace {

struct Signature {
  std::string_view start;
  std::string_view extension;
};
constexpr Signature kSignatures[] = {{"glTF", ".glb"},       {"Kaydara FBX Binary", ".fbx"},
                                     {"BLENDER", ".blend"},  {"xof 0", ".x"},
                                     {"AC3Db", ".ac"},       {"*3DSMAX_ASCIIEXPORT", ".ase"},
                                     {"OFF\n", ".off"},      {"OFF\r", ".off"},
                                     {"COFF\n", ".off"},     {"NOFF\n", ".off"},
                                     {"MS3D000000", ".ms3d"}};

constexpr Signature kXmlRoots[] = {{"<COLLADA", ".dae"}, {"<X3D", ".x3d"}, {"<amf", ".amf"}};

std::uint32_t little_endian_at(std::string_view file, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i > 0; --i) {
    value = value << 8U | static_cast<unsigned char>(file[at + i - 1]);
  }
  return value;
}

// The main chunk holds the whole file: its length fits, and a known chunk comes first in it.
bool is_3ds(std::string_view file) {
  if (file.size() < 12 || !file.starts_with("MM")) return false;
  const std::uint32_t length = little_endian_at(file, 2);
  return length > 6 && length <= file.size() && little_endian_at(file, 8) <= length;
}

bool is_stl(std::string_view file) {
  if (file.starts_with("solid") && file.substr(0, 4096).find("facet") != std::string_view::npos) {
    return true;
  }
  return file.size() >= 84 &&
         file.size() == 84 + 50 * static_cast<std::uint64_t>(little_endian_at(file, 80));
}

// Text whose first statements are all OBJ's, with a vertex of three numbers among them.
bool is_obj(std::string_view file) {
  constexpr std::string_view kKeywords[] = {"v", "vn", "vt",     "vp",     "f", "g",
                                            "o", "s",  "usemtl", "mtllib", "l", "p"};
  std::string_view rest = file.substr(0, 65536);
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  if (rest.find('\0') != std::string_view::npos) return false;
  bool vertex = false;
  for (int statements = 0; statements < 64 && !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::string_view keyword = take_token(line);
    if (keyword.empty() || keyword.front() == '#') continue;
    if (std::ranges::find(kKeywords, keyword) == std::end(kKeywords)) return false;
    float number = 0.0F;
    int numbers = 0;
    while (keyword == "v" && numbers < 3 && parse_number(take_token(line), number)) ++numbers;
    vertex = vertex || numbers == 3;
    ++statements;
  }
  return vertex;
}

}  // namespace

std::string sniff_extension(std::string_view file) {
  if (is_ply(file)) return ".ply";
  for (const Signature& known : kSignatures) {
    if (file.starts_with(known.start)) return std::string(known.extension);
  }
  if (file.starts_with("FORM") && file.size() >= 12) {
    const std::string_view kind = file.substr(8, 4);
    if (kind == "LWOB" || kind == "LWO2") return ".lwo";
  }
  if (is_3ds(file)) return ".3ds";
  if (is_stl(file)) return ".stl";
  const std::string_view head = file.substr(0, 4096);
  const std::size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first != std::string_view::npos && head[first] == '<') {
    for (const Signature& root : kXmlRoots) {
      if (head.find(root.start) != std::string_view::npos) return std::string(root.extension);
    }
  }
  if (first != std::string_view::npos && head[first] == '{' &&
      file.find("\"asset\"") != std::string_view::npos) {
    return ".gltf";
  }
  return is_obj(file) ? ".obj" : "";
}

}  // namespace encore::scene
