#include "scene/samples/shapes.h"

#include "scene/samples/mesh_tools.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace encore::scene::samples {

namespace {

/// Catmull-Rom between b and c.
template <class T>
T spline(const T& a, const T& b, const T& c, const T& d, double t) {
  const T linear = (c - a) * (0.5 * t);
  const T square = (a * 2.0 - b * 5.0 + c * 4.0 - d) * (0.5 * (t * t));
  const T cube = (b * 3.0 - a - c * 3.0 + d) * (0.5 * (t * t * t));
  return b + linear + square + cube;
}

/// A fan that closes the ring of `sides` vertices starting at `ring` with the vertex `pole`.
void close_with_pole(Mesh& mesh, std::uint32_t ring, std::uint32_t pole, int sides, bool top) {
  for (int i = 0; i < sides; ++i) {
    const std::uint32_t a = ring + std::uint32_t(i);
    const std::uint32_t b = ring + std::uint32_t((i + 1) % sides);
    mesh.triangles.push_back(top ? glm::uvec3(b, a, pole) : glm::uvec3(a, b, pole));
  }
}

/// Rings from bottom to top around the y axis, closed by the first and last profile point.
Mesh turned(const std::vector<ProfilePoint>& rings, int sides) {
  Mesh mesh;
  for (std::size_t j = 1; j + 1 < rings.size(); ++j) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * kPi * i / sides;
      mesh.positions.push_back(narrow({rings[j].radius * portable_cos(angle), rings[j].height,
                                       rings[j].radius * portable_sin(angle)}));
    }
  }
  const auto ring_count = std::uint32_t(rings.size() - 2);
  const auto n = std::uint32_t(sides);
  for (std::uint32_t j = 0; j + 1 < ring_count; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * n + i;
      const std::uint32_t b = j * n + (i + 1) % n;
      mesh.triangles.emplace_back(a, a + n, b);
      mesh.triangles.emplace_back(b, a + n, b + n);
    }
  }
  const auto bottom = std::uint32_t(mesh.positions.size());
  mesh.positions.push_back(narrow({0.0, rings.front().height, 0.0}));
  mesh.positions.push_back(narrow({0.0, rings.back().height, 0.0}));
  close_with_pole(mesh, 0, bottom, sides, false);
  close_with_pole(mesh, (ring_count - 1) * n, bottom + 1, sides, true);
  return mesh;
}

}  // namespace

