#include "renderer/gl/program.h"

#include "compute.h"
#include "renderer/gl/error.h"
#include "renderer/gl/program_cache.h"
#include "renderer/gl/shader_source.h"
#include "tests/support/gl_context.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::renderer::gl {
namespace {

using test::contains;
using ProgramTest = test::GlTest;

/// What the shader of the cache's tests cannot be without.
constexpr const char* kGroup = "ENCORE_GROUP_SIZE 64";

std::string failure_of(const std::vector<Program::Stage>& stages) {
  try {
    const Program program("the test program", stages);
  } catch (const GlError& error) {
    return error.what();
  }
  return {};
}

TEST_F(ProgramTest, AnErrorNamesProgramFileAndLine) {
  const std::string message = failure_of({{GL_COMPUTE_SHADER,
                                           "#version 430 core\n"
                                           "#line 1 0\n"
                                           "layout(local_size_x = 1) in;\n"
                                           "#line 41 1\n"
                                           "float broken() { return no_such_name; }\n"
                                           "#line 3 0\n"
                                           "void main() { broken(); }\n",
                                           {"trace.comp", "box_hit.glsl"}}});
  EXPECT_TRUE(contains(message, "the test program: ")) << message;
  EXPECT_TRUE(contains(message, "compute shader")) << message;
  EXPECT_TRUE(contains(message, "box_hit.glsl:41")) << message;
  EXPECT_TRUE(contains(message, "no_such_name")) << message;
  context_->check("a program that does not compile");
}

TEST_F(ProgramTest, AnErrorInAnAssembledShaderIsTracedToItsFile) {
  // A define that takes a type from the shared header.
  ShaderSource source =
      assemble_shader("shared/gpu_types.h", std::vector<std::string>{"vec3 nothing"});
  source.text += "layout(local_size_x = 1) in;\nvoid main() {}\n";
  const std::string message = failure_of({{GL_COMPUTE_SHADER, source.text, source.files}});
  EXPECT_TRUE(contains(message, "shared/gpu_types.h:")) << message;
}

TEST_F(ProgramTest, WhatDoesNotLinkIsRefused) {
  const std::string message = failure_of(
      {{GL_VERTEX_SHADER,
        "#version 430 core\nout vec3 a;\nvoid main() { a = vec3(1); gl_Position = vec4(0); }\n",
        {"a.vert"}},
       {GL_FRAGMENT_SHADER,
        "#version 430 core\nin vec4 a;\nout vec4 c;\nvoid main() { c = a; }\n",
        {"b.frag"}}});
  EXPECT_TRUE(contains(message, "the test program: ")) << message;
  EXPECT_TRUE(contains(message, "link")) << message;
}

TEST_F(ProgramTest, TheCacheCompilesEachSetOfDefinesOnce) {
  ProgramCache& cache = context_->programs();
  const std::size_t before = cache.compiled();
  const auto first = cache.compute("link_parents.comp", {kGroup, "UNUSED 2"});
  EXPECT_EQ(cache.compute("link_parents.comp", {"UNUSED 2", kGroup}), first);
  EXPECT_EQ(cache.compiled(), before + 1);
  const auto second = cache.compute("link_parents.comp", {"UNUSED 3", kGroup});
  EXPECT_NE(second, first);
  EXPECT_NE(second->id(), first->id());
  EXPECT_EQ(cache.compiled(), before + 2);
  const auto drawing = cache.graphics("raster.vert", "raster.frag", {});
  EXPECT_EQ(cache.graphics("raster.vert", "raster.frag", {}), drawing);
  EXPECT_EQ(cache.compiled(), before + 3);
}

TEST_F(ProgramTest, TheCacheKeepsNothingThatFailed) {
  ProgramCache& cache = context_->programs();
  const std::size_t before = cache.compiled();
  EXPECT_THROW(cache.compute("no_such.comp", {}), GlError);
  EXPECT_THROW(cache.compute("link_parents.comp", {kGroup, "main broken("}), GlError);
  EXPECT_EQ(cache.compiled(), before);
}

}  // namespace
}  // namespace encore::renderer::gl
