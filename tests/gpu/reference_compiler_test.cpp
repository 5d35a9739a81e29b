// Drivers accept different dialects of GLSL, and tests meet few of them: so Khronos' reference
// compiler, which accepts the standard only, must accept every variant of every shader.
#include "renderer/gl/shader_source.h"
#include "renderer/trace_defines.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace encore;
using renderer::TraceOutput;
using renderer::TraceVariant;

/// Compiles with glslangValidator; what it says, empty if nothing is wrong. `stage`: comp, vert,
/// frag.
std::string complaints(const std::string& file, const std::string& stage,
                       const std::vector<std::string>& defines) {
  const test::TemporaryFolder folder;
  const auto shader =
      folder.write("shader." + stage, renderer::gl::assemble_shader(file, defines).text);
  const auto log = folder.path() / "log";
  const std::string command = std::string(ENCORE_GLSLANG) + " -s -S " + stage + " \"" +
                              shader.string() + "\" > \"" + log.string() + "\" 2>&1";
  if (std::system(command.c_str()) == 0) return {};
  return "refused:\n" + test::contents_of(log);
}

class ReferenceCompiler : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(ENCORE_GLSLANG).empty()) {
      GTEST_SKIP() << "glslangValidator was not there when the tests were configured (Debian: "
                      "glslang-tools)";
    }
  }
};

TEST_F(ReferenceCompiler, NoticesWhatIsNoGlsl) {
  EXPECT_NE(complaints("trace.comp", "comp", {"ENCORE_GROUP_X 8"}), "") << "a size is missing";
}

TEST_F(ReferenceCompiler, AcceptsEveryWayToTrace) {
  for (const auto kind : {accel::StructureKind::grid_box, accel::StructureKind::kd_sah,
                          accel::StructureKind::bvh_median, accel::StructureKind::bvh_sah}) {
    for (const auto output :
         {TraceOutput::picture, TraceOutput::hits, TraceOutput::counters, TraceOutput::ray_hits,
          TraceOutput::path_hits, TraceOutput::shadows}) {
      for (const int pausing : {0, 1, 2}) {
        const TraceVariant variant{.kind = kind,
                                   .depth = 40,
                                   .output = output,
                                   .pause_after = pausing > 0 ? 2048U : 0U,
                                   .resumable = pausing > 1};
        EXPECT_EQ(complaints("trace.comp", "comp", renderer::trace_defines(variant)), "")
            << accel::to_string(kind) << ", output " << static_cast<int>(output) << ", pausing "
            << pausing;
      }
    }
  }
}

TEST_F(ReferenceCompiler, AcceptsEveryWayToShade) {
  for (unsigned bits = 0; bits < 32; ++bits) {
    std::vector<std::string> defines;
    if ((bits & 1U) != 0) defines.emplace_back("ENCORE_NORMALS");
    if ((bits & 2U) != 0) defines.emplace_back("ENCORE_COLORS");
    if ((bits & 4U) != 0) defines.emplace_back("ENCORE_SPECULAR");
    if ((bits & 8U) != 0) defines.emplace_back("ENCORE_LIGHTS");
    if ((bits & 16U) != 0) defines.emplace_back("ENCORE_TEXTURES");
    EXPECT_EQ(complaints("raster.frag", "frag", defines), "") << bits;
    const TraceVariant variant{.needs = {.normals = (bits & 1U) != 0,
                                         .colors = (bits & 2U) != 0,
                                         .textures = (bits & 16U) != 0,
                                         .specular = (bits & 4U) != 0},
                               .lights = (bits & 8U) != 0};
    EXPECT_EQ(complaints("trace.comp", "comp", renderer::trace_defines(variant)), "") << bits;
  }
  EXPECT_EQ(complaints("raster.vert", "vert", {}), "");
}

