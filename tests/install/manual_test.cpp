// The manual inside the program is docs/manual.md, and of the Markdown that the window draws.
#include "help_text.h"
#include "run_command.h"
#include "scene/shipped_files.h"
#include "tests/support/files.h"
#include "ui/manual_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace encore::test {
namespace {

std::vector<std::string> lines() {
  std::vector<std::string> all;
  std::istringstream text{std::string(ui::manual_text())};
  for (std::string line; std::getline(text, line);) all.push_back(line);
  return all;
}

TEST(Manual, IsTheDocumentByteForByte) {
  const std::string document = contents_of(ENCORE_SOURCE_DIR "/docs/manual.md");
  ASSERT_GT(document.size(), 5000U);
  EXPECT_TRUE(ui::manual_text() == document) << "docs/manual.md has changed since the build";
}

TEST(Manual, HoldsNoMarkdownThatTheWindowDoesNotDraw) {
  static const std::regex heading(R"(#{1,3} \S.*)");
  static const std::regex unknown(R"(\*\*|__|\]\(|!\[|^```|^>|^\d+\. |^\* |^\s+\S|\s$)");
  for (const std::string& line : lines()) {
    if (line.rfind('#', 0) == 0) {
      EXPECT_TRUE(std::regex_match(line, heading)) << line;
    }
    EXPECT_FALSE(std::regex_search(line, unknown)) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), '`') % 2, 0) << line;
  }
}

TEST(Manual, ItsTablesHaveAsManyCellsInEachRow) {
  std::ptrdiff_t bars = 0;
  int rows = 0;
  for (const std::string& line : lines()) {
    const auto here = line.rfind('|', 0) == 0 ? std::count(line.begin(), line.end(), '|') : 0;
    if (bars != 0 && here != 0) {
      EXPECT_EQ(here, bars) << line;
    }
    bars = here;
    rows += here != 0 ? 1 : 0;
  }
  EXPECT_GT(rows, 20);
}

TEST(Manual, HasOnlyLettersThatTheWindowsFontHas) {
  // Latin-1 as UTF-8: ASCII, or a pair that begins with C2 or C3.
  const std::string_view text = ui::manual_text();
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x80) continue;
    ASSERT_TRUE(c == 0xC2 || c == 0xC3) << text.substr(i > 30 ? i - 30 : 0, 60);
    ++i;
  }
}

TEST(Manual, NamesEveryCommandAndEveryShippedScene) {
  const std::string text(ui::manual_text());
  const auto commands = commands_of(help_text());
  ASSERT_FALSE(commands.empty());
  for (const std::string& command : commands) {
    EXPECT_NE(text.find("`encore " + command), std::string::npos) << command;
  }
  for (const std::string& scene : scene::shipped_names("scenes")) {
    EXPECT_NE(text.find('`' + scene + '`'), std::string::npos) << scene;
  }
}

}  // namespace
}  // namespace encore::test
