#include "scene/ply_reader_faces.h"

#include "scene/load_watch.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

namespace encore::scene {

namespace {

constexpr std::size_t kBlock = 1U << 16U;

bool all_finite(std::span<const glm::vec3> positions) {
  // Without a branch for each coordinate: only infinity and NaN have all bits of the exponent.
  std::uint32_t bad = 0;
  for (const glm::vec3& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto bits = std::bit_cast<std::uint32_t>(p[axis]) & 0x7FFFFFFFU;
      bad |= bits >= 0x7F800000U ? 1U : 0U;
    }
  }
  return bad == 0;
}

/// Whether no triangle has to be dropped.
bool all_usable(const Mesh& mesh, std::span<const glm::uvec3> triangles) {
  if (!all_finite(mesh.positions)) return false;
  std::uint32_t largest = 0;
  for (std::size_t first = 0; first < triangles.size(); first += kBlock) {
    check_load();
    const std::size_t count = std::min(kBlock, triangles.size() - first);
    for (const glm::uvec3& t : triangles.subspan(first, count)) {
      largest = std::max(largest, std::max(t.x, std::max(t.y, t.z)));
    }
  }
  return triangles.empty() || largest < mesh.positions.size();
}

}  // namespace

void PlyFaces::add(std::span<const std::uint32_t> corners) {
  if (corners.size() == 3 && sizes_.empty()) {
    triangles_.emplace_back(corners[0], corners[1], corners[2]);
    return;
  }
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  sizes_.push_back(static_cast<std::uint32_t>(corners.size()));
}

void PlyFaces::add_strip(std::span<const std::uint32_t> strip) {
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const bool odd = i % 2 == 1;
    const std::uint32_t a = strip[i - (odd ? 1 : 2)];
    const std::uint32_t b = strip[i - (odd ? 2 : 1)];
    const std::uint32_t c = strip[i];
    if (a == b || b == c || c == a) continue;
    const std::uint32_t triangle[] = {a, b, c};
    add(triangle);
  }
}

Dropped PlyFaces::assemble(Mesh& mesh) {
  const std::size_t faces = triangles_.size() + sizes_.size();
  const std::size_t others = triangles_.size();
  PolygonAssembler assembler(mesh);
  std::size_t face = 0;
  const auto place = [&face] { return ": face " + std::to_string(face); };
  if (all_usable(mesh, triangles_)) {
    mesh.triangles = std::move(triangles_);
    face = others;
    mesh.triangles.reserve(faces);
  } else {
    mesh.triangles.reserve(faces);
    for (; face < others; ++face) {
      report_load(face, faces);
      const glm::uvec3& t = triangles_[face];
      const std::uint32_t corners[] = {t.x, t.y, t.z};
      assembler.add(corners, 0, place);
    }
  }
  std::size_t first = 0;
  for (; face < faces; ++face) {
    report_load(face, faces);
    const std::uint32_t size = sizes_[face - others];
    assembler.add(std::span(corners_).subspan(first, size), 0, place);
    first += size;
  }
  // All have the first material, which is what no list of them says too.
  mesh.material_of = {};
  return std::move(assembler.dropped);
}

}  // namespace encore::scene
