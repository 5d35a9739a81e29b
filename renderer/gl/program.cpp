#include "renderer/gl/program.h"

#include "renderer/gl/error.h"
#include "renderer/gl/shader_source.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <string_view>

namespace encore::renderer::gl {

namespace {

std::string_view stage_name(GLenum kind) {
  switch (kind) {
    case GL_COMPUTE_SHADER:
      return "compute shader";
    case GL_VERTEX_SHADER:
      return "vertex shader";
    case GL_FRAGMENT_SHADER:
      return "fragment shader";
    default:
      return "shader";
  }
}

/// The log of a shader or program, without what follows its end. Drivers end it by nothing, a line
/// break or a zero.
template <class Get, class GetLog>
std::string log_of(GLuint id, Get get, GetLog get_log) {
  GLint length = 0;
  get(id, GL_INFO_LOG_LENGTH, &length);
  if (length <= 0) return "(the driver gives no reason)";
  std::string log(static_cast<std::size_t>(length), '\0');
  GLsizei written = 0;
  get_log(id, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  while (!log.empty() && (log.back() == '\n' || log.back() == '\0')) log.pop_back();
  return log;
}

struct Shader {
  explicit Shader(GLenum kind) : id(glCreateShader(kind)) {}
  ~Shader() { glDeleteShader(id); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  const GLuint id;
};

void compile_into(GLuint program, const std::string& name, const Program::Stage& stage) {
  const Shader shader(stage.kind);
  const char* text = stage.source.data();
  const auto length = static_cast<GLint>(stage.source.size());
  glShaderSource(shader.id, 1, &text, &length);
  glCompileShader(shader.id);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id, GL_COMPILE_STATUS, &compiled);
  if (compiled != GL_TRUE) {
    const std::string log = log_of(shader.id, glGetShaderiv, glGetShaderInfoLog);
    throw GlError(fmt::format("{}: the graphics driver does not compile the {}:\n{}", name,
                              stage_name(stage.kind), readable_log(log, stage.files)));
  }
  // Deleted above as soon as the program lets go of it.
  glAttachShader(program, shader.id);
}

}  // namespace

Program::Program(const std::string& name, const std::vector<Stage>& stages)
    : id_(glCreateProgram()) {
  try {
    for (const Stage& stage : stages) compile_into(id_, name, stage);
    glLinkProgram(id_);
    GLint linked = GL_FALSE;
    glGetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
      throw GlError(fmt::format("{}: the graphics driver does not link the program:\n{}", name,
                                log_of(id_, glGetProgramiv, glGetProgramInfoLog)));
    }
  } catch (...) {
    glDeleteProgram(id_);
    throw;
  }
}

Program::~Program() {
  if (id_ != 0) glDeleteProgram(id_);
}

void Program::use() const {
  glUseProgram(id_);
}

void Program::set(const char* name, int value) const {
  glProgramUniform1i(id_, glGetUniformLocation(id_, name), value);
}

void Program::set(const char* name, unsigned value) const {
  glProgramUniform1ui(id_, glGetUniformLocation(id_, name), value);
}

void Program::set(const char* name, int x, int y) const {
  glProgramUniform2i(id_, glGetUniformLocation(id_, name), x, y);
}

}  // namespace encore::renderer::gl
