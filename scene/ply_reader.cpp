#include "scene/ply_reader.h"

#include "scene/load_watch.h"
#include "scene/model_cleanup.h"
#include "scene/model_input.h"
#include "scene/ply_reader_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <vector>

namespace encore::scene {

namespace {

// Where a vertex property goes; the numbers index a row of floats.
enum Slot { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kRed, kGreen, kBlue, kU, kV, kSlots };
constexpr int kSkip = -1;

// Values of one list between two looks at whether the loading is to end.
constexpr std::uint64_t kLongList = 1U << 17U;

struct SlotName {
  std::string_view name;
  Slot slot;
};
constexpr SlotName kSlotNames[] = {{"x", kX},
                                   {"y", kY},
                                   {"z", kZ},
                                   {"nx", kNormalX},
                                   {"ny", kNormalY},
                                   {"nz", kNormalZ},
                                   {"red", kRed},
                                   {"green", kGreen},
                                   {"blue", kBlue},
                                   {"r", kRed},
                                   {"g", kGreen},
                                   {"b", kBlue},
                                   {"diffuse_red", kRed},
                                   {"diffuse_green", kGreen},
                                   {"diffuse_blue", kBlue},
                                   {"u", kU},
                                   {"v", kV},
                                   {"s", kU},
                                   {"t", kV},
                                   {"texture_u", kU},
                                   {"texture_v", kV}};

int slot_of(const PlyProperty& property) {
  if (property.is_list) return kSkip;
  for (const SlotName& known : kSlotNames) {
    if (known.name == property.name) return known.slot;
  }
  return kSkip;
}

// Colours of whole-number types count from 0 to the largest value, others from 0 to 1.
double color_scale(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return 1.0 / 127.0;
    case PlyType::uint8:
      return 1.0 / 255.0;
    case PlyType::int16:
      return 1.0 / 32767.0;
    case PlyType::uint16:
      return 1.0 / 65535.0;
    case PlyType::int32:
      return 1.0 / 2147483647.0;
    case PlyType::uint32:
      return 1.0 / 4294967295.0;
    default:
      return 1.0;
  }
}

std::uint32_t as_index(double value) {
  const bool whole = value >= 0.0 && value < 4294967295.0 && value == std::floor(value);
  return whole ? static_cast<std::uint32_t>(value) : kNoVertex;
}

// The list with the corners: by its usual names, else the only list there is.
int corner_list(const PlyElement& element) {
  int only = kSkip;
  int lists = 0;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (!property.is_list) continue;
    if (property.name == "vertex_indices" || property.name == "vertex_index") {
      return static_cast<int>(i);
    }
    only = static_cast<int>(i);
    ++lists;
  }
  return lists == 1 ? only : kSkip;
}

template <typename Values>
class PlyContent {
 public:
  PlyContent(const PlyHeader& header, Values values, const std::string& name)
      : header_(header), values_(values), name_(name), warnings_(header.warnings) {}

  Model read() {
    const auto kinds = static_cast<double>(std::max<std::size_t>(header_.elements.size(), 1));
    double kind = 0.0;
    for (const PlyElement& element : header_.elements) {
      const LoadPart part(0.7 * kind / kinds, 0.7 * (kind + 1.0) / kinds);
      kind += 1.0;
      check_size(element);
      if (element.name == "vertex" && mesh_.positions.empty()) {
        read_vertices(element);
      } else if (element.name == "face" || element.name == "tristrips") {
        read_corners(element, element.name == "tristrips");
      } else {
        skip(element);
      }
    }
    const LoadPart part(0.7, 1.0);
    return build();
  }

