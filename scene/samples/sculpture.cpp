#include "scene/samples/sculpture.h"

#include "scene/load_watch.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/refine.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace encore::scene::samples {

namespace {

// About what share of the work is done when the surface is sampled, and, of the rest, when it has
// all its triangles (load_watch.h).
constexpr double kSampled = 0.3;
constexpr double kSplit = 0.3;

/// Distances on the corners of a lattice.
struct Lattice {
  Vec origin;
  double cell;
  glm::ivec3 corners;
  std::vector<float> values;

  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return std::size_t(x) +
           std::size_t(corners.x) * (std::size_t(y) + std::size_t(corners.y) * std::size_t(z));
  }
};

/// Minimum with a rounded seam: equals the smaller one wherever they differ by `k` or more.
double smooth_min(double a, double b, double k) {
  const double overlap = k - std::abs(a - b);
  const double rounding = overlap > 0.0 ? overlap * overlap / (4.0 * k) : 0.0;
  return std::min(a, b) - rounding;
}

/// First-order distance to an ellipsoid around the origin: the implicit function divided by the
/// length of its slope.
double ellipsoid_distance(const Vec& p, const Vec& radii) {
  const Vec q(p.x / radii.x, p.y / radii.y, p.z / radii.z);
  const Vec slope(q.x / radii.x, q.y / radii.y, q.z / radii.z);
  const double k = length(q);
  const double s = length(slope);
  if (s <= 0.0) return -std::min(radii.x, std::min(radii.y, radii.z));
  return k * (k - 1.0) / s;
}

double limb_distance(const Vec& p, const PathPoint& a, const PathPoint& b) {
  const Vec along = b.position - a.position;
  const Vec d = p - a.position;
  const double t = clamp(dot(d, along) / std::max(dot(along, along), 1e-12), 0.0, 1.0);
  return length(d - along * t) - mix(a.radius, b.radius, t);
}

/// Calls visit(x, y, z, mask) for every cell that the surface crosses; bit c of the mask says
/// whether corner c is inside, and bit k of a corner's number is its step along axis k.
template <class Visit>
void each_crossed_cell(const Lattice& lattice, const Visit& visit) {
  for (int z = 0; z + 1 < lattice.corners.z; ++z) {
    for (int y = 0; y + 1 < lattice.corners.y; ++y) {
      const float* rows[4] = {&lattice.values[lattice.index(0, y, z)],
                              &lattice.values[lattice.index(0, y + 1, z)],
                              &lattice.values[lattice.index(0, y, z + 1)],
                              &lattice.values[lattice.index(0, y + 1, z + 1)]};
      // Going along x, the upper half of one cell's corners is the lower half of the next one's.
      const auto column = [&](int x) {
        unsigned bits = 0;
        for (unsigned row = 0; row < 4; ++row) bits |= unsigned(rows[row][x] < 0.0F) << (2 * row);
        return bits;
      };
      unsigned low = column(0);
      for (int x = 0; x + 1 < lattice.corners.x; ++x) {
        const unsigned high = column(x + 1);
        const unsigned mask = low | high << 1U;
        if (mask != 0 && mask != 255) visit(x, y, z, mask);
        low = high;
      }
    }
  }
}

/// Whether a cell's corners touch only along a diagonal: across one of its faces, or through it.
bool pinched(unsigned mask) {
  static constexpr unsigned kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  const auto inside = [mask](unsigned corner) { return (mask >> corner & 1U) != 0; };
  for (const auto& f : kFaces) {
    if (inside(f[0]) == inside(f[2]) && inside(f[1]) == inside(f[3]) &&
        inside(f[0]) != inside(f[1])) {
      return true;
    }
  }
  for (unsigned corner = 0; corner < 4; ++corner) {
    const unsigned diagonal = 1U << corner | 1U << (7 - corner);
    if (mask == diagonal || mask == (255U ^ diagonal)) return true;
  }
  return false;
}

