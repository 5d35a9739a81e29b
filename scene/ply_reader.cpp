#include "scene/ply_reader.h"

#include "scene/load_watch.h"
#include "scene/model_cleanup.h"
#include "scene/model_input.h"
#include "scene/ply_reader_faces.h"
#include "scene/ply_reader_values.h"
#include "scene/ply_reader_vertices.h"

#include <algorithm>
#include <new>
#include <optional>
#include <vector>

namespace encore::scene {

namespace {

// Values of one list between two looks at whether the loading is to end.
constexpr std::uint64_t kLongList = 1U << 17U;

// Rows between two looks.
constexpr std::uint64_t kRowsAtOnce = 4096;

constexpr int kSkip = -1;

std::uint32_t as_index(double value) {
  if (!(value >= 0.0 && value < 4294967295.0)) return kNoVertex;
  const auto index = static_cast<std::uint32_t>(value);
  return static_cast<double>(index) == value ? index : kNoVertex;
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

// What faces have around the only list that they may have; nothing if there are several.
std::optional<PlyFaceShape> face_shape(const PlyElement& element, int list) {
  PlyFaceShape shape;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (static_cast<int>(i) == list) {
      shape.count_type = property.count_type;
      shape.corner_type = property.type;
    } else if (property.is_list) {
      return std::nullopt;
    } else {
      (static_cast<int>(i) < list ? shape.before : shape.behind) += ply_size(property.type);
    }
  }
  return shape;
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
    const bool in_range = length >= 0.0 && length <= 4294967295.0;
    const std::uint64_t whole = in_range ? static_cast<std::uint64_t>(length) : 0;
    if (!in_range || static_cast<double>(whole) != length ||
        !values_.can_hold(whole, ply_size(property.type))) {
      throw InputError(values_.place() + ": a list in the data has a length that the file cannot " +
                       "hold; it is truncated or damaged, get a whole copy");
    }
    return whole;
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
    const PlyVertexLayout layout = ply_vertex_layout(element);
    if (element.count > 0 && !layout.positions) {
      throw InputError(name_ + ": the vertices have no x, y and z; export the model anew");
    }
    if (element.count >= kNoVertex) {
      throw InputError(name_ + ": more vertices than 32-bit indices can name; split the model");
    }
    if (element.properties.empty()) return;
    mesh_.positions.reserve(element.count);
    if constexpr (Values::kHasRows) {
      if (!layout.has_lists) return read_rows(element, layout);
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      report_load(i, element.count);
      PlyRow row{};
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyColumn& column = layout.columns[p];
        if (column.slot == kPlySkip) {
          skip(element.properties[p]);
        } else {
          const double value = values_.read(column.type) * column.scale;
          row[static_cast<std::size_t>(column.slot)] = ply_float(value);
        }
      }
      add_ply_vertex(row, layout, mesh_);
    }
  }

  // check_size has seen that all rows are there.
  void read_rows(const PlyElement& element, const PlyVertexLayout& layout) {
    for (std::uint64_t i = 0; i < element.count; i += kRowsAtOnce) {
      report_load(i, element.count);
      const std::uint64_t rows = std::min(kRowsAtOnce, element.count - i);
      add_ply_rows(values_.take_rows(rows * layout.row_bytes), layout, values_.swapped(), mesh_);
    }
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
    const std::optional<PlyFaceShape> shape = strips ? std::nullopt : face_shape(element, list);
    if (shape) expect_triangles(element.count, *shape);
    for (std::uint64_t i = 0; i < element.count;) {
      if (i % kRowsAtOnce == 0) report_load(i, element.count);
      if (shape) {
        const std::uint64_t triangles = take_triangles(*shape, i, element.count);
        i += triangles;
        if (triangles > 0) continue;
      }
      read_face(element, list, strips);
      ++i;
    }
  }

  // Room for that many triangles if the file can hold them.
  void expect_triangles(std::uint64_t count, const PlyFaceShape& shape) {
    const bool ascii = header_.format == PlyFormat::ascii;
    const std::size_t bytes = ply_size(shape.count_type) + 3 * ply_size(shape.corner_type);
    std::vector<glm::uvec3>* const triangles = faces_.triangles_only();
    if (triangles != nullptr && values_.can_hold(ascii ? 4 * count : count, bytes)) {
      triangles->reserve(triangles->size() + count);
    }
  }

  // As many triangles at once as lie before the next report.
  std::uint64_t take_triangles(const PlyFaceShape& shape, std::uint64_t face, std::uint64_t count) {
    if constexpr (Values::kHasRows) {
      std::vector<glm::uvec3>* const triangles = faces_.triangles_only();
      const std::uint64_t most = std::min(kRowsAtOnce - face % kRowsAtOnce, count - face);
      if (triangles != nullptr) return values_.take_triangles(shape, most, *triangles);
    }
    return 0;
  }

  void read_face(const PlyElement& element, int list, bool strips) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (static_cast<int>(p) != list) {
        skip(property);
        continue;
      }
      const std::uint64_t length = list_length(property);
      corners_.clear();
      for (std::uint64_t k = 0; k < length; ++k) {
        if (k % kLongList == kLongList - 1) check_load();
        const double value = values_.read(property.type);
        // -1 ends a strip within the list; the next one starts to turn left anew.
        if (strips && value == -1.0) {
          faces_.add_strip(corners_);
          corners_.clear();
        } else {
          corners_.push_back(as_index(value));
        }
      }
      if (strips) {
        faces_.add_strip(corners_);
      } else {
        faces_.add(corners_);
      }
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
    const bool faces = !faces_.empty();
    Dropped dropped = faces_.assemble(model.mesh);
    if (!faces) dropped.points = vertices;
    finish_model(model, name_, dropped);
    return model;
  }

  const PlyHeader& header_;
  Values values_;
  const std::string& name_;
  Mesh mesh_;
  Warnings warnings_;
  PlyFaces faces_;
  std::vector<std::uint32_t> corners_;  // of the present face
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
