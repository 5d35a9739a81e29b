// The one definition of a hit, in double precision (twin of accel/triangle_hit.cpp, where the
// formulas are derived). `precise` keeps every operation as it is written: no fused, reordered or
// folded arithmetic, so GPU and CPU decide alike.
#include "numbers.glsl"

double exact_dot(dvec3 a, dvec3 b) {
  precise double sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}

dvec3 exact_cross(dvec3 a, dvec3 b) {
  precise dvec3 product =
      dvec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
  return product;
}

double largest_double(dvec3 v) {
  return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

// Keeps the distance of a triangle that is almost degenerate or edge-on inside its own box's
// stretch of the ray; false if the ray misses the box. Reciprocals are taken in double, so that
// they round as the CPU's do.
bool confine_to_box(Ray ray, Triangle triangle, inout float t) {
  vec3 lower = min(min(triangle.v0, triangle.v1), triangle.v2);
  vec3 upper = max(max(triangle.v0, triangle.v1), triangle.v2);
  float enter = 0.0;
  float leave = kLargestFloat;
  for (int axis = 0; axis < 3; ++axis) {
    float origin = ray.origin[axis];
    if ((floatBitsToUint(ray.direction[axis]) & 0x7FFFFFFFu) == 0u) {
      if (lower[axis] > origin || upper[axis] < origin) return false;
      continue;
    }
    float inverse = float(1.0lf / double(ray.direction[axis]));
    bool negative = ray.direction[axis] < 0.0;
    precise float near = ((negative ? upper[axis] : lower[axis]) - origin) * inverse;
    precise float far = ((negative ? lower[axis] : upper[axis]) - origin) * inverse;
    enter = near > enter ? near : enter;
    leave = far < leave ? far : leave;
  }
  if (!(enter * kNarrow <= leave * kWiden)) return false;
  float bounded = t < leave ? t : leave;
  t = bounded > enter ? bounded : enter;
  return true;
}

// Accepts the triangle into `best` and returns true if the ray crosses it at a smaller t, or at the
// same t with a lower index.
bool decide_hit(Ray ray, Triangle triangle, uint index, inout Hit best) {
  // The signed volumes that the ray's line spans with each edge.
  dvec3 v0 = dvec3(triangle.v0);
  dvec3 v1 = dvec3(triangle.v1);
  dvec3 v2 = dvec3(triangle.v2);
  dvec3 origin = dvec3(ray.origin);
  dvec3 direction = dvec3(ray.direction);
  precise dvec3 a = v0 - origin;
  precise dvec3 b = v1 - origin;
  precise dvec3 c = v2 - origin;
  precise dvec3 edge_a = v2 - v1;
  precise dvec3 edge_b = v0 - v2;
  precise dvec3 edge_c = v1 - v0;
  precise dvec3 sum_a = c + b;
  precise dvec3 sum_b = a + c;
  precise dvec3 sum_c = b + a;
  double weight_a = exact_dot(direction, exact_cross(edge_a, sum_a));
  double weight_b = exact_dot(direction, exact_cross(edge_b, sum_b));
  double weight_c = exact_dot(direction, exact_cross(edge_c, sum_c));

  // Inside if no two of them disagree in sign.
  bool any_negative = weight_a < 0.0lf || weight_b < 0.0lf || weight_c < 0.0lf;
  bool any_positive = weight_a > 0.0lf || weight_b > 0.0lf || weight_c > 0.0lf;
  if (any_negative == any_positive) return false;

  // The plane, from edges taken between the exact vertices.
  precise dvec3 edge2 = v2 - v0;
  dvec3 normal = exact_cross(edge_c, edge2);
  double slope = exact_dot(direction, normal);
  precise double steepness =
      abs(slope) / (largest_double(direction) * largest_double(edge_c) * largest_double(edge2));
  if (!(steepness > ENCORE_SLOPE_ROUNDING)) return false;

  precise double distance = exact_dot(a, normal) / slope;
  float t = float(distance);
  if (steepness < ENCORE_SLOPE_SAFE && !confine_to_box(ray, triangle, t)) return false;
  if (!(t > ray.t_min) || !(t <= kLargestFloat)) return false;
  if (!(t < best.t || (t == best.t && index < best.triangle))) return false;

  precise double inverse_sum = 1.0lf / (weight_a + weight_b + weight_c);
  precise double u = weight_b * inverse_sum;
  precise double v = weight_c * inverse_sum;
  best = Hit(t, index, float(u), float(v));
  return true;
}
