#include "renderer/gpu_each.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace encore::renderer {

std::shared_ptr<gl::Program> each_program(gl::Context& context, const std::string& file,
                                          std::vector<std::string> defines) {
  defines.push_back("ENCORE_GROUP_SIZE " + std::to_string(kEachGroup));
  return context.programs().compute(file, defines);
}

void run_for_each(const gl::Program& program, std::size_t count) {
  if (count == 0) return;
  // In rows of work groups: a device need not take more than 65,535 of them along an axis.
  constexpr std::size_t kGroupsPerRow = 32768;
  const std::size_t groups = (count + kEachGroup - 1) / kEachGroup;
  const std::size_t columns = std::min(groups, kGroupsPerRow);
  const std::size_t rows = (groups + columns - 1) / columns;
  program.use();
  program.set("thread_count", static_cast<unsigned>(count));
  glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>(rows), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace encore::renderer
