#include "renderer/gl/program_cache.h"

#include "renderer/gl/shader_source.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace encore::renderer::gl {

namespace {

/// Sorts them, and returns what tells this program from others: "trace.comp COUNTERS KIND 2".
std::string name_of(std::string_view files, std::vector<std::string>& defines) {
  std::sort(defines.begin(), defines.end());
  defines.erase(std::unique(defines.begin(), defines.end()), defines.end());
  std::string name(files);
  for (const std::string& define : defines) name += ", " + define;
  return name;
}

Program::Stage stage(std::uint32_t kind, std::string_view file,
                     const std::vector<std::string>& defines) {
  ShaderSource source = assemble_shader(file, defines);
  return {kind, std::move(source.text), std::move(source.files)};
}

}  // namespace

std::shared_ptr<Program> ProgramCache::compute(std::string_view file,
                                               std::vector<std::string> defines) {
  const std::string name = name_of(file, defines);
  if (const auto found = programs_.find(name); found != programs_.end()) return found->second;
  auto program = std::make_shared<Program>(
      name, std::vector<Program::Stage>{stage(GL_COMPUTE_SHADER, file, defines)});
  programs_.emplace(name, program);
  return program;
}

std::shared_ptr<Program> ProgramCache::graphics(std::string_view vertex_file,
                                                std::string_view fragment_file,
                                                std::vector<std::string> defines) {
  const std::string files = std::string(vertex_file) + " + " + std::string(fragment_file);
  const std::string name = name_of(files, defines);
  if (const auto found = programs_.find(name); found != programs_.end()) return found->second;
  auto program = std::make_shared<Program>(
      name, std::vector<Program::Stage>{stage(GL_VERTEX_SHADER, vertex_file, defines),
                                        stage(GL_FRAGMENT_SHADER, fragment_file, defines)});
  programs_.emplace(name, program);
  return program;
}

}  // namespace encore::renderer::gl
