#pragma once

#include "accel/settings.h"
#include "renderer/shading.h"
#include "scene/needs.h"

#include <cstdint>
#include <string>
#include <vector>

namespace encore::renderer {

/// The work group of shaders/trace.comp in pixels; rows of groups are what frames are cut between.
inline constexpr int kTraceGroupWidth = 8;
inline constexpr int kTraceGroupHeight = 8;

/// What shaders/trace.comp is to give for each ray.
enum class TraceOutput {
  picture,    ///< a colour: rays of the camera
  hits,       ///< a hit: rays of the camera
  counters,   ///< what the ray cost: rays of the camera
  ray_hits,   ///< a hit: rays from a buffer
  path_hits,  ///< a hit: the rays of a list of paths (shaders/paths.glsl)
  shadows,    ///< whether anything is hit: rays from paths towards a light, whose light they add
};

/// One variant of shaders/trace.comp.
struct TraceVariant {
  accel::StructureKind kind = accel::StructureKind::bvh_median;
  std::uint32_t depth = 0;  ///< trees: gpu::StructureParameters::depth
  TraceOutput output = TraceOutput::picture;
  ShadingNeeds needs{};
  bool lights = false;  ///< whether the scene has any
  accel::IntersectionMode intersection = accel::IntersectionMode::precise;
  /// Rounds of its loops after which a ray pauses (shaders/pausing.glsl); 0: never, which is right
  /// for all devices but software ones.
  std::uint32_t pause_after = 0;
  bool resumable = false;  ///< whether a ray that pauses can go on, rather than give up
};

/// The passes of pictures that take more than one ray a pixel (renderer/gpu_paths.h).
enum class PathPass { start, light, scatter, finish };

/// The work group of the light and scatter passes.
inline constexpr int kPathGroup = 64;

/// The file of a pass, and its defines for such a scene:
///
///   ENCORE_SAMPLES, ENCORE_SEVERAL_SAMPLES       start: rays through any place of a pixel, and
///                                                whether that is not the centre
///   ENCORE_BOUNCES, _REFLECTIONS, _REFRACTIONS   light, scatter: rays go on
///   ENCORE_LIGHTS, _NORMALS, _COLORS, _TEXTURES, _SPECULAR  light, scatter: add_shading_defines();
///                                                scatter without lights where there are shadows
///   ENCORE_ONE_LIGHT                             light
///   ENCORE_GROUP_SIZE n, or ENCORE_GROUP_X n and _Y n
std::string path_pass_file(PathPass pass);
std::vector<std::string> path_pass_defines(PathPass pass, const scene::Needs& needs);

/// Adds what shaders/shading.glsl has to do for such a scene: ENCORE_LIGHTS if it has any, and only
/// then ENCORE_NORMALS, ENCORE_COLORS, ENCORE_TEXTURES and ENCORE_SPECULAR.
void add_shading_defines(const ShadingNeeds& needs, bool lights, std::vector<std::string>& defines);

/// Whether there is a traversal in GLSL for structures of this kind: all but brute.
bool has_gpu_traversal(accel::StructureKind kind);

/// How many nodes the shader's stack holds for a tree of that depth: one a level and one more,
/// rounded up to a multiple of 16, so that a tree that grows by a level seldom needs another
/// shader. Enough at every depth.
std::uint32_t trace_stack_size(std::uint32_t depth);

/// What a ray that has paused takes of the buffer of such rays, in 32-bit words: a header and its
/// traversal's state (kPausedHeaderWords of shaders/trace.comp, what store_traversal() writes).
std::uint32_t paused_ray_words(const TraceVariant& variant);

/// The defines of a variant: nothing that it does not use is compiled in. Throws
/// std::invalid_argument for a kind that has no GPU traversal.
///
///   ENCORE_TRAVERSE_GRID, _KDTREE, _BVH, _WIDE  the structure, one of these
///   ENCORE_STACK_SIZE n                         trees: trace_stack_size()
///   ENCORE_MOLLER_TRUMBORE, ENCORE_WATERTIGHT  the intersection mode; neither: precise
///   ENCORE_GROUP_X n, ENCORE_GROUP_Y n   the work group
///   ENCORE_OUTPUT_PICTURE, _HITS, _COUNTERS  what is written, one of these
///   ENCORE_RAYS_FROM_BUFFER              rays that do not come from the camera
///   ENCORE_PATHS                         rays of paths
///   ENCORE_ANY_HIT                       rays that end at the first hit: shadows
///   ENCORE_LIGHTS, _NORMALS, _COLORS, _TEXTURES, _SPECULAR  pictures: add_shading_defines()
///   ENCORE_PAUSE_AFTER n                 software devices: pause_after
///   ENCORE_RESUMABLE                     software devices: resumable
std::vector<std::string> trace_defines(const TraceVariant& variant);

}  // namespace encore::renderer