Mesh uv_grid(int columns, int rows, bool wrap_u, bool wrap_v,
             const std::function<Vec(double, double)>& point) {
  Mesh mesh;
  const int across = wrap_u ? columns : columns + 1;
  const int along = wrap_v ? rows : rows + 1;
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < across; ++i) {
      mesh.positions.push_back(narrow(point(double(i) / columns, double(j) / rows)));
    }
  }
  const auto index = [&](int i, int j) { return std::uint32_t((j % along) * across + i % across); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.emplace_back(index(i, j), index(i + 1, j), index(i + 1, j + 1));
      mesh.triangles.emplace_back(index(i, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  return mesh;
}

Mesh ball(double radius, int sides, int stacks) {
  std::vector<ProfilePoint> rings;
  for (int j = 0; j <= stacks; ++j) {
    const double angle = kPi * j / stacks;
    rings.push_back({radius * portable_sin(angle), -radius * portable_cos(angle)});
  }
  return turned(rings, sides);
}

Mesh torus(double major_radius, double minor_radius, int around, int across) {
  return uv_grid(around, across, true, true, [&](double u, double v) {
    const double out = major_radius + minor_radius * portable_cos(2.0 * kPi * v);
    return Vec(out * portable_cos(2.0 * kPi * u), -minor_radius * portable_sin(2.0 * kPi * v),
               out * portable_sin(2.0 * kPi * u));
  });
}

Mesh lathe(const std::vector<ProfilePoint>& profile, int sides, int stacks) {
  std::vector<PathPoint> path;
  for (const ProfilePoint& p : profile) path.push_back({{0.0, p.height, 0.0}, p.radius});
  std::vector<ProfilePoint> rings;
  for (int j = 0; j <= stacks; ++j) {
    const PathPoint p = on_path(path, double(j) / stacks);
    rings.push_back({std::max(p.radius, 0.0), p.position.y});
  }
  return turned(rings, sides);
}

PathPoint on_path(const std::vector<PathPoint>& path, double t) {
  const double scaled = clamp(t, 0.0, 1.0) * double(path.size() - 1);
  const std::size_t i = std::min(std::size_t(scaled), path.size() - 2);
  const PathPoint& a = path[i == 0 ? 0 : i - 1];
  const PathPoint& d = path[std::min(i + 2, path.size() - 1)];
  const double local = scaled - double(i);
  return {spline(a.position, path[i].position, path[i + 1].position, d.position, local),
          spline(a.radius, path[i].radius, path[i + 1].radius, d.radius, local)};
}

Mesh tube(const std::vector<PathPoint>& path, int sides, int steps, bool closed) {
  // The cross section is carried along the path by projection, so that it does not spin.
  std::vector<Frame> frames;
  for (int j = 0; j <= steps; ++j) {
    const double t = double(j) / steps;
    const Vec ahead = on_path(path, t + 0.5 / steps).position;
    const Vec behind = on_path(path, t - 0.5 / steps).position;
    Frame frame = frame_along(on_path(path, t).position, ahead - behind);
    if (j > 0) {
      const Vec carried = frames.back().x - frame.y * dot(frames.back().x, frame.y);
      frame.x = normalize(carried);
      frame.z = cross(frame.x, frame.y);
    }
    frames.push_back(frame);
  }
  Mesh mesh = uv_grid(sides, steps, true, false, [&](double u, double v) {
    const Frame& frame = frames[std::size_t(v * steps + 0.5)];
    const double r = on_path(path, v).radius;
    // Clockwise around y, so that du x dv points outwards.
    return frame.world({r * portable_cos(2.0 * kPi * u), 0.0, -r * portable_sin(2.0 * kPi * u)});
  });
  if (!closed) return mesh;
  const auto n = std::uint32_t(sides);
  const std::uint32_t last = n * std::uint32_t(steps);
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.emplace_back(0, i + 1, i);
    mesh.triangles.emplace_back(last, last + i, last + i + 1);
  }
  return mesh;
}

Mesh prism(const std::vector<Vec>& outline, double depth) {
  Mesh mesh;
  const auto n = std::uint32_t(outline.size());
  for (const double z : {-0.5 * depth, 0.5 * depth}) {
    for (const Vec& p : outline) mesh.positions.push_back(narrow({p.x, p.y, z}));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.emplace_back(i, next, next + n);
    mesh.triangles.emplace_back(i, next + n, i + n);
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.emplace_back(0, i + 1, i);
    mesh.triangles.emplace_back(n, n + i, n + i + 1);
  }
  return mesh;
}

Mesh rounded_box(const Vec& size, double rounding, int divisions) {
  // Lattice lines: all but the outermost cells of each face lie on the flat inner part.
  std::map<std::tuple<int, int, int>, std::uint32_t> known;
  Mesh mesh;
  const Vec inner = size * 0.5 - Vec(rounding);
  const auto vertex = [&](const glm::ivec3& c) {
    const auto [entry, is_new] =
        known.try_emplace({c.x, c.y, c.z}, std::uint32_t(mesh.positions.size()));
    if (is_new) {
      Vec core(0.0);
      Vec out(0.0);
      for (int k = 0; k < 3; ++k) {
        const double s = clamp(double(c[k] - 1) / (divisions - 2), 0.0, 1.0) * 2.0 - 1.0;
        core[k] = inner[k] * s;
        out[k] = c[k] == 0 ? -1.0 : (c[k] == divisions ? 1.0 : 0.0);
      }
      mesh.positions.push_back(narrow(core + normalize(out) * rounding));
    }
    return entry->second;
  };
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const bool high = face % 2 == 1;
    for (int j = 0; j < divisions; ++j) {
      for (int i = 0; i < divisions; ++i) {
        const auto corner = [&](int du, int dv) {
          glm::ivec3 c(0);
          c[axis] = high ? divisions : 0;
          // Swapping the two directions on the lower face keeps it facing outwards.
          c[(axis + 1) % 3] = high ? i + du : j + dv;
          c[(axis + 2) % 3] = high ? j + dv : i + du;
          return vertex(c);
        };
        // Named one by one: the order of arguments, and with it of the vertices, is the compiler's.
        const std::uint32_t a = corner(0, 0);
        const std::uint32_t b = corner(1, 0);
        const std::uint32_t c = corner(1, 1);
        const std::uint32_t d = corner(0, 1);
        mesh.triangles.emplace_back(a, b, c);
        mesh.triangles.emplace_back(a, c, d);
      }
    }
  }
  return mesh;
}

}  // namespace encore::scene::samples
