// The manual page says what --help says.
#include "help_text.h"
#include "run_command.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace encore::test {
namespace {

std::string page() {
  return contents_of(ENCORE_SOURCE_DIR "/assets/desktop/encore.1");
}

/// The lines between a heading and the next.
std::string section(const std::string& name) {
  const std::string text = page();
  const std::size_t start = text.find(".SH " + name + "\n");
  if (start == std::string::npos) return {};
  return text.substr(start, text.find("\n.SH ", start + 1) - start);
}

/// The first words of a section's entries.
std::set<std::string> entries(const std::string& name) {
  static const std::regex pattern(R"(\.TP\n\.(?:B|BR|I|BI) "?([A-Za-z0-9]+))");
  const std::string text = section(name);
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    found.insert((*match)[1]);
  }
  return found;
}

TEST(ManualPage, HasEveryCommandOfHelpAndNoOther) {
  const auto commands = commands_of(help_text());
  ASSERT_GE(commands.size(), 11U);
  EXPECT_EQ(entries("COMMANDS"), std::set<std::string>(commands.begin(), commands.end()));
}

TEST(ManualPage, HasEveryExitCodeOfHelpAndNoOther) {
  const auto codes = exit_codes_of(help_text());
  ASSERT_GE(codes.size(), 9U);
  std::set<std::string> numbers;
  const std::string status = section("EXIT STATUS");
  for (const auto& [code, words] : codes) {
    numbers.insert(std::to_string(code));
    const std::string entry = ".B " + std::to_string(code) + "\n" + words;
    EXPECT_NE(status.find(entry), std::string::npos) << entry;
  }
  EXPECT_EQ(entries("EXIT STATUS"), numbers);
}

TEST(ManualPage, HasOnlyOptionsThatSomeCommandHas) {
  const std::string program = shell_word(ENCORE_BINARY);
  std::string help = help_text();
  for (const std::string& command : commands_of(help)) {
    help += run_command(program + " " + command + " --help").output;
  }
  static const std::regex pattern(R"(\\-\\-([a-z]+(?:\\-[a-z]+)*))");
  const std::string text = page();
  int count = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    const std::string option =
        "--" + std::regex_replace((*match)[1].str(), std::regex(R"(\\)"), "");
    EXPECT_NE(help.find(option), std::string::npos) << option;
    ++count;
  }
  EXPECT_GT(count, 15);
}

TEST(ManualPage, IsOfThisVersion) {
  EXPECT_NE(page().find("\"ENCORE " ENCORE_VERSION "\""), std::string::npos);
}

TEST(ManualPage, IsWellFormed) {
  if (std::string(ENCORE_MANDOC).empty()) {
    GTEST_SKIP() << "mandoc is missing: apt-get install mandoc";
  }
  const auto lint = run_command(shell_word(ENCORE_MANDOC) + " -T lint -W warning " +
                                shell_word(ENCORE_SOURCE_DIR "/assets/desktop/encore.1"));
  EXPECT_EQ(lint.exit_code, 0) << lint.output;
}

}  // namespace
}  // namespace encore::test
