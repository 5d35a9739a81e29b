#include "scene/left_out.h"

#include <array>
#include <set>
#include <utility>

namespace encore::scene {
namespace {

constexpr std::uint64_t kNormalBytes = sizeof(std::array<glm::vec3, 3>);
constexpr std::uint64_t kColorBytes = sizeof(std::array<glm::vec3, 3>);
constexpr std::uint64_t kTexcoordBytes = sizeof(std::array<glm::vec2, 3>);

constexpr const char* kNoLight = "there is no light besides the ambient one";

/// Why a kind of rays that bounce is not traced.
std::string bounce_reason(bool possible, const char* surfaces, const RaySettings& rays) {
  if (!possible) return surfaces;
  return rays.depth > 0 ? "switched off" : "the depth is 0";
}

/// Collects what is left out.
class Listing {
 public:
  void add(bool needed, const char* feature, std::string reason,
           std::optional<std::uint64_t> bytes = std::nullopt) {
    if (needed) return;
    found.push_back({feature, std::move(reason), bytes});
  }
  std::vector<LeftOut> found;
};

void add_surfaces(const Scene& scene, const TriangleList& list, const Needs& needs,
                  Listing& listing) {
  const auto count = static_cast<std::uint64_t>(list.triangles.size());
  const auto without = [&](bool has, const char* none) { return has ? kNoLight : none; };
  listing.add(needs.normals, "shading normals",
              without(!list.normals.empty(), "no mesh has any: the triangles' own do"),
              count * kNormalBytes);
  listing.add(needs.colors, "vertex colours", without(!list.colors.empty(), "no mesh has any"),
              count * kColorBytes);
  const std::uint64_t texels = texture_bytes(scene);
  const char* why = "switched off";
  if (!needs.lights) why = kNoLight;
  if (list.texcoords.empty()) why = "no mesh has texture coordinates";
  if (texels == 0) why = "no material has a texture";
  listing.add(needs.textures, "texture coordinates", why, count * kTexcoordBytes);
  if (texels > 0) listing.add(needs.textures, "textures", why, texels);
  listing.add(needs.highlights, "highlights",
              needs.lights ? "no material has a specular colour" : kNoLight);
}

}  // namespace

RaySettings every_ray() {
  return {.shadows = true,
          .reflections = true,
          .refractions = true,
          .textures = true,
          .depth = kMostDepth,
          .samples = 2,
          .seed = 1};
}

std::uint64_t texture_bytes(const Scene& scene) {
  std::set<const Texture*> seen;
  std::uint64_t bytes = 0;
  for (const Material& material : scene.materials) {
    const Texture* texture = material.diffuse_texture.get();
    if (texture != nullptr && seen.insert(texture).second) bytes += texture->bytes();
  }
  return bytes;
}

std::vector<LeftOut> left_out(const Scene& scene, const TriangleList& triangles,
                              const RaySettings& rays) {
  const Needs needs = needs_of(scene, triangles, rays);
  const Needs could = needs_of(scene, triangles, every_ray());
  Listing listing;
  listing.add(needs.lights, "lights", "the scene has none: its surfaces show their ambient light");
  add_surfaces(scene, triangles, needs, listing);
  listing.add(needs.shadows, "shadow rays", could.shadows ? "switched off" : kNoLight);
  listing.add(needs.reflections, "reflected rays",
              bounce_reason(could.reflections, "no material mirrors or is glass", rays));
  listing.add(needs.refractions, "refracted rays",
              bounce_reason(could.refractions, "no material is see-through", rays));
  listing.add(needs.samples, "sample places", "one ray a pixel goes through its centre");
  return std::move(listing.found);
}

}  // namespace encore::scene
