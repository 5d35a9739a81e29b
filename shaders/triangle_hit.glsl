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

dvec2 exact_shear(dvec2 p, dvec2 shear, double along) {
  precise dvec2 sheared = p - shear * along;
  return sheared;
}

// What rounding took from a product, exactly (Dekker 1971).
double rest_of_product(double a, double b, double product) {
  precise double a_scaled = 134217729.0lf * a;  // 2^27 + 1
  precise double b_scaled = 134217729.0lf * b;
  precise double a_high = a_scaled - (a_scaled - a);
  precise double b_high = b_scaled - (b_scaled - b);
  precise double a_low = a - a_high;
  precise double b_low = b - b_high;
  precise double rest =
      a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
  return rest;
}

// On which side of the edge from p to q the ray passes; the sign is exact for these p and q.
double edge_function(dvec2 p, dvec2 q) {
  precise double forward = p.x * q.y;
  precise double backward = p.y * q.x;
  precise double difference = forward - backward;
  if (forward != backward) return difference;
  precise double rest =
      rest_of_product(p.x, q.y, forward) - rest_of_product(p.y, q.x, backward);
  return rest;
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
    // One outside the normal range gives no distances (plane_inverse() of accel/box_hit.h).
    uint magnitude = floatBitsToUint(inverse) & 0x7FFFFFFFu;
    if (magnitude < 0x00800000u || magnitude >= 0x7F800000u) continue;
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
  dvec3 v0 = dvec3(triangle.v0);
  dvec3 v1 = dvec3(triangle.v1);
  dvec3 v2 = dvec3(triangle.v2);
  dvec3 origin = dvec3(ray.origin);
  dvec3 direction = dvec3(ray.direction);
  precise dvec3 a = v0 - origin;
  precise dvec3 b = v1 - origin;
  precise dvec3 c = v2 - origin;
  precise dvec3 edge_c = v1 - v0;
  // The ray is made the z axis; edge functions of the sheared vertices decide.
  dvec3 size = abs(direction);
  int kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  int kx = kz == 2 ? 0 : kz + 1;
  int ky = kx == 2 ? 0 : kx + 1;
  precise dvec2 shear = dvec2(direction[kx] / direction[kz], direction[ky] / direction[kz]);
  dvec2 sheared_a = exact_shear(dvec2(a[kx], a[ky]), shear, a[kz]);
  dvec2 sheared_b = exact_shear(dvec2(b[kx], b[ky]), shear, b[kz]);
  dvec2 sheared_c = exact_shear(dvec2(c[kx], c[ky]), shear, c[kz]);
  double weight_a = edge_function(sheared_c, sheared_b);
  double weight_b = edge_function(sheared_a, sheared_c);
  double weight_c = edge_function(sheared_b, sheared_a);

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
