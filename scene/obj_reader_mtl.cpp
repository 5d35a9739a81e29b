#include "scene/obj_reader_mtl.h"

#include "scene/model_input.h"
#include "scene/model_number.h"
#include "scene/obj_reader_mtl_map.h"

#include <glm/common.hpp>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace encore::scene {

namespace {

constexpr std::string_view kStatements[] = {"Ka", "Kd", "Ks", "Ke", "Ns",
                                            "Ni", "Tf", "d",  "Tr", "illum"};

// The statements that are used, in the one spelling that the library takes. It would otherwise
// parse other maps that nobody needs here, and overflows on long exponents: numbers are read here
// and written plainly.
class MtlFilter {
 public:
  MtlFilter(const std::string& name, Warnings& warnings) : name_(name), warnings_(warnings) {}

  /// The texture that the library knows by this name: the filter names them by their numbers.
  [[nodiscard]] std::string texture(const std::string& number) const {
    std::size_t at = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), at);
    return error == std::errc{} && at < textures_.size() ? textures_[at] : std::string();
  }

  std::string run(std::string_view text) {
    std::size_t line = 0;
    while (!text.empty()) {
      ++line;
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      std::string_view statement = text.substr(0, end);
      const bool two = text.substr(end).starts_with("\r\n");
      text.remove_prefix(std::min(end + (two ? 2 : 1), text.size()));
      const std::string_view keyword = take_token(statement);
      if (keyword == "newmtl") {
        new_material(statement);
      } else if (std::ranges::find(kStatements, keyword) != std::end(kStatements)) {
        numbers(keyword, statement, line);
      } else if (keyword == "map_Kd") {
        texture(statement, line);
      }
    }
    return std::move(out_);
  }

 private:
  // States the defaults of Material first: a later statement overrides them, the library's own
  // defaults (all black) never show.
  void new_material(std::string_view name) {
    const std::size_t first = name.find_first_not_of(" \t");
    open_ = first != std::string_view::npos;
    has_diffuse_ = false;
    if (!open_) return;
    name = name.substr(first, name.find_last_not_of(" \t") - first + 1);
    const Material defaults;
    std::ostringstream text;
    text << "newmtl " << name << "\nKa " << defaults.ambient.x << ' ' << defaults.ambient.y << ' '
         << defaults.ambient.z << "\nKd " << defaults.diffuse.x << ' ' << defaults.diffuse.y << ' '
         << defaults.diffuse.z << "\nNs " << defaults.shininess << "\nillum "
         << defaults.illumination_model << "\nTf 1 1 1\n";
    out_ += text.str();
  }

  void texture(std::string_view arguments, std::size_t line) {
    if (!open_) return;
    const MtlMap map = parse_mtl_map(arguments);
    if (map.file.empty()) return;
    if (map.transformed && !std::exchange(told_, true)) {
      warnings_.add(name_ + ":" + std::to_string(line) +
                    ": offset, scale and turbulence of textures (-o, -s, -t) are left out");
    }
    if (!has_diffuse_) out_ += "Kd 0.6 0.6 0.6\n";
    out_ += "map_Kd " + std::to_string(textures_.size()) + '\n';
    textures_.emplace_back(map.file);
  }

  void numbers(std::string_view keyword, std::string_view arguments, std::size_t line) {
    if (!open_) return;
    std::vector<float> values;
    while (values.size() < 3) {
      float value = 0.0F;
      const std::string_view token = take_token(arguments);
      if (token.empty() || !parse_number(token, value)) break;
      values.push_back(value);
    }
    const auto finite = [](float value) { return std::isfinite(value) && std::abs(value) < 1e9F; };
    if (values.empty() || !std::ranges::all_of(values, finite)) {
      if (bad_++ == 0) {
        warnings_.add(name_ + ":" + std::to_string(line) + ": " + printable(keyword) +
                      " has no usable number; the default stays");
      }
      return;
    }
    if (keyword == "Kd") has_diffuse_ = true;
    // One number for a colour means grey.
    if (keyword.starts_with('K') || keyword == "Tf") values.resize(3, values.front());
    out_ += keyword;
    std::ostringstream text;
    text.precision(9);
    text << std::fixed;
    for (const float value : values) {
      text << ' ';
      if (keyword == "illum") {
        text << static_cast<int>(value);
      } else {
        text << value;
      }
    }
    out_ += text.str() + '\n';
  }

  const std::string& name_;
  Warnings& warnings_;
  std::string out_;
  std::vector<std::string> textures_;
  std::size_t bad_ = 0;
  bool open_ = false;
  bool has_diffuse_ = false;
  bool told_ = false;
};

glm::vec3 color(const tinyobj::real_t (&rgb)[3]) {
  return glm::vec3(std::max(rgb[0], 0.0F), std::max(rgb[1], 0.0F), std::max(rgb[2], 0.0F));
}

bool is_glass(int illumination) {
  return illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9;
}

MtlMaterial convert(const tinyobj::material_t& from) {
  MtlMaterial to;
  to.name = from.name;
  to.diffuse = color(from.diffuse);
  to.specular = color(from.specular);
  to.ambient = glm::min(color(from.ambient), glm::vec3(1.0F));
  to.emission = color(from.emission);
  to.shininess = std::max(from.shininess, 0.0F);
  to.opacity = std::clamp(from.dissolve, 0.0F, 1.0F);
  to.index_of_refraction = from.ior > 0.0F ? from.ior : 1.0F;
  to.illumination_model = from.illum;
  if (from.illum == 3 || from.illum == 5 || from.illum == 8) {
    to.reflectivity = std::min((to.specular.x + to.specular.y + to.specular.z) / 3.0F, 1.0F);
  }
  const glm::vec3 filter = color(from.transmittance);
  if (is_glass(from.illum) && to.opacity == 1.0F && filter != glm::vec3(0.0F)) to.opacity = 0.0F;
  return to;
}

}  // namespace

void read_mtl(std::string_view text, const std::string& name, MaterialsByName& materials,
              Warnings& warnings) {
  MtlFilter filter(name, warnings);
  std::istringstream clean(filter.run(text));
  clean.imbue(std::locale::classic());
  std::map<std::string, int> indices;
  std::vector<tinyobj::material_t> read;
  std::string warning;
  std::string error;
  tinyobj::LoadMtl(&indices, &read, &clean, &warning, &error);

  bool any = false;
  for (const tinyobj::material_t& material : read) {
    // The library ends its list with a nameless material if the file holds none.
    if (material.name.empty()) continue;
    any = true;
    MtlMaterial converted = convert(material);
    converted.file = name;
    if (!material.diffuse_texname.empty()) {
      converted.texture = filter.texture(material.diffuse_texname);
    }
    materials.try_emplace(material.name, std::move(converted));
  }
  if (!any) warnings.add(name + ": holds no materials");
}

}  // namespace encore::scene
