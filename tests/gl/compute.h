#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/fence.h"
#include "renderer/gl/program.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace encore::renderer::gl::test_support {

/// A compute program of this text alone.
inline Program compute_program(const std::string& text) {
  return Program("a test's shader", {{GL_COMPUTE_SHADER, text, {"test.comp"}}});
}

/// Runs `groups` groups of what is bound, to the end.
inline void run(const Program& program, unsigned groups) {
  program.use();
  glDispatchCompute(groups, 1, 1);
  finish("a test's shader");
}

inline std::vector<std::uint32_t> words_of(const Buffer& buffer, std::size_t count,
                                           std::size_t offset = 0) {
  std::vector<std::uint32_t> words(count);
  buffer.read(std::as_writable_bytes(std::span(words)), offset);
  return words;
}

}  // namespace encore::renderer::gl::test_support
