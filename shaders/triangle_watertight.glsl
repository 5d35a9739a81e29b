// Woop, Benthin and Wald (2013) in single precision, double where that leaves a doubt (twin of
// accel/triangle_watertight.h, where the bounds are derived, operation for operation). Divisions
// are made in double, so that they round as the CPU's do.

// The ray as the z axis: a permutation and a shear.
struct PreparedRay {
  int kx;
  int ky;
  int kz;
  float shear_x;
  float shear_y;
  float scale;
  bool plain;  // else its direction is too long or short, and everything is left to decide_hit
};

PreparedRay prepare_ray(Ray ray) {
  vec3 size = abs(ray.direction);
  PreparedRay r;
  r.kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  r.kx = r.kz == 2 ? 0 : r.kz + 1;
  r.ky = r.kx == 2 ? 0 : r.kx + 1;
  r.plain = size[r.kz] > ENCORE_WATERTIGHT_SMALL && size[r.kz] < ENCORE_WATERTIGHT_LARGE;
  double along = r.plain ? double(ray.direction[r.kz]) : 1.0lf;
  r.shear_x = float(double(ray.direction[r.kx]) / along);
  r.shear_y = float(double(ray.direction[r.ky]) / along);
  r.scale = float(1.0lf / along);
  return r;
}

// How far to search for a hit that is to replace one at `best`.
float reach(float best) {
  return best * (1.0 + 2.0 * ENCORE_WATERTIGHT_DISTANCE);
}

const int kCertainMiss = 0;
const int kCertainHit = 1;
const int kDoubt = 2;

// `weights`: the edge functions, unnormalised barycentric weights of the vertices.
int judge_edges(vec3 origin, PreparedRay r, Triangle triangle, out vec3 weights) {
  precise vec3 a = triangle.v0 - origin;
  precise vec3 b = triangle.v1 - origin;
  precise vec3 c = triangle.v2 - origin;
  precise vec3 x = vec3(a[r.kx] - r.shear_x * a[r.kz], b[r.kx] - r.shear_x * b[r.kz],
                        c[r.kx] - r.shear_x * c[r.kz]);
  precise vec3 y = vec3(a[r.ky] - r.shear_y * a[r.kz], b[r.ky] - r.shear_y * b[r.kz],
                        c[r.ky] - r.shear_y * c[r.kz]);
  precise vec3 w = x.zxy * y.yzx - y.zxy * x.yzx;
  weights = w;
  float lateral = max(largest_component(x), largest_component(y));
  float along = max(abs(a[r.kz]), max(abs(b[r.kz]), abs(c[r.kz])));
  precise float result = ENCORE_WATERTIGHT_RESULT * lateral * (lateral + along);
  precise float error = result * ENCORE_WATERTIGHT_ERROR + ENCORE_FILTER_UNDERFLOW;
  // What is not a number may compare either way here: by its size instead.
  if (!r.plain || !(along <= kLargestFloat) || !(result <= kLargestFloat)) return kDoubt;
  float low = min(w.x, min(w.y, w.z));
  float high = max(w.x, max(w.y, w.z));
  if (low < -error && high > error) return kCertainMiss;
  return low > error || high < -error ? kCertainHit : kDoubt;
}

// The distance of a certain hit, within the bound; a miss if it is certainly not on the ray.
int judge_distance(Ray ray, PreparedRay r, Triangle triangle, out float t) {
  precise vec3 a = triangle.v0 - ray.origin;
  precise vec3 e1 = triangle.v1 - triangle.v0;
  precise vec3 e2 = triangle.v2 - triangle.v0;
  precise vec3 n = e1.yzx * e2.zxy - e1.zxy * e2.yzx;
  precise vec3 height = n * a;
  precise float slope_x = n[r.kx] * r.shear_x;
  precise float slope_y = n[r.ky] * r.shear_y;
  precise float above = height.x + height.y + height.z;
  precise float down = slope_x + slope_y + n[r.kz];
  float edge = max(largest_component(e1), largest_component(e2));
  precise vec3 magnitude = abs(e1.yzx * e2.zxy) + abs(e1.zxy * e2.yzx);
  precise vec3 moved = magnitude * max(abs(e1), abs(e2));
  precise float error = ENCORE_WATERTIGHT_NORMAL * largest_component(moved) +
                        ENCORE_WATERTIGHT_NORMAL_UNDERFLOW * edge;
  float heights = abs(height.x) + abs(height.y) + abs(height.z);
  float slopes = abs(slope_x) + abs(slope_y) + abs(n[r.kz]);
  bool sure = edge > ENCORE_WATERTIGHT_EDGE_SMALL && edge < ENCORE_WATERTIGHT_EDGE_LARGE &&
              abs(above) > ENCORE_WATERTIGHT_SMALL && abs(down) > ENCORE_WATERTIGHT_SMALL &&
              error + 5.0 * heights < 128.0 * abs(above) &&
              5.0 * slopes < 120.0 * abs(down);
  t = 0.0;
  if (!sure) return kDoubt;
  float quotient = float(double(above) / double(down));
  precise float distance = quotient * r.scale;
  t = distance;
  float size = abs(t);
  if (!(size > ENCORE_WATERTIGHT_SMALL && size < ENCORE_WATERTIGHT_LARGE)) return kDoubt;
  float same = 4.0 * ENCORE_WATERTIGHT_DISTANCE * size;
  if (abs(t - ray.t_min) <= same || abs(t - ray.t_max) <= same) return kDoubt;
  return t > ray.t_min && t < ray.t_max ? kCertainHit : kCertainMiss;
}

// Whether precise arithmetic prefers triangle `a` to triangle `b`, both of which it hits.
bool precisely_nearer(Ray ray, uint a, uint b) {
  Hit nearest = Hit(ray.t_max, kNoHit, 0.0, 0.0);
  decide_hit(ray, triangles[b], b, nearest);
  decide_hit(ray, triangles[a], a, nearest);
  return nearest.triangle == a;
}

void test_triangle(Ray ray, PreparedRay prepared, uint index, inout Hit best) {
  Triangle triangle = triangles[index];
  vec3 weights;
  int verdict = judge_edges(ray.origin, prepared, triangle, weights);
  if (verdict == kCertainMiss || index == best.triangle) return;
  Hit hit = Hit(ray.t_max, kNoHit, 0.0, 0.0);
  float t;
  if (verdict == kCertainHit) {
    verdict = judge_distance(ray, prepared, triangle, t);
    if (verdict == kCertainMiss) return;
  }
  if (verdict == kCertainHit) {
    precise float sum = weights.x + weights.y + weights.z;
    float inverse_sum = float(1.0lf / double(sum));
    precise float u = weights.y * inverse_sum;
    precise float v = weights.z * inverse_sum;
    hit = Hit(t, index, u, v);
  } else if (!decide_hit(ray, triangle, index, hit)) {
    return;
  }

  // Which of two is nearer must not depend on which was met first, nor on single precision.
  if (best.triangle != kNoHit) {
    if (abs(hit.t - best.t) <= 4.0 * ENCORE_WATERTIGHT_DISTANCE * hit.t) {
      if (!precisely_nearer(ray, index, best.triangle)) return;
    } else if (hit.t > best.t) {
      return;
    }
  }
  best = hit;
}
