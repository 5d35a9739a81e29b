// A straight line of some pixels' width: two triangles around its part inside the picture.
#include "overlay_view.glsl"

#ifdef BOXES
#include "overlay_boxes.glsl"
#else
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in uint rgba;
layout(location = 3) in float width_px;
#endif

flat out vec4 ends;    // in pixels from the top left
flat out vec2 depths;  // of the two ends
flat out float half_width;
flat out vec4 color;

// What is drawn beyond a line's own width: where coverage fades out.
const float kMargin = 1.0;
// Coordinates are rounded relative to the line's length, so a point much closer to the eye than
// this share of it could lie in any direction.
const float kNearShare = 6.103515625e-5;

// Keeps of t the part in which a linear function that is `a` and `b` at the ends is not negative.
void keep(float a, float b, inout vec2 t) {
  if (a < 0.0 && b < 0.0) t = vec2(1.0, 0.0);
  if (a < 0.0 && b >= 0.0) t.x = max(t.x, a / (a - b));
  if (b < 0.0 && a >= 0.0) t.y = min(t.y, a / (a - b));
}

// Cuts off what is behind the eye, beside the picture or beyond the section plane.
bool clip(inout vec3 a, inout vec3 b, float margin) {
  vec2 t = vec2(0.0, 1.0);
  float depth_a = depth_of(a);
  float depth_b = depth_of(b);
  float closest = view.near_depth;
  if (view.perspective > 0.5) {
    closest = max(closest, kNearShare * max(abs(depth_a), abs(depth_b)));
  }
  keep(depth_a - closest, depth_b - closest, t);
  keep(kept_by_section(a), kept_by_section(b), t);
  vec2 low = view.center + margin;
  vec2 high = view.size - view.center + margin;
  vec2 offset_a = offset_of(a);
  vec2 offset_b = offset_of(b);
  float divisor_a = divisor_of(a);
  float divisor_b = divisor_of(b);
  keep(offset_a.x + low.x * divisor_a, offset_b.x + low.x * divisor_b, t);
  keep(offset_a.y + low.y * divisor_a, offset_b.y + low.y * divisor_b, t);
  keep(high.x * divisor_a - offset_a.x, high.x * divisor_b - offset_b.x, t);
  keep(high.y * divisor_a - offset_a.y, high.y * divisor_b - offset_b.y, t);
  if (!(t.x <= t.y)) return false;
  vec3 start = a;
  vec3 way = b - a;
  if (t.x > 0.0) a = start + t.x * way;
  if (t.y < 1.0) b = start + t.y * way;
  return true;
}

vec2 pixel_of(vec3 d) { return view.center + offset_of(d) / divisor_of(d); }

void hide() {
  ends = vec4(0.0);
  depths = vec2(0.0);
  half_width = 0.0;
  color = vec4(0.0);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}

// The two triangles around the line between pixels a and b.
vec2 corner_of(vec2 a, vec2 b, float radius) {
  const vec2 kCorners[6] = vec2[](vec2(0, -1), vec2(1, -1), vec2(1, 1), vec2(0, -1), vec2(1, 1),
                                  vec2(0, 1));
  vec2 corner = kCorners[gl_VertexID % 6];
  vec2 way = b - a;
  float extent = length(way);
  vec2 along = extent > 1e-4 ? way / extent : vec2(1.0, 0.0);
  vec2 aside = vec2(-along.y, along.x);
  return mix(a, b, corner.x) + radius * ((2.0 * corner.x - 1.0) * along + corner.y * aside);
}

void main() {
#ifdef BOXES
  Box b = fetch_box();
  int edge = gl_VertexID / 6;
  int axis = edge / 4;
  // The edge's place along the two other axes.
  bvec3 at_high = bvec3(false);
  at_high[(axis + 1) % 3] = (edge & 1) != 0;
  at_high[(axis + 2) % 3] = (edge & 2) != 0;
  bvec3 at_end = at_high;
  at_end[axis] = true;
  bool usable = is_box(b);
  vec3 first = relative(mix(b.low, b.high, at_high));
  vec3 second = relative(mix(b.low, b.high, at_end));
  float width = view.edge_px * ((b.flags & kBold) != 0u ? view.bold : 1.0);
  vec4 paint = b.color;
#else
  bool usable = true;
  vec3 first = relative(from);
  vec3 second = relative(to);
  float width = width_px;
  vec4 paint = unpackUnorm4x8(rgba);
#endif
  // A line thinner than a pixel is one of a pixel, so much fainter.
  float half_px = 0.5 * max(width, 1.0);
  float radius = half_px + kMargin;
  if (!usable || !(width > 0.0) || !clip(first, second, 2.0 * radius)) {
    hide();
    return;
  }
  vec2 a = pixel_of(first);
  vec2 b_end = pixel_of(second);
  ends = vec4(a, b_end);
  depths = vec2(depth_of(first), depth_of(second));
  half_width = half_px;
  color = vec4(paint.rgb, paint.a * min(width, 1.0));
  gl_Position = vec4(2.0 * corner_of(a, b_end, radius) / view.size - 1.0, 0.0, 1.0);
}
