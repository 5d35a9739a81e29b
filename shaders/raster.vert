// Triangle corners to clip coordinates (renderer/raster_view.h says how and why). The triangle
// buffer itself is what is drawn: a corner every 16 bytes, three a triangle.
layout(location = 0) in vec3 corner;

layout(location = 0) uniform vec3 eye;
layout(location = 1) uniform float scale;
layout(location = 2) uniform vec3 clip_x;
layout(location = 3) uniform vec3 clip_y;
layout(location = 4) uniform vec3 forward;
layout(location = 5) uniform float near_plane;
layout(location = 9) uniform bool orthographic;

// The weights of the second and third corner, which perspective interpolation turns into the
// barycentrics u and v of a hit.
out vec2 weights;
flat out uint triangle_index;

void main() {
  vec3 d = (corner - eye) * scale;
  float away = dot(forward, d);
  gl_Position = orthographic ? vec4(dot(clip_x, d), dot(clip_y, d), 1.0 - 0.5 * away, 1.0)
                             : vec4(dot(clip_x, d), dot(clip_y, d), near_plane, away);
  // Counts from the start of the buffer, also where a frame is drawn in pieces.
  triangle_index = uint(gl_VertexID) / 3u;
  uint place = uint(gl_VertexID) - 3u * triangle_index;
  weights = vec2(place == 1u ? 1.0 : 0.0, place == 2u ? 1.0 : 0.0);
}
