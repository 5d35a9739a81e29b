#pragma once

#include "renderer/gl/context.h"
#include "renderer/gl/program.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace encore::renderer {

/// Threads of a work group.
inline constexpr std::size_t kEachGroup = 128;

/// The program of a compute shader that includes shaders/each.glsl, with further defines.
std::shared_ptr<gl::Program> each_program(gl::Context& context, const std::string& file,
                                          std::vector<std::string> defines = {});

/// Runs it with one thread for each of `count` things; nothing for none. What it writes into
/// storage buffers is seen by whatever is sent afterwards.
void run_for_each(const gl::Program& program, std::size_t count);

}  // namespace encore::renderer
