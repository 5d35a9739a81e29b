# Turns shader files into one C++ file that defines encore::renderer::gl::shader_files(), so that the
# program needs no files when it runs. Called by shaders/CMakeLists.txt:
#   cmake -DROOT=<shaders/> -DFILES=<a|b|…, below ROOT> -DOUTPUT=<file.cpp> -P embed_shaders.cmake
string(REPLACE "|" ";" files "${FILES}")

# Compilers need not take longer string literals than 16 KiB.
set(piece_length 15000)
set(close ")encore\"")

set(texts "")
set(table "")
set(index 0)
foreach(file IN LISTS files)
  file(READ "${ROOT}/${file}" text)
  string(FIND "${text}" "${close}" found)
  if(NOT found EQUAL -1)
    message(FATAL_ERROR "${ROOT}/${file}: must not contain ${close}, which ends a string in C++")
  endif()
  string(APPEND texts "constexpr std::string_view kText${index} =\n")
  string(LENGTH "${text}" length)
  set(start 0)
  while(start EQUAL 0 OR start LESS length)
    string(SUBSTRING "${text}" ${start} ${piece_length} piece)
    string(APPEND texts "R\"encore(${piece}${close}\n")
    math(EXPR start "${start} + ${piece_length}")
  endwhile()
  string(APPEND texts ";\n")
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
