#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace encore::renderer::gl {

/// A file of shaders/ as it was when the program was built.
struct ShaderFile {
  std::string_view name;  ///< below shaders/: "box_hit.glsl", "shared/bindings.h"
  std::string_view text;
};
/// All of them.
std::span<const ShaderFile> shader_files();

/// The source of one shader stage, put together: #version 430 core, one #define for each of
/// `defines` ("NAME" or "NAME value"), then the file with its #include "…" lines (relative to
/// shaders/) resolved, each file once. #line directives number the files, so that a compiler's
/// message can be traced back.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  ///< by the number that #line uses
};
/// Throws GlError for a file that is not there.
ShaderSource assemble_shader(std::string_view file, std::span<const std::string> defines);

/// A compiler's log with "2(14)" or "2:14" at the start of a line turned into "box_hit.glsl:14".
std::string readable_log(std::string_view log, std::span<const std::string> files);

}  // namespace encore::renderer::gl
