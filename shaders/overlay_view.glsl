// What every overlay shader knows of the view: the twin of OverlayBlock in
// renderer/overlay/overlay_view.h, which says how and why. Points are taken relative to the eye and
// scaled.
layout(std140, binding = 2) uniform OverlayBlock {
  vec3 eye;
  float scale;
  vec3 across;  // pixels to the right of the centre, times the divisor
  float near_depth;
  vec3 down;  // pixels below the centre, times the divisor
  float perspective;  // 1: the divisor is the depth; 0: it is 1
  vec3 forward;
  float hidden_opacity;  // of what lies behind the surface
  vec3 right;
  float reach;  // how much farther than the surface is still on it, as a factor
  vec3 up;
  float has_depth;
  vec4 section;  // positive on the side that is cut away
  vec2 size;
  vec2 center;
  float edge_px;
  float fill_opacity;
  float fill_all;
  float bold;
} view;

vec3 relative(vec3 point) { return (point - view.eye) * view.scale; }

float depth_of(vec3 d) { return dot(view.forward, d); }

float divisor_of(vec3 d) { return view.perspective > 0.5 ? depth_of(d) : 1.0; }

vec2 offset_of(vec3 d) { return vec2(dot(view.across, d), dot(view.down, d)); }

float kept_by_section(vec3 d) { return -(dot(view.section.xyz, d) + view.section.w); }
