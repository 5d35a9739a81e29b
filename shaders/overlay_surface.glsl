// How much of a fragment is seen, before or behind the surface that the rays found.
layout(binding = 1) uniform sampler2D hit_distance;  // along each pixel's ray; infinite: nothing

float opacity_at(float depth) {
  if (view.has_depth < 0.5) return 1.0;
  ivec2 size = textureSize(hit_distance, 0);
  ivec2 texel = min(ivec2(gl_FragCoord.xy * vec2(size) / view.size), size - 1);
  float surface = texelFetch(hit_distance, texel, 0).r * view.scale;
  // The depth is along the view, the distance along this pixel's ray.
  vec2 pixel = gl_FragCoord.xy - view.center;
  vec3 along = view.forward + pixel.x * view.right - pixel.y * view.up;
  float distance = view.perspective > 0.5 ? depth * length(along) : depth;
  return distance > surface * view.reach ? view.hidden_opacity : 1.0;
}
