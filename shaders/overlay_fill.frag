// A pixel of a translucent face.
#include "overlay_view.glsl"
#include "overlay_surface.glsl"

in float depth;
flat in vec4 color;

layout(location = 0) out vec4 painted;

void main() {
  float opacity = color.a * opacity_at(depth);
  if (!(opacity > 0.0)) discard;
  painted = vec4(color.rgb, opacity);
}
