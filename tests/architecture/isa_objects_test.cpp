// What is compiled once an instruction set shares nothing with the rest of the program: a function
// that an object file brings along for others to link, but with instructions that the processor may
// not have, would crash far away from where it came from.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace {

/// "isa object file", a line each.
std::map<std::string, std::vector<std::string>> objects_by_isa() {
  std::map<std::string, std::vector<std::string>> objects;
  std::ifstream in(ENCORE_ISA_OBJECTS);
  std::string isa, file;
  while (in >> isa && std::getline(in >> std::ws, file)) objects[isa].push_back(file);
  return objects;
}

/// The lines of `nm`; fails if it does.
std::vector<std::string> symbols_of(const std::string& object) {
  const std::string command = std::string("'") + ENCORE_NM + "' -C --defined-only '" + object + "'";
  std::vector<std::string> lines;
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) {
    ADD_FAILURE() << "cannot run " << command;
    return lines;
  }
  std::string line;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    lines.push_back(line);
    line.clear();
  }
  EXPECT_EQ(pclose(pipe), 0) << command;
  return lines;
}

struct Symbol {
  char kind;
  std::string name;
};

/// From "address kind name".
Symbol symbol_of(const std::string& line) {
  const std::size_t kind = line.find(' ');
  if (kind == std::string::npos || kind + 3 > line.size()) return {' ', line};
  return {line[kind + 1], line.substr(kind + 3)};
}

bool is_weak(const Symbol& symbol) {
  return std::string("WwVvu").find(symbol.kind) != std::string::npos;
}

bool belongs_to(const std::string& name, const std::string& isa) {
  // Where exceptions are handled is a pointer, not code.
  return name.find("encore::accel::" + isa + "::") != std::string::npos ||
         name.starts_with("DW.ref.__gxx_personality");
}

TEST(IsaObjects, ShareNoFunctionWithTheRestOfTheProgram) {
  if (std::string(ENCORE_NM).empty()) GTEST_SKIP() << "there is no nm";
  const auto objects = objects_by_isa();
  ASSERT_TRUE(objects.contains("portable"));
  for (const auto& [isa, files] : objects) {
    std::size_t own = 0;
    for (const std::string& file : files) {
      for (const std::string& line : symbols_of(file)) {
        const Symbol symbol = symbol_of(line);
        own += belongs_to(symbol.name, isa) ? 1 : 0;
        EXPECT_FALSE(is_weak(symbol) && !belongs_to(symbol.name, isa)) << file << ": " << line;
        // What everyone may call is in the namespace as well.
        EXPECT_FALSE(symbol.kind == 'T' && !belongs_to(symbol.name, isa)) << file << ": " << line;
      }
    }
    EXPECT_GT(own, 0U) << isa;
  }
}

TEST(IsaObjects, AreToldFromOthersByTheirNames) {
  EXPECT_TRUE(is_weak(symbol_of("0000000000000000 W std::max(float, float)")));
  EXPECT_FALSE(is_weak(symbol_of("0000000000000040 T encore::accel::avx2::single_kernels()")));
  EXPECT_TRUE(belongs_to("encore::accel::avx2::single_kernels()", "avx2"));
  EXPECT_FALSE(belongs_to("encore::accel::avx2::single_kernels()", "avx512"));
  EXPECT_FALSE(belongs_to("float const& std::max<float>(float const&, float const&)", "avx2"));
}

}  // namespace