 private:
  // Refuses counts that the rest of the file cannot hold before anything is stored.
  void check_size(const PlyElement& element) const {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
      bytes += ply_size(property.is_list ? property.count_type : property.type);
    }
    const std::size_t values = std::max<std::size_t>(element.properties.size(), 1);
    const bool overflow = element.count > ~0ULL / values;
    const bool ascii = header_.format == PlyFormat::ascii;
    if (element.properties.empty()) return;
    if (overflow || !values_.can_hold(ascii ? element.count * values : element.count, bytes)) {
      throw InputError(values_.place() + ": the header declares " +
                       counted(element.count, printable(element.name) + " element") +
                       ", more than the file holds; it is truncated or damaged, get a whole copy");
    }
  }

  std::uint64_t list_length(const PlyProperty& property) {
    const double length = values_.read(property.count_type);
    if (!(length >= 0.0) || length != std::floor(length) || length > 4294967295.0 ||
        !values_.can_hold(static_cast<std::uint64_t>(length), ply_size(property.type))) {
      throw InputError(values_.place() + ": a list in the data has a length that the file cannot " +
                       "hold; it is truncated or damaged, get a whole copy");
    }
    return static_cast<std::uint64_t>(length);
  }

  void skip(const PlyProperty& property) {
    const std::uint64_t count = property.is_list ? list_length(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (i % kLongList == kLongList - 1) check_load();
      values_.read(property.type);
    }
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      report_load(i, element.count);
      for (const PlyProperty& property : element.properties) skip(property);
    }
  }

  void read_vertices(const PlyElement& element) {
    // Decide once where each property goes and what it is multiplied by.
    std::array<bool, kSlots> has{};
    std::vector<int> slots;
    std::vector<double> scales;
    for (const PlyProperty& property : element.properties) {
      const int slot = slot_of(property);
      slots.push_back(slot);
      scales.push_back(slot >= kRed && slot <= kBlue ? color_scale(property.type) : 1.0);
      if (slot != kSkip) has[static_cast<std::size_t>(slot)] = true;
    }
    if (element.count > 0 && !(has[kX] && has[kY] && has[kZ])) {
      throw InputError(name_ + ": the vertices have no x, y and z; export the model anew");
    }
    if (element.count >= kNoVertex) {
      throw InputError(name_ + ": more vertices than 32-bit indices can name; split the model");
    }
    const bool normals = has[kNormalX] && has[kNormalY] && has[kNormalZ];
    const bool colors = has[kRed] && has[kGreen] && has[kBlue];
    const bool texcoords = has[kU] && has[kV];

    if (element.properties.empty()) return;
    mesh_.positions.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      report_load(i, element.count);
      std::array<float, kSlots> row{};
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (slots[p] == kSkip) {
          skip(element.properties[p]);
        } else {
          const double value = values_.read(element.properties[p].type) * scales[p];
          row[static_cast<std::size_t>(slots[p])] = to_float(value);
        }
      }
      mesh_.positions.emplace_back(row[kX], row[kY], row[kZ]);
      if (normals) mesh_.normals.emplace_back(row[kNormalX], row[kNormalY], row[kNormalZ]);
      if (colors) mesh_.colors.emplace_back(row[kRed], row[kGreen], row[kBlue]);
      if (texcoords) mesh_.texcoords.emplace_back(row[kU], row[kV]);
    }
  }

  // A double beyond the range of floats is infinite as a float, which drops its triangles.
  static float to_float(double value) {
    if (std::abs(value) > 3.4028235677973366e38) {
      return value > 0.0 ? std::numeric_limits<float>::infinity()
                         : -std::numeric_limits<float>::infinity();
    }
    return static_cast<float>(value);
  }

  void read_corners(const PlyElement& element, bool strips) {
    const int list = corner_list(element);
    if (list == kSkip) {
      if (element.count > 0) {
        warnings_.add(name_ + ": " + element.name + " elements without vertex_indices skipped");
      }
      skip(element);
      return;
    }
    std::vector<std::uint32_t> corners;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      report_load(i, element.count);
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (static_cast<int>(p) != list) {
          skip(property);
          continue;
        }
        const std::uint64_t length = list_length(property);
        corners.clear();
        for (std::uint64_t k = 0; k < length; ++k) {
          if (k % kLongList == kLongList - 1) check_load();
          const double value = values_.read(property.type);
          // -1 ends a strip within the list; the next one starts to turn left anew.
          if (strips && value == -1.0) {
            add_strip(corners);
            corners.clear();
          } else {
            corners.push_back(as_index(value));
          }
        }
        if (strips) {
          add_strip(corners);
        } else {
          add_face(corners);
        }
      }
    }
  }

  void add_face(std::span<const std::uint32_t> corners) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    sizes_.push_back(static_cast<std::uint32_t>(corners.size()));
  }

  // Every second triangle of a strip turns the other way. Triangles with a repeated corner only
  // stitch strips together.
  void add_strip(std::span<const std::uint32_t> strip) {
    for (std::size_t i = 2; i < strip.size(); ++i) {
      const bool odd = i % 2 == 1;
      const std::uint32_t a = strip[i - (odd ? 1 : 2)];
      const std::uint32_t b = strip[i - (odd ? 2 : 1)];
      const std::uint32_t c = strip[i];
      if (a == b || b == c || c == a) continue;
      const std::uint32_t triangle[] = {a, b, c};
      add_face(triangle);
    }
  }

  // Faces may stand before the vertices, so they are cut into triangles only now.
  Model build() {
    Model model;
    model.name = name_;
    model.warnings = std::move(warnings_);
    if (!values_.at_end()) {
      model.warnings.add(values_.place() + ": data behind the last element is ignored");
    }
    const std::uint64_t vertices = mesh_.positions.size();
    model.mesh = std::move(mesh_);
    PolygonAssembler assembler(model.mesh);
    model.mesh.triangles.reserve(sizes_.size());
    std::size_t first = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      report_load(i, sizes_.size());
      assembler.add(std::span(corners_).subspan(first, sizes_[i]), 0,
                    [i] { return ": face " + std::to_string(i); });
      first += sizes_[i];
    }
    if (sizes_.empty()) assembler.dropped.points = vertices;
    finish_model(model, name_, assembler.dropped);
    return model;
  }

  const PlyHeader& header_;
  Values values_;
  const std::string& name_;
  Mesh mesh_;
  Warnings warnings_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> sizes_;
};

}  // namespace

Model read_ply(std::string_view file, const std::string& name) {
  try {
    const PlyHeader header = parse_ply_header(file, name);
    if (header.format == PlyFormat::ascii) {
      return PlyContent(header, PlyAsciiValues(file, header.data_begin, name), name).read();
    }
    const bool big = header.format == PlyFormat::big_endian;
    return PlyContent(header, PlyBinaryValues(file, header.data_begin, big, name), name).read();
  } catch (const std::bad_alloc&) {
    throw InputError(name + ": the model does not fit into memory; use a smaller one");
  }
}

}  // namespace encore::scene
