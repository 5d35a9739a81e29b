// A pixel of a line with round ends: how much of it is covered, how far away the line is there.
#include "overlay_view.glsl"
#include "overlay_surface.glsl"

flat in vec4 ends;
flat in vec2 depths;
flat in float half_width;
flat in vec4 color;

layout(location = 0) out vec4 painted;

void main() {
  vec2 way = ends.zw - ends.xy;
  vec2 here = gl_FragCoord.xy - ends.xy;
  float squared = dot(way, way);
  float t = squared > 0.0 ? clamp(dot(here, way) / squared, 0.0, 1.0) : 0.0;
  float covered = clamp(half_width + 0.5 - length(here - t * way), 0.0, 1.0);
  // Across the picture it is the depth's inverse that grows evenly, where there is perspective.
  float depth = view.perspective > 0.5 ? 1.0 / mix(1.0 / depths.x, 1.0 / depths.y, t)
                                       : mix(depths.x, depths.y, t);
  float opacity = covered * color.a * opacity_at(depth);
  if (!(opacity > 0.0)) discard;
  painted = vec4(color.rgb, opacity);
}
