#include "scene/left_out.h"

#include "shaders/shared/gpu_types.h"
#include "shaders/shared/path_types.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace encore::scene {
namespace {

constexpr std::uint64_t kNormalBytes = sizeof(std::array<glm::vec3, 3>);
constexpr std::uint64_t kColorBytes = sizeof(std::array<glm::vec3, 3>);
constexpr std::uint64_t kTexcoordBytes = sizeof(std::array<glm::vec2, 3>);

// What goes with a device's texels: a table of what sRGB values mean, and a header a texture.
constexpr std::uint64_t kTexelTableBytes = 256 * sizeof(float);
constexpr std::uint64_t kTextureHeaderBytes = 4 * sizeof(std::uint32_t);

constexpr const char* kNoLight = "there is no light besides the ambient one";

std::set<const Texture*> textures_of(const Scene& scene) {
  std::set<const Texture*> textures;
  for (const Material& material : scene.materials) {
    if (material.diffuse_texture != nullptr) textures.insert(material.diffuse_texture.get());
  }
  return textures;
}

std::uint64_t device_texture_bytes(const Scene& scene) {
  return kTexelTableBytes + kTextureHeaderBytes * textures_of(scene).size() + texture_bytes(scene);
}

/// The device has one material more than the scene.
std::uint64_t materials_on_device(const Scene& scene) {
  return static_cast<std::uint64_t>(scene.materials.size()) + 1;
}

bool bounces(const Needs& needs) {
  return needs.reflections || needs.refractions;
}

/// Why a kind of rays that bounce is not traced.
std::string bounce_reason(bool possible, const char* surfaces, const RaySettings& rays) {
  if (!possible) return surfaces;
  return rays.depth > 0 ? "switched off" : "the depth is 0";
}

/// Why no surface is textured.
const char* texture_reason(const Scene& scene, const TriangleList& list, const Needs& needs) {
  if (textures_of(scene).empty()) {
    const bool some =
        std::any_of(scene.instances.begin(), scene.instances.end(), [](const Instance& instance) {
          return instance.model != nullptr && !instance.model->mesh.texcoords.empty();
        });
    return some ? "no material has a texture, though a mesh has coordinates"
                : "no material has a texture";
  }
  if (list.texcoords.empty()) return "no mesh with a texture has coordinates";
  return needs.lights ? "switched off" : kNoLight;
}

/// Collects what is left out.
class Listing {
 public:
  void add(bool needed, const char* feature, std::string reason,
           std::optional<std::uint64_t> device = std::nullopt,
           std::optional<std::uint64_t> host = std::nullopt) {
    if (needed) return;
    found.push_back({feature, std::move(reason), device, host});
  }
  std::vector<LeftOut> found;
};

void add_surfaces(const Scene& scene, const TriangleList& list, const Needs& needs,
                  Listing& listing) {
  const auto count = static_cast<std::uint64_t>(list.triangles.size());
  const auto without = [&](bool has, const char* none) { return has ? kNoLight : none; };
  const auto add = [&](bool needed, const char* feature, const char* reason, bool held,
                       std::uint64_t bytes) {
    listing.add(needed, feature, reason, count * bytes, held ? 0 : count * bytes);
  };
  const bool normals = !list.normals.empty();
  const bool colors = !list.colors.empty();
  add(needs.normals, "shading normals", without(normals, "no mesh has any: the triangles' own do"),
      normals, kNormalBytes);
  add(needs.colors, "vertex colours", without(colors, "no mesh has any"), colors, kColorBytes);
  const char* why = texture_reason(scene, list, needs);
  add(needs.textures, "texture coordinates", why, !list.texcoords.empty(), kTexcoordBytes);
  // The host's pictures stay with the materials that name them.
  if (texture_bytes(scene) > 0) {
    listing.add(needs.textures, "textures", why, device_texture_bytes(scene), 0);
  }
  listing.add(needs.highlights, "highlights",
              needs.lights ? "no material has a specular colour" : kNoLight);
}

void add_rays(const Scene& scene, const TriangleList& list, const RaySettings& rays,
              const Needs& needs, Listing& listing) {
  const Needs could = needs_of(scene, list, every_ray());
  listing.add(needs.shadows, "shadow rays", could.shadows ? "switched off" : kNoLight);
  // What materials mirror and let through is one buffer.
  std::optional<std::uint64_t> bounce;
  if (!bounces(needs)) bounce = materials_on_device(scene) * sizeof(gpu::Bounce);
  listing.add(needs.reflections, "reflected rays",
              bounce_reason(could.reflections, "no material mirrors or is glass", rays), bounce);
  listing.add(needs.refractions, "refracted rays",
              bounce_reason(could.refractions, "no material is see-through", rays));
  listing.add(needs.samples, "sample places", "one ray a pixel goes through its centre");
}

void add_run(const Scene& scene, const TriangleList& list, const RunNeeds& needs,
             Listing& listing) {
  listing.add(needs.animates(), "animation",
              motion_of(scene) == MotionKind::none
                  ? "nothing moves: no frame has a phase animate, build or update"
                  : "time stands still: no frame has a phase animate, build or update");
  if (needs.animates()) {
    listing.add(needs.motion == MotionKind::frames, "new triangles",
                "what moves keeps its triangles: none are counted or placed anew");
  }
  listing.add(needs.structures, "structures", "no device traces rays");
  listing.add(needs.device, "device copies",
              "only the CPU draws: no OpenGL, no buffers, no shaders, no phase transfer",
              device_bytes(scene, list, needs.picture));
  listing.add(needs.counting, "counting", "no heat map is drawn");
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
  std::uint64_t bytes = 0;
  for (const Texture* texture : textures_of(scene)) bytes += texture->bytes();
  return bytes;
}

std::uint64_t device_bytes(const Scene& scene, const TriangleList& triangles, const Needs& needs) {
  std::uint64_t a_triangle = sizeof(gpu::Triangle);
  if (needs.normals) a_triangle += kNormalBytes;
  if (needs.colors) a_triangle += kColorBytes;
  if (needs.textures) a_triangle += kTexcoordBytes;
  std::uint64_t a_material = sizeof(gpu::Material);
  if (bounces(needs)) a_material += sizeof(gpu::Bounce);
  return triangles.triangles.size() * a_triangle + materials_on_device(scene) * a_material +
         scene.lights.size() * sizeof(gpu::Light) +
         (needs.textures ? device_texture_bytes(scene) : 0);
}

std::vector<LeftOut> left_out(const Scene& scene, const TriangleList& triangles,
                              const RaySettings& rays) {
  const Needs needs = needs_of(scene, triangles, rays);
  Listing listing;
  listing.add(needs.lights, "lights", "the scene has none: its surfaces show their ambient light");
  add_surfaces(scene, triangles, needs, listing);
  add_rays(scene, triangles, rays, needs, listing);
  return std::move(listing.found);
}

std::vector<LeftOut> left_out(const Scene& scene, const TriangleList& triangles,
                              const RaySettings& rays, const RunParts& parts) {
  const RunNeeds needs = run_needs(scene, triangles, rays, parts);
  Listing listing;
  listing.found = left_out(scene, triangles, rays);
  if (!needs.device) {
    for (LeftOut& one : listing.found) one.bytes.reset();
  }
  add_run(scene, triangles, needs, listing);
  return std::move(listing.found);
}

}  // namespace encore::scene
