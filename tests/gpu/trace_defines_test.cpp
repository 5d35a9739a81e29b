// A shader holds what its scene and run use, and no more.
#include "renderer/trace_defines.h"

#include "tests/gpu/gpu_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace encore;
using accel::StructureKind;
using renderer::trace_defines;
using renderer::TraceOutput;
using renderer::TraceVariant;
using Defines = std::set<std::string>;

/// Without the work group's size.
Defines defines_of(const TraceVariant& variant) {
  const std::vector<std::string> list = trace_defines(variant);
  Defines defines(list.begin(), list.end());
  EXPECT_EQ(defines.size(), list.size()) << "something is defined twice";
  EXPECT_EQ(defines.erase("ENCORE_GROUP_X 8"), 1U);
  EXPECT_EQ(defines.erase("ENCORE_GROUP_Y 8"), 1U);
  return defines;
}

TEST(TraceDefines, APlainSceneHasNoFeaturesOfShading) {
  EXPECT_EQ(defines_of({.kind = StructureKind::bvh_median, .depth = 5}),
            (Defines{"ENCORE_TRAVERSE_BVH", "ENCORE_STACK_SIZE 16", "ENCORE_OUTPUT_PICTURE"}));
  EXPECT_EQ(defines_of({.kind = StructureKind::bvh_sah, .depth = 16}),
            (Defines{"ENCORE_TRAVERSE_WIDE", "ENCORE_STACK_SIZE 32", "ENCORE_OUTPUT_PICTURE"}));
}

TEST(TraceDefines, EachFeatureAddsItsOwnOnly) {
  TraceVariant variant{.kind = StructureKind::grid_box, .lights = true};
  const Defines plain = defines_of(variant);
  EXPECT_EQ(plain, (Defines{"ENCORE_TRAVERSE_GRID", "ENCORE_OUTPUT_PICTURE", "ENCORE_LIGHTS"}));
  const auto expect_more = [&](const TraceVariant& with, const std::string& define) {
    Defines expected = plain;
    expected.insert(define);
    EXPECT_EQ(defines_of(with), expected);
  };
  variant.needs = {.normals = true};
  expect_more(variant, "ENCORE_NORMALS");
  variant.needs = {.colors = true};
  expect_more(variant, "ENCORE_COLORS");
  variant.needs = {.specular = true};
  expect_more(variant, "ENCORE_SPECULAR");
  variant.needs = {.textures = true};
  expect_more(variant, "ENCORE_TEXTURES");
}

TEST(TraceDefines, WithoutLightThereIsNothingToShade) {
  EXPECT_EQ(defines_of({.kind = StructureKind::grid_box,
                        .needs = {.normals = true, .colors = true, .specular = true}}),
            (Defines{"ENCORE_TRAVERSE_GRID", "ENCORE_OUTPUT_PICTURE"}));
}

TEST(TraceDefines, NothingIsShadedWhereNoPictureIsAskedFor) {
  TraceVariant variant{.kind = StructureKind::kd_sah,
                       .depth = 16,
                       .output = TraceOutput::hits,
                       .needs = {.normals = true, .colors = true, .specular = true},
                       .lights = true};
  EXPECT_EQ(defines_of(variant),
            (Defines{"ENCORE_TRAVERSE_KDTREE", "ENCORE_STACK_SIZE 32", "ENCORE_OUTPUT_HITS"}));
  variant.output = TraceOutput::counters;
  EXPECT_EQ(defines_of(variant),
            (Defines{"ENCORE_TRAVERSE_KDTREE", "ENCORE_STACK_SIZE 32", "ENCORE_OUTPUT_COUNTERS"}));
  variant.output = TraceOutput::ray_hits;
  EXPECT_EQ(defines_of(variant), (Defines{"ENCORE_TRAVERSE_KDTREE", "ENCORE_STACK_SIZE 32",
                                          "ENCORE_OUTPUT_HITS", "ENCORE_RAYS_FROM_BUFFER"}));
}

TEST(TraceDefines, RaysOfPathsAreTracedWithoutShading) {
  TraceVariant variant{.kind = StructureKind::grid_exact,
                       .output = TraceOutput::path_hits,
                       .needs = {.normals = true, .textures = true},
                       .lights = true};
  EXPECT_EQ(defines_of(variant), (Defines{"ENCORE_TRAVERSE_GRID", "ENCORE_PATHS"}));
  variant.output = TraceOutput::shadows;
  EXPECT_EQ(defines_of(variant),
            (Defines{"ENCORE_TRAVERSE_GRID", "ENCORE_PATHS", "ENCORE_ANY_HIT"}));
}

