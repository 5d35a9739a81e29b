// Moller and Trumbore (1997) in single precision and nothing else, the same sums and products as
// accel/triangle_moller_trumbore.h; no double precision is compiled in.

// Nothing of a ray need be worked out beforehand.
struct PreparedRay {
  uint nothing;
};

PreparedRay prepare_ray(Ray ray) {
  return PreparedRay(0u);
}

// How far to search for a hit that is to replace one at `best`.
float reach(float best) {
  return best * (1.0 + 0.000244140625);  // 2^-12
}

float plain_dot(vec3 a, vec3 b) {
  precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}

vec3 plain_cross(vec3 a, vec3 b) {
  precise vec3 product =
      vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  return product;
}

void test_triangle(Ray ray, PreparedRay prepared, uint index, inout Hit best) {
  Triangle triangle = triangles[index];
  precise vec3 e1 = triangle.v1 - triangle.v0;
  precise vec3 e2 = triangle.v2 - triangle.v0;
  precise vec3 s = ray.origin - triangle.v0;
  vec3 p = plain_cross(ray.direction, e2);
  float det = plain_dot(e1, p);
  float sign = det < 0.0 ? -1.0 : 1.0;
  float u = plain_dot(s, p) * sign;
  vec3 q = plain_cross(s, e1);
  float v = plain_dot(ray.direction, q) * sign;
  float size = det * sign;
  precise float both = u + v;
  // Nothing that is not a number passes.
  if (!(size > 0.0 && u >= 0.0 && v >= 0.0 && both <= size)) return;
  float inverse = 1.0 / size;
  precise float t = plain_dot(e2, q) * sign * inverse;
  if (!(t > ray.t_min && t <= kLargestFloat)) return;
  if (t < best.t || (t == best.t && index < best.triangle)) {
    best = Hit(t, index, u * inverse, v * inverse);
  }
}