/// Fills pinched cells until there are none. The surface is the boundary of the cubes around the
/// inner corners, moved; without pinches that boundary is a manifold (Latecki's well-composed
/// sets, 1995), so every edge of the mesh has exactly two triangles.
void fill_pinches(Lattice& lattice) {
  bool changed = true;
  while (changed) {
    std::vector<std::size_t> filled;
    each_crossed_cell(lattice, [&](int x, int y, int z, unsigned mask) {
      if (!pinched(mask)) return;
      // The outer corner nearest to the surface moves it least.
      std::size_t best = lattice.index(x, y, z);
      float distance = std::numeric_limits<float>::infinity();
      for (int c = 0; c < 8; ++c) {
        const std::size_t i = lattice.index(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
        if (lattice.values[i] < 0.0F || lattice.values[i] >= distance) continue;
        best = i;
        distance = lattice.values[i];
      }
      filled.push_back(best);
    });
    for (const std::size_t i : filled) lattice.values[i] = float(-0.05 * lattice.cell);
    changed = !filled.empty();
  }
}

/// One vertex in every cell that the surface crosses, at the mean of the points where its edges
/// cross. Returns the vertex of each cell.
std::vector<std::uint32_t> place_vertices(const Lattice& lattice, Mesh& mesh) {
  std::vector<std::uint32_t> vertex_of(lattice.values.size(), 0);
  // The twelve edges of a cell as pairs of corners.
  static constexpr int kEdges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                        {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  each_crossed_cell(lattice, [&](int x, int y, int z, unsigned mask) {
    double v[8];
    for (int c = 0; c < 8; ++c) {
      v[c] = lattice.values[lattice.index(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))];
    }
    Vec sum(0.0);
    int crossings = 0;
    for (const auto& [a, b] : kEdges) {
      if ((mask >> a & 1U) == (mask >> b & 1U)) continue;
      const Vec from(a & 1, a >> 1 & 1, a >> 2);
      const Vec to(b & 1, b >> 1 & 1, b >> 2);
      sum += mix(from, to, v[a] / (v[a] - v[b]));
      ++crossings;
    }
    const Vec local = Vec(x, y, z) + sum * (1.0 / crossings);
    vertex_of[lattice.index(x, y, z)] = std::uint32_t(mesh.positions.size());
    mesh.positions.push_back(narrow(lattice.origin + local * lattice.cell));
  });
  return vertex_of;
}

/// Two triangles for the quad a b c d, cut along the shorter diagonal.
void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const Vec ac = widen(mesh.positions[a]) - widen(mesh.positions[c]);
  const Vec bd = widen(mesh.positions[b]) - widen(mesh.positions[d]);
  if (dot(ac, ac) <= dot(bd, bd)) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  } else {
    mesh.triangles.emplace_back(a, b, d);
    mesh.triangles.emplace_back(b, c, d);
  }
}

/// A quad of the four cells around every lattice edge that the surface crosses.
void connect(const Lattice& lattice, const std::vector<std::uint32_t>& vertex_of, Mesh& mesh) {
  const std::size_t stride[3] = {lattice.index(1, 0, 0), lattice.index(0, 1, 0),
                                 lattice.index(0, 0, 1)};
  for (int z = 1; z + 1 < lattice.corners.z; ++z) {
    for (int y = 1; y + 1 < lattice.corners.y; ++y) {
      for (int x = 1; x + 1 < lattice.corners.x; ++x) {
        const std::size_t here = lattice.index(x, y, z);
        const bool inside = lattice.values[here] < 0.0F;
        for (int axis = 0; axis < 3; ++axis) {
          if (inside == (lattice.values[here + stride[axis]] < 0.0F)) continue;
          const std::size_t u = stride[(axis + 1) % 3];
          const std::size_t w = stride[(axis + 2) % 3];
          const std::uint32_t q[4] = {vertex_of[here - u - w], vertex_of[here - w], vertex_of[here],
                                      vertex_of[here - u]};
          // Counter-clockwise around the axis faces along it, which is outwards if we leave.
          if (inside) {
            add_quad(mesh, q[0], q[1], q[2], q[3]);
          } else {
            add_quad(mesh, q[3], q[2], q[1], q[0]);
          }
        }
      }
    }
  }
}

}  // namespace

void Sculpture::ellipsoid(const Frame& frame, const Vec& radii, double blend) {
  const double reach = std::max(radii.x, std::max(radii.y, radii.z));
  strokes_.push_back({frame.origin - Vec(reach), frame.origin + Vec(reach),
                      [=](const Vec& p) { return ellipsoid_distance(frame.local(p), radii); },
                      blend, false});
}

void Sculpture::ball(const Vec& center, double radius, double blend) {
  ellipsoid({center}, Vec(radius), blend);
}

void Sculpture::limb(const std::vector<PathPoint>& path, int pieces, double blend) {
  for (int i = 0; i < pieces; ++i) {
    const PathPoint a = on_path(path, double(i) / pieces);
    const PathPoint b = on_path(path, double(i + 1) / pieces);
    const Vec reach(std::max(a.radius, b.radius));
    const Vec low(std::min(a.position.x, b.position.x), std::min(a.position.y, b.position.y),
                  std::min(a.position.z, b.position.z));
    const Vec high(std::max(a.position.x, b.position.x), std::max(a.position.y, b.position.y),
                   std::max(a.position.z, b.position.z));
    // Pieces of one limb join without a seam; only its first one blends into what was there.
    const double seam = i == 0 ? blend : std::min(blend, 0.3 * std::min(a.radius, b.radius));
    strokes_.push_back({low - reach, high + reach,
                        [=](const Vec& p) { return limb_distance(p, a, b); }, seam, false});
  }
}

