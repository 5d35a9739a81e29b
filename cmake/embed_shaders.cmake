# Turns shader files into one C++ file that defines encore::renderer::gl::shader_files(), so that the
# program needs no files when it runs. Called by shaders/CMakeLists.txt:
#   cmake -DROOT=<shaders/> -DFILES=<a|b|…, below ROOT> -DOUTPUT=<file.cpp> -P embed_shaders.cmake
string(REPLACE "|" ";" files "${FILES}")

include("${CMAKE_CURRENT_LIST_DIR}/text_literal.cmake")

set(texts "")
set(table "")
set(index 0)
foreach(file IN LISTS files)
  encore_text_literal(text "${ROOT}/${file}")
  string(APPEND texts "constexpr std::string_view kText${index} =\n${text};\n")
  string(APPEND table "    {\"${file}\", kText${index}},\n")
  math(EXPR index "${index} + 1")
endforeach()

file(WRITE "${OUTPUT}"
"// Generated from shaders/ by cmake/embed_shaders.cmake; edits are lost.
#include \"renderer/gl/shader_source.h\"

namespace encore::renderer::gl {
namespace {

${texts}
constexpr ShaderFile kFiles[] = {
${table}};

}  // namespace

std::span<const ShaderFile> shader_files() { return kFiles; }

}  // namespace encore::renderer::gl
")
