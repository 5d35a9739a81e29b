#include "renderer/trace_defines.h"

#include <stdexcept>

namespace encore::renderer {

namespace {

enum class Traversal { none, grid, kd_tree, bvh, wide };

Traversal traversal_of(accel::StructureKind kind) {
  switch (kind) {
    case accel::StructureKind::brute:
      return Traversal::none;
    case accel::StructureKind::grid_exact:
    case accel::StructureKind::grid_box:
      return Traversal::grid;
    case accel::StructureKind::kd_median:
    case accel::StructureKind::kd_sah:
      return Traversal::kd_tree;
    case accel::StructureKind::bvh_median:
      return Traversal::bvh;
    case accel::StructureKind::bvh_sah:
      return Traversal::wide;
  }
  return Traversal::none;
}

std::string define(const char* name, std::uint32_t value) {
  return std::string(name) + ' ' + std::to_string(value);
}

void add_structure(const TraceVariant& variant, std::vector<std::string>& defines) {
  const Traversal traversal = traversal_of(variant.kind);
  if (traversal == Traversal::none) {
    throw std::invalid_argument("structure " + std::string(accel::to_string(variant.kind)) +
                                " has no GPU traversal");
  }
  if (traversal == Traversal::grid) {
    defines.emplace_back("ENCORE_TRAVERSE_GRID");
    return;
  }
  if (traversal == Traversal::kd_tree) defines.emplace_back("ENCORE_TRAVERSE_KDTREE");
  if (traversal == Traversal::bvh) defines.emplace_back("ENCORE_TRAVERSE_BVH");
  if (traversal == Traversal::wide) defines.emplace_back("ENCORE_TRAVERSE_WIDE");
  defines.push_back(define("ENCORE_STACK_SIZE", trace_stack_size(variant.depth)));
}

void add_output(const TraceVariant& variant, std::vector<std::string>& defines) {
  switch (variant.output) {
    case TraceOutput::picture:
      defines.emplace_back("ENCORE_OUTPUT_PICTURE");
      add_shading_defines(variant.needs, variant.lights, defines);
      return;
    case TraceOutput::hits:
      defines.emplace_back("ENCORE_OUTPUT_HITS");
      return;
    case TraceOutput::counters:
      defines.emplace_back("ENCORE_OUTPUT_COUNTERS");
      return;
    case TraceOutput::ray_hits:
      defines.emplace_back("ENCORE_OUTPUT_HITS");
      defines.emplace_back("ENCORE_RAYS_FROM_BUFFER");
      return;
    case TraceOutput::path_hits:
      defines.emplace_back("ENCORE_PATHS");
      return;
    case TraceOutput::shadows:
      defines.emplace_back("ENCORE_PATHS");
      defines.emplace_back("ENCORE_ANY_HIT");
      return;
  }
}

}  // namespace

void add_shading_defines(const ShadingNeeds& needs, bool lights,
                         std::vector<std::string>& defines) {
  // Without light no surface is more than its own glow.
  if (!lights) return;
  defines.emplace_back("ENCORE_LIGHTS");
  if (needs.normals) defines.emplace_back("ENCORE_NORMALS");
  if (needs.colors) defines.emplace_back("ENCORE_COLORS");
  if (needs.textures) defines.emplace_back("ENCORE_TEXTURES");
  if (needs.specular) defines.emplace_back("ENCORE_SPECULAR");
}

std::string path_pass_file(PathPass pass) {
  switch (pass) {
    case PathPass::start:
      return "paths_start.comp";
    case PathPass::light:
      return "paths_light.comp";
    case PathPass::scatter:
      return "paths_scatter.comp";
    case PathPass::finish:
      return "paths_finish.comp";
  }
  return {};
}

std::vector<std::string> path_pass_defines(PathPass pass, const scene::Needs& needs) {
  std::vector<std::string> defines;
  if (pass == PathPass::start || pass == PathPass::finish) {
    defines.push_back(define("ENCORE_GROUP_X", kTraceGroupWidth));
    defines.push_back(define("ENCORE_GROUP_Y", kTraceGroupHeight));
    if (pass == PathPass::start) {
      defines.emplace_back("ENCORE_SAMPLES");
      if (needs.samples) defines.emplace_back("ENCORE_SEVERAL_SAMPLES");
    }
    return defines;
  }
  defines.push_back(define("ENCORE_GROUP_SIZE", kPathGroup));
  const bool bounces = needs.reflections || needs.refractions;
  if (bounces) defines.emplace_back("ENCORE_BOUNCES");
  if (needs.reflections) defines.emplace_back("ENCORE_REFLECTIONS");
  if (needs.refractions) defines.emplace_back("ENCORE_REFRACTIONS");
  const bool lit = needs.lights && (pass == PathPass::light || !needs.shadows);
  add_shading_defines(shading_needs(needs), lit, defines);
  // Where rays go on, and on which side of a surface, follows its shading normals.
  if (!lit && bounces && needs.normals) defines.emplace_back("ENCORE_NORMALS");
  if (pass == PathPass::light) defines.emplace_back("ENCORE_ONE_LIGHT");
  return defines;
}

bool has_gpu_traversal(accel::StructureKind kind) {
  return traversal_of(kind) != Traversal::none;
}

std::uint32_t trace_stack_size(std::uint32_t depth) {
  return (depth + 1 + 15) / 16 * 16;
}

std::uint32_t paused_ray_words(const TraceVariant& variant) {
  constexpr std::uint32_t kHeader = 8;
  const std::uint32_t stack = trace_stack_size(variant.depth);
  switch (traversal_of(variant.kind)) {
    case Traversal::none:
      return kHeader;
    case Traversal::grid:
      return kHeader + 24;
    case Traversal::kd_tree:
      return kHeader + 3 + 3 * stack;
    case Traversal::bvh:
    case Traversal::wide:
      return kHeader + 2 + 2 * stack;
  }
  return kHeader;
}

std::vector<std::string> trace_defines(const TraceVariant& variant) {
  std::vector<std::string> defines;
  add_structure(variant, defines);
  if (variant.intersection == accel::IntersectionMode::moller_trumbore) {
    defines.emplace_back("ENCORE_MOLLER_TRUMBORE");
  }
  if (variant.intersection == accel::IntersectionMode::watertight) {
    defines.emplace_back("ENCORE_WATERTIGHT");
  }
  add_output(variant, defines);
  if (variant.pause_after > 0) {
    defines.push_back(define("ENCORE_PAUSE_AFTER", variant.pause_after));
    if (variant.resumable) defines.emplace_back("ENCORE_RESUMABLE");
  }
  defines.push_back(define("ENCORE_GROUP_X", kTraceGroupWidth));
  defines.push_back(define("ENCORE_GROUP_Y", kTraceGroupHeight));
  return defines;
}

}  // namespace encore::renderer