void Sculpture::carve_ellipsoid(const Frame& frame, const Vec& radii, double blend) {
  ellipsoid(frame, radii, blend);
  strokes_.back().carve = true;
}

void Sculpture::carve_disc(const Frame& frame, double radius, double half_height, double blend) {
  const Vec reach(radius + half_height);
  strokes_.push_back({frame.origin - reach, frame.origin + reach,
                      [=](const Vec& p) {
                        const Vec q = frame.local(p);
                        return std::max(std::sqrt(q.x * q.x + q.z * q.z) - radius,
                                        std::abs(q.y) - half_height);
                      },
                      blend, true});
}

Mesh Sculpture::surface(double cell) const {
  // The lattice covers all strokes that add something, and two cells more on every side.
  Vec low(1e9);
  Vec high(-1e9);
  for (const Stroke& s : strokes_) {
    if (s.carve) continue;
    const Vec rim(s.blend + 3.0 * cell);
    low = glm::min(low, s.low - rim);
    high = glm::max(high, s.high + rim);
  }
  Lattice lattice{low, cell, glm::ivec3(0), {}};
  for (int k = 0; k < 3; ++k) lattice.corners[k] = int((high[k] - low[k]) / cell) + 2;
  lattice.values.assign(std::size_t(lattice.corners.x) * std::size_t(lattice.corners.y) *
                            std::size_t(lattice.corners.z),
                        1e3F);
  for (const Stroke& s : strokes_) {
    // Beyond its box widened by the blend a stroke cannot move the surface, so only the corners in
    // there are visited.
    const Vec rim(s.blend + 2.0 * cell);
    glm::ivec3 first(0);
    glm::ivec3 last(0);
    for (int k = 0; k < 3; ++k) {
      first[k] = std::max(int((s.low[k] - rim[k] - low[k]) / cell), 0);
      last[k] = std::min(int((s.high[k] + rim[k] - low[k]) / cell) + 1, lattice.corners[k] - 1);
    }
    check_load();
    for (int z = first.z; z <= last.z; ++z) {
      for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
          float& value = lattice.values[lattice.index(x, y, z)];
          const double d = s.distance(low + Vec(x, y, z) * cell);
          value = float(s.carve ? -smooth_min(-value, d, s.blend) : smooth_min(value, d, s.blend));
        }
      }
    }
  }
  check_load();
  fill_pinches(lattice);
  Mesh mesh;
  const std::vector<std::uint32_t> vertex_of = place_vertices(lattice, mesh);
  connect(lattice, vertex_of, mesh);
  return mesh;
}

Mesh Sculpture::surface_of(std::size_t most) const {
  // The count goes with the inverse square of the cell, so a coarse first try tells a good cell
  // size; it is then corrected until the count is not above the wish.
  Vec low(1e9);
  Vec high(-1e9);
  for (const Stroke& s : strokes_) {
    low = glm::min(low, s.low);
    high = glm::max(high, s.high);
  }
  double cell = std::max(high.x - low.x, std::max(high.y - low.y, high.z - low.z)) / 48.0;
  for (int attempt = 0;; ++attempt) {
    Mesh mesh = surface(cell);
    const double ratio = double(mesh.triangles.size()) / double(most);
    if (ratio <= 1.0 && (ratio > 0.95 || attempt > 8)) return mesh;
    cell *= std::sqrt(ratio) * 1.006;
  }
}

void emboss(Mesh& mesh, const Relief& relief) {
  smooth_normals(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    report_load(i, mesh.positions.size());
    const Vec p = widen(mesh.positions[i]);
    const Vec n = widen(mesh.normals[i]);
    mesh.positions[i] = narrow(p + n * relief(p, n));
  }
}

Mesh finished(const Sculpture& sculpture, std::size_t target, int levels, const Relief& relief) {
  const std::size_t base = target >> std::size_t(2 * levels);
  Mesh sampled = sculpture.surface_of(base & ~std::size_t(1));
  const LoadPart rest(kSampled, 1.0);
  return finished(std::move(sampled), target, levels, relief);
}

Mesh finished(Mesh base, std::size_t target, int levels, const Relief& relief) {
  std::size_t wanted = target >> std::size_t(2 * levels);
  // A closed mesh can only take an even number; what is left over is split after subdividing.
  if (levels > 0 && (wanted - base.triangles.size()) % 2 != 0) --wanted;
  report_load(0.0);
  split_to(base, wanted);
  for (int i = 0; i < levels; ++i) {
    check_load();
    base = subdivide(base);
  }
  split_to(base, target);
  const LoadPart rest(kSplit, 1.0);
  if (relief) emboss(base, relief);
  check_load();
  smooth_normals(base);
  return base;
}

}  // namespace encore::scene::samples
