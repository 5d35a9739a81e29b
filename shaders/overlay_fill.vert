// A corner of a translucent face: of a box, or of triangles that are given.
#include "overlay_view.glsl"

#ifdef BOXES
#include "overlay_boxes.glsl"
#else
layout(location = 0) in vec3 corner;
layout(location = 1) in uint rgba;
#endif

out float depth;
flat out vec4 color;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[2];
};

void main() {
#ifdef BOXES
  Box b = fetch_box();
  int face = gl_VertexID / 6;
  int axis = face % 3;
  const ivec2 kCorners[6] =
      ivec2[](ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 0), ivec2(1, 1), ivec2(0, 1));
  ivec2 place = kCorners[gl_VertexID % 6];
  bvec3 at_high = bvec3(false);
  at_high[axis] = face >= 3;
  at_high[(axis + 1) % 3] = place.x != 0;
  at_high[(axis + 2) % 3] = place.y != 0;
  vec3 corner = mix(b.low, b.high, at_high);
  bool filled = view.fill_all > 0.5 || (b.flags & kFilled) != 0u;
  bool usable = is_box(b) && filled;
  color = vec4(b.color.rgb, b.color.a * view.fill_opacity);
#else
  bool usable = true;
  color = unpackUnorm4x8(rgba);
#endif
  if (!usable) {
    depth = 0.0;
    gl_ClipDistance[0] = -1.0;
    gl_ClipDistance[1] = -1.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec3 d = relative(corner);
  depth = depth_of(d);
  float divisor = divisor_of(d);
  gl_ClipDistance[0] = depth - view.near_depth;
  gl_ClipDistance[1] = kept_by_section(d);
  vec2 pixel = offset_of(d) + view.center * divisor;
  gl_Position = vec4(2.0 * pixel / view.size - divisor, 0.0, divisor);
}
