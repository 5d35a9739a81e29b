// The stretch of a ray inside the boxes of a gpu::WideNode, four at a time: the test of
// box_hit.glsl, done alike for what a ray meets first and last by turning signs, as
// accel/kernels/slab_ray.h does.
#include "box_hit.glsl"
#include "scene_buffers.glsl"

// Rows of four numbers of a node: along each axis the lower ends of the boxes of children 0 to 3
// and 4 to 7, then their upper ends with the sign turned; then the children.
const uint kWideNodeRows = 16u;
const uint kWideAxisRows = 4u;
const uint kWideUpperRows = 2u;  // from the lower ends to the upper ones
const uint kWideChildRows = 12u;

struct WideRay {
  vec3 near_origin;  // the origin, with the sign turned along axes that the ray goes down
  vec3 inverse;      // the size of 1 / direction; 0 where that is not to be had
  uvec3 near_rows;   // from an axis' first row to the ends that are met first: 0 or kWideUpperRows
  BoxRay box;
};

WideRay make_wide_ray(Ray ray) {
  bvec3 down = notEqual(floatBitsToUint(ray.direction) & 0x80000000u, uvec3(0u));
  WideRay wide;
  wide.box = make_box_ray(ray);
  wide.near_origin = mix(ray.origin, -ray.origin, down);
  wide.inverse = abs(wide.box.inverse);
  wide.near_rows = kWideUpperRows * uvec3(down);
  return wide;
}

vec4 wide_row(uint row) {
  return uintBitsToFloat(node_rows[row]);
}

// What one axis says of four boxes. `row`: of their lower ends.
void clip_wide_axis(uint row, WideRay ray, int axis, inout vec4 enter, inout vec4 minus_leave) {
  uint near_row = row + ray.near_rows[axis];
  uint far_row = row + kWideUpperRows - ray.near_rows[axis];
  float origin = ray.near_origin[axis];
  precise vec4 near = (wide_row(near_row) - origin) * ray.inverse[axis];
  precise vec4 minus_far = (wide_row(far_row) + origin) * ray.inverse[axis];
  if (!ray.box.plain) {
    vec4 lower = wide_row(row);
    vec4 upper = -wide_row(row + kWideUpperRows);
    float place = ray.box.origin[axis];
    bvec4 inside = bvec4(uvec4(lessThanEqual(lower, vec4(place))) *
                         uvec4(lessThanEqual(vec4(place), upper)));
    uvec4 parallel = uvec4(uint(ray.box.parallel[axis]));
    bvec4 open = bvec4(uvec4(inside) * parallel + uvec4(uint(ray.box.untimed[axis])));
    bvec4 shut = bvec4(uvec4(not(inside)) * parallel);
    near = mix(mix(near, vec4(-kLargestFloat), open), vec4(kLargestFloat), shut);
    minus_far = mix(mix(minus_far, vec4(-kLargestFloat), open), vec4(kLargestFloat), shut);
  }
  enter = max(enter, near);
  minus_leave = max(minus_leave, minus_far);
}

// Four children's boxes over t in [t_min, t_max], both >= 0: 1 for each that the ray does not
// certainly miss, and where it enters. `row`: of their lower ends along x.
uvec4 wide_stretch(uint row, WideRay ray, float t_min, float t_max, out vec4 enter) {
  enter = vec4(t_min);
  vec4 minus_leave = vec4(-t_max);
  clip_wide_axis(row, ray, 0, enter, minus_leave);
  clip_wide_axis(row + kWideAxisRows, ray, 1, enter, minus_leave);
  clip_wide_axis(row + 2u * kWideAxisRows, ray, 2, enter, minus_leave);
  return uvec4(lessThanEqual(enter * kNarrow, minus_leave * -kWiden));
}

// Where a ray enters the box of one child that it meets.
float wide_enter(uint node, uint child, WideRay ray, float t_min) {
  uint row = kWideNodeRows * node + child / 4u;
  uint lane = child % 4u;
  vec3 ends = uintBitsToFloat(
      uvec3(node_rows[row + ray.near_rows.x][lane],
            node_rows[row + kWideAxisRows + ray.near_rows.y][lane],
            node_rows[row + 2u * kWideAxisRows + ray.near_rows.z][lane]));
  precise vec3 near = (ends - ray.near_origin) * ray.inverse;
  if (!ray.box.plain) {
    // Along the other axes it is in the box for good.
    bvec3 open = bvec3(uvec3(ray.box.parallel) + uvec3(ray.box.untimed));
    near = mix(near, vec3(-kLargestFloat), open);
  }
  return max(max(near.x, near.y), max(near.z, t_min));
}
