// Throws out triangles that a ray certainly misses, in single precision, and leaves the rest to
// decide_hit (twin of accel/triangle_filter.h, where the bound is derived). How a driver rounds or
// fuses here does not matter: the bound covers it.

// The direction times a power of two that brings its largest component into [1, 2).
struct PreparedRay {
  vec3 direction;
};

PreparedRay prepare_ray(Ray ray) {
  uint exponent = floatBitsToUint(largest_component(ray.direction)) >> 23;
  vec3 scaled = ray.direction * uintBitsToFloat((254u - min(exponent, 253u)) << 23);
  return PreparedRay(exponent > 253u ? 0.5 * scaled : scaled);
}

// How far to search for a hit that is to replace one at `best`.
float reach(float best) {
  return best;
}

bool certainly_missed(vec3 origin, vec3 d, Triangle triangle) {
  vec3 e1 = triangle.v1 - triangle.v0;
  vec3 e2 = triangle.v2 - triangle.v0;
  vec3 s = origin - triangle.v0;
  vec3 p = cross(d, e2);
  float edge = max(largest_component(e1), largest_component(e2));
  // In this order, so that the bound overflows wherever the sums may: a compiler that folds the two
  // constants first would keep it finite and lose triangles of huge scenes.
  precise float error = ENCORE_FILTER_LARGEST * edge * max(edge, largest_component(s)) *
                    ENCORE_FILTER_ERROR + ENCORE_FILTER_UNDERFLOW;
  float det = dot(e1, p);
  float u = dot(s, p);
  vec3 q = cross(s, e1);
  float v = dot(d, q);
  if (det < 0.0) {
    det = -det;
    u = -u;
    v = -v;
  }
  bool outside = u < -error || v < -error || u + v > det + error;
  return det > error && outside;
}

void test_triangle(Ray ray, PreparedRay prepared, uint index, inout Hit best) {
  Triangle triangle = triangles[index];
  if (certainly_missed(ray.origin, prepared.direction, triangle)) return;
  decide_hit(ray, triangle, index, best);
}