TEST(PathPassDefines, AreOfWhatIsNeededOnly) {
  using renderer::PathPass;
  const auto defines = [](PathPass pass, const scene::Needs& needs) {
    const std::vector<std::string> list = renderer::path_pass_defines(pass, needs);
    return Defines(list.begin(), list.end());
  };
  const Defines group{"ENCORE_GROUP_X 8", "ENCORE_GROUP_Y 8"};
  EXPECT_EQ(defines(PathPass::finish, {.lights = true, .shadows = true}), group);
  EXPECT_EQ(defines(PathPass::start, {.shadows = true}),
            (Defines{"ENCORE_GROUP_X 8", "ENCORE_GROUP_Y 8", "ENCORE_SAMPLES"}));
  EXPECT_TRUE(defines(PathPass::start, {.samples = true}).contains("ENCORE_SEVERAL_SAMPLES"));
  // Several samples alone take no more than shading.
  EXPECT_EQ(defines(PathPass::scatter, {.lights = true, .textures = true, .samples = true}),
            (Defines{"ENCORE_GROUP_SIZE 64", "ENCORE_LIGHTS", "ENCORE_TEXTURES"}));
  // With shadows the light pass does that, and the scatter pass none of it.
  const scene::Needs shadowed{.lights = true, .normals = true, .shadows = true};
  EXPECT_EQ(defines(PathPass::scatter, shadowed), (Defines{"ENCORE_GROUP_SIZE 64"}));
  EXPECT_EQ(defines(PathPass::light, shadowed), (Defines{"ENCORE_GROUP_SIZE 64", "ENCORE_LIGHTS",
                                                         "ENCORE_NORMALS", "ENCORE_ONE_LIGHT"}));
  EXPECT_EQ(
      defines(PathPass::scatter, {.normals = true, .refractions = true}),
      (Defines{"ENCORE_GROUP_SIZE 64", "ENCORE_BOUNCES", "ENCORE_REFRACTIONS", "ENCORE_NORMALS"}));
}

TEST(TraceDefines, EveryKindButBruteHasATraversal) {
  for (const StructureKind kind : accel::all_structure_kinds()) {
    if (kind == StructureKind::brute) {
      EXPECT_FALSE(renderer::has_gpu_traversal(kind));
      EXPECT_THROW((void)trace_defines({.kind = kind}), std::invalid_argument);
      continue;
    }
    EXPECT_TRUE(renderer::has_gpu_traversal(kind));
    const Defines defines = defines_of({.kind = kind});
    EXPECT_EQ(
        std::count_if(defines.begin(), defines.end(),
                      [](const std::string& name) { return name.starts_with("ENCORE_TRAVERSE_"); }),
        1);
  }
}

TEST(TraceDefines, RaysPauseOnlyWhereTheyAreToldTo) {
  TraceVariant variant{.kind = StructureKind::grid_exact, .output = TraceOutput::hits};
  variant.pause_after = 99;
  EXPECT_EQ(defines_of(variant),
            (Defines{"ENCORE_TRAVERSE_GRID", "ENCORE_OUTPUT_HITS", "ENCORE_PAUSE_AFTER 99"}));
  // Trees keep a stack for each ray that has paused.
  const std::uint32_t stack = renderer::trace_stack_size(40);
  EXPECT_EQ(renderer::paused_ray_words({.kind = StructureKind::bvh_median, .depth = 40}),
            10 + 2 * stack);
  EXPECT_EQ(renderer::paused_ray_words({.kind = StructureKind::kd_sah, .depth = 40}),
            11 + 3 * stack);
  EXPECT_EQ(renderer::paused_ray_words({.kind = StructureKind::bvh_sah, .depth = 40}),
            10 + 2 * stack);
}

TEST(TraceDefines, TheStackHoldsOneMoreThanTheDepthInSteps) {
  for (std::uint32_t depth = 0; depth <= 300; ++depth) {
    const std::uint32_t size = renderer::trace_stack_size(depth);
    EXPECT_GT(size, depth);
    EXPECT_LE(size, depth + 16);
    EXPECT_EQ(size % 16, 0U);
  }
}

}  // namespace