TEST_F(ReferenceCompiler, AcceptsEveryPassOfPaths) {
  using renderer::PathPass;
  const auto expect_accepted = [](PathPass pass, const scene::Needs& needs, unsigned bits) {
    const std::string file = renderer::path_pass_file(pass);
    EXPECT_EQ(complaints(file, "comp", renderer::path_pass_defines(pass, needs)), "")
        << file << ", " << bits;
  };
  for (const bool several : {false, true}) {
    expect_accepted(PathPass::start, {.samples = several}, 0);
    expect_accepted(PathPass::finish, {.samples = several}, 0);
  }
  for (unsigned bits = 0; bits < 32; ++bits) {
    const bool lit = (bits & 1U) != 0;
    const bool detailed = (bits & 2U) != 0;
    const scene::Needs needs{.lights = lit,
                             .normals = detailed,
                             .colors = lit && detailed,
                             .textures = lit && detailed,
                             .highlights = lit && detailed,
                             .shadows = lit && (bits & 4U) != 0,
                             .reflections = (bits & 8U) != 0,
                             .refractions = (bits & 16U) != 0};
    expect_accepted(PathPass::scatter, needs, bits);
    if (needs.shadows) expect_accepted(PathPass::light, needs, bits);
  }
}

TEST_F(ReferenceCompiler, SeesNothingOfWhatPlainScenesDoNotNeed) {
  const test::TemporaryFolder folder;
  const auto left_of = [&](const TraceVariant& variant) {
    const auto shader = folder.write(
        "shader.comp",
        renderer::gl::assemble_shader("trace.comp", renderer::trace_defines(variant)).text);
    const auto left = folder.path() / "left";
    const std::string command = std::string(ENCORE_GLSLANG) + " -E -S comp \"" + shader.string() +
                                "\" > \"" + left.string() + "\" 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return test::contents_of(left);
  };
  TraceVariant variant{.depth = 9, .needs = {.normals = true, .specular = true}, .lights = true};
  const std::string plain = left_of(variant);
  variant.needs.textures = true;
  const std::string textured = left_of(variant);
  variant.output = TraceOutput::shadows;
  const std::string shadows = left_of(variant);
  for (const char* word : {"texture_color", "texcoords"}) {
    EXPECT_EQ(plain.find(word), std::string::npos) << word;
    EXPECT_NE(textured.find(word), std::string::npos) << word;
  }
  for (const char* word : {"paths", "path_queues", "shadow_rays", "Bounce", "WaitingRay"}) {
    EXPECT_EQ(plain.find(word), std::string::npos) << word;
    EXPECT_EQ(textured.find(word), std::string::npos) << word;
  }
  EXPECT_NE(shadows.find("shadow_rays"), std::string::npos);
  EXPECT_EQ(plain.find("light_in_hand"), std::string::npos);
  EXPECT_EQ(plain.find("sample_offset"), std::string::npos);
}

TEST_F(ReferenceCompiler, AcceptsEveryWayToRefitAndBuild) {
  for (const char* update_case : {"ENCORE_UPDATE_REAL", "ENCORE_UPDATE_BEST",
                                  "ENCORE_UPDATE_AVERAGE", "ENCORE_UPDATE_WORST"}) {
    EXPECT_EQ(complaints("refit.comp", "comp", {update_case, "ENCORE_GROUP_SIZE 128"}), "")
        << update_case;
  }
  for (const char* file : {"link_parents.comp", "link_wide.comp", "refit_wide.comp",
                           "build_bounds.comp", "build_keys.comp", "build_tree.comp",
                           "sort_count.comp", "sort_scan.comp", "sort_scatter.comp"}) {
    EXPECT_EQ(complaints(file, "comp", {"ENCORE_GROUP_SIZE 128"}), "") << file;
  }
}

TEST_F(ReferenceCompiler, AcceptsEveryWayToDrawAnOverlay) {
  for (const char* part : {"fill", "edge"}) {
    for (const std::vector<std::string>& defines :
         {std::vector<std::string>{}, std::vector<std::string>{"BOXES"}}) {
      const std::string file = std::string("overlay_") + part;
      EXPECT_EQ(complaints(file + ".vert", "vert", defines), "") << defines.size();
      EXPECT_EQ(complaints(file + ".frag", "frag", defines), "") << defines.size();
    }
  }
  EXPECT_EQ(complaints("overlay_backdrop.vert", "vert", {}), "");
  EXPECT_EQ(complaints("overlay_backdrop.frag", "frag", {}), "");
}

}  // namespace
