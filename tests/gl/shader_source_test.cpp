// How shaders are put together from the files inside the program, and messages traced back.
#include "renderer/gl/shader_source.h"

#include "renderer/gl/error.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace encore::renderer::gl {
namespace {

namespace fs = std::filesystem;
using test::contains;
using Names = std::vector<std::string>;

std::map<std::string, std::string> files_on_disk() {
  const fs::path root = fs::path(ENCORE_SOURCE_DIR) / "shaders";
  const std::set<std::string> kinds{".glsl", ".comp", ".vert", ".frag", ".h"};
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!kinds.contains(entry.path().extension().string())) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    found[entry.path().lexically_relative(root).generic_string()] =
        std::string(std::istreambuf_iterator<char>(in), {});
  }
  return found;
}

TEST(ShaderFiles, AreInTheProgramByteForByte) {
  const auto on_disk = files_on_disk();
  ASSERT_TRUE(on_disk.contains("shared/gpu_types.h"));
  std::map<std::string, std::string> embedded;
  for (const ShaderFile& file : shader_files()) embedded.emplace(file.name, file.text);
  EXPECT_EQ(embedded.size(), shader_files().size()) << "a name twice";
  ASSERT_EQ(embedded.size(), on_disk.size());
  for (const auto& [name, text] : on_disk) {
    ASSERT_TRUE(embedded.contains(name)) << name;
    EXPECT_EQ(embedded[name], text) << name;
  }
}

TEST(ShaderFiles, AreOfTheCharactersThatEveryCompilerReads) {
  for (const ShaderFile& file : shader_files()) {
    EXPECT_TRUE(std::all_of(file.text.begin(), file.text.end(), [](unsigned char c) {
      return c == '\n' || (c >= 0x20 && c < 0x7f);
    })) << file.name;
  }
}

/// All lines that #line numbers tell of, as "file:line" -> text; fails if one comes twice.
std::map<std::string, std::string> numbered_lines(const ShaderSource& source) {
  std::map<std::string, std::string> found;
  std::istringstream in(source.text);
  int number = 1;
  std::string file;
  for (std::string line; std::getline(in, line); ++number) {
    std::size_t index = 0;
    int next = 0;
    if (std::sscanf(line.c_str(), "#line %d %zu", &next, &index) == 2) {
      file = source.files.at(index);
      number = next - 1;
    } else if (!file.empty()) {
      const std::string place = file + ":" + std::to_string(number);
      EXPECT_TRUE(found.emplace(place, line).second) << place << " comes twice";
    }
  }
  return found;
}

TEST(AssembleShader, BeginsWithTheVersionAndTheDefines) {
  const ShaderSource source = assemble_shader("shared/gpu_types.h", Names{"COUNTERS", "KIND 2"});
  EXPECT_TRUE(
      source.text.starts_with("#version 430 core\n#define COUNTERS\n#define KIND 2\n#line 1 0\n"))
      << source.text.substr(0, 100);
  EXPECT_EQ(source.files, Names{"shared/gpu_types.h"});
}

TEST(AssembleShader, LeavesNothingOfCPlusPlusAndKeepsLineNumbers) {
  const ShaderSource source = assemble_shader("shared/gpu_types.h", {});
  EXPECT_FALSE(contains(source.text, "#include"));
  const auto lines = numbered_lines(source);
  std::istringstream in(files_on_disk().at("shared/gpu_types.h"));
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string place = "shared/gpu_types.h:" + std::to_string(++number);
    EXPECT_EQ(lines.at(place), line.starts_with("#include") ? "" : line) << place;
  }
}

TEST(AssembleShader, EveryShaderHasEachFileOnceAndEveryLineAtItsNumber) {
  const auto on_disk = files_on_disk();
  bool nested = false;
  for (const auto& [name, text] : on_disk) {
    SCOPED_TRACE(name);
    const ShaderSource source = assemble_shader(name, {});
    EXPECT_FALSE(contains(source.text, "#include"));
    EXPECT_EQ(source.files.at(0), name);
    EXPECT_EQ(std::set<std::string>(source.files.begin(), source.files.end()).size(),
              source.files.size());
    nested = nested || source.files.size() > 2;
    const auto lines = numbered_lines(source);
    for (const std::string& file : source.files) {
      std::istringstream in(on_disk.at(file));
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.starts_with('#')) continue;  // those are what assembling changes
        const auto found = lines.find(file + ":" + std::to_string(number));
        ASSERT_NE(found, lines.end()) << file << ":" << number;
        EXPECT_EQ(found->second, line) << file << ":" << number;
      }
    }
  }
  EXPECT_TRUE(nested) << "no shader includes two files, so that this tested little";
}

TEST(AssembleShader, AFileThatIsNotThereIsNamed) {
  try {
    assemble_shader("no_such.comp", {});
    FAIL() << "it was found";
  } catch (const GlError& error) {
    EXPECT_TRUE(contains(error.what(), "no shader file 'no_such.comp'")) << error.what();
  }
}

TEST(ReadableLog, UnderstandsWhatDriversWrite) {
  const Names files{"trace.comp", "box_hit.glsl"};
  const auto readable = [&](const char* log) { return readable_log(log, files); };
  // Mesa; NVIDIA; AMD, Intel and ANGLE.
  EXPECT_EQ(readable("1:14(3): error: syntax error"), "box_hit.glsl:14(3): error: syntax error");
  EXPECT_EQ(readable("0(14) : error C0000: syntax error"),
            "trace.comp:14 : error C0000: syntax error");
  EXPECT_EQ(readable("ERROR: 1:7: 'x' : undeclared"), "ERROR: box_hit.glsl:7: 'x' : undeclared");
  EXPECT_EQ(readable("WARNING: 0:7: unused"), "WARNING: trace.comp:7: unused");
}

TEST(ReadableLog, KeepsEveryOtherLine) {
  const Names files{"trace.comp"};
  for (const char* log :
       {"", "\n", "no line number\n", "7:14(3): error", "0: no line", "0(14: broken", "(3): odd",
        "ERROR: 2 compilation errors.  No code generated.\n", "at 0:14",
        "99999999999999999999:1"}) {
    EXPECT_EQ(readable_log(log, files), log);
  }
  EXPECT_EQ(readable_log("0:1(2): a\ntext\n0:3(4): b\n", files),
            "trace.comp:1(2): a\ntext\ntrace.comp:3(4): b\n");
}

}  // namespace
}  // namespace encore::renderer::gl
