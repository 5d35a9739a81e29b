#pragma once

#include "scene/bounds.h"
#include "scene/mesh.h"
#include "scene/samples/vector_math.h"

namespace encore::scene::samples {

inline Vec widen(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}
inline glm::vec3 narrow(const Vec& v) {
  return {float(v.x), float(v.y), float(v.z)};
}

/// The smallest box around all positions.
Bounds bounds_of(const Mesh& mesh);

/// Adds `part` to `mesh`; its triangles get `material`. If only one of the two has normals (or
/// colours), what the other lacks is filled in with zero normals (white).
void append(Mesh& mesh, const Mesh& part, std::uint32_t material = 0);

/// Moves every position (scaled first) and normal into `frame`.
Mesh moved(Mesh mesh, const Frame& frame, double scale = 1.0);

/// Every position times `factors`, component by component; for shapes without normals yet.
Mesh stretched(Mesh mesh, const Vec& factors);

/// Cuts the part below `height` off and leaves a flat, open hole there.
void cut_below(Mesh& mesh, double height);

/// Centres the mesh at the origin with its longest side of `longest` units: 27 fills about 70 % of
/// the window for the thesis' camera (section 4.3).
void fit(Mesh& mesh, double longest = 27.0);

/// One unit normal a vertex: the mean of its triangles' normals weighted by area, so that the big
/// faces beside a narrow bevel stay flat to the eye.
void smooth_normals(Mesh& mesh);
/// The mesh with smooth_normals.
Mesh smooth(Mesh mesh);

/// The mesh with three vertices of its own a triangle, and the triangle's normal on them: for parts
/// with sharp edges.
Mesh flat_shaded(const Mesh& mesh);

}  // namespace encore::scene::samples
