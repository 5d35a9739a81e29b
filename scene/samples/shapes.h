#pragma once

#include "scene/mesh.h"
#include "scene/samples/vector_math.h"

#include <functional>
#include <vector>

/// Tessellated basic shapes. All face outwards (counter-clockwise seen from outside), share their
/// vertices, and carry no normals yet. Each states its exact number of triangles.
namespace encore::scene::samples {

/// A point of a profile in the half-plane of a lathe: distance from the y axis, and height.
struct ProfilePoint {
  double radius;
  double height;
};

/// A point on a path with the radius of the tube there.
struct PathPoint {
  Vec position;
  double radius;
};

/// A grid of columns x rows quads over (u, v) in [0, 1]^2, faces towards du x dv; 2 columns rows
/// triangles. A wrapped direction shares its last line of vertices with its first.
Mesh uv_grid(int columns, int rows, bool wrap_u, bool wrap_v,
             const std::function<Vec(double, double)>& point);

/// A ball around the origin, poles on the y axis; 2 sides (stacks - 1) triangles.
Mesh ball(double radius, int sides, int stacks);

/// A ring around the y axis; 2 around across triangles.
Mesh torus(double major_radius, double minor_radius, int around, int across);

/// The profile, from its bottom end on the axis to its top end on the axis, turned around the y
/// axis; closed. Between the given points the profile is rounded (Catmull-Rom). `stacks` segments;
/// 2 sides (stacks - 1) triangles.
Mesh lathe(const std::vector<ProfilePoint>& profile, int sides, int stacks);

/// A tube along a smooth path through the points. Open ends: 2 sides steps triangles; closed by
/// flat caps: 2 (sides - 2) more.
Mesh tube(const std::vector<PathPoint>& path, int sides, int steps, bool closed);

/// A convex outline in the xy plane (counter-clockwise), from z = -depth / 2 to depth / 2; 4 n - 4
/// triangles.
Mesh prism(const std::vector<Vec>& outline, double depth);

/// A box around the origin with rounded edges; 12 divisions^2 triangles, divisions >= 3.
Mesh rounded_box(const Vec& size, double rounding, int divisions);

/// The point at `t` in [0, 1] of the smooth (Catmull-Rom) path through the points.
PathPoint on_path(const std::vector<PathPoint>& path, double t);

}  // namespace encore::scene::samples
