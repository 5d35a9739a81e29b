// Keys of very many parts are told before the parser spends its stack on them.
#include "energy/toml_depth.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::energy {
namespace {

std::string key_of(std::size_t parts, const std::string& part = "a") {
  std::string key = part;
  for (std::size_t i = 1; i < parts; ++i) key += "." + part;
  return key;
}

TEST(TomlDepth, OneLimitForEveryKindOfKey) {
  EXPECT_FALSE(line_of_deep_key(""));
  EXPECT_FALSE(line_of_deep_key(key_of(kMostKeyParts) + " = 1\n"));
  const std::string deep = key_of(kMostKeyParts + 1);
  EXPECT_EQ(line_of_deep_key(deep + " = 1\n"), 1U);
  EXPECT_EQ(line_of_deep_key("b = 1\n\n[" + deep + "]\n"), 3U);
  EXPECT_EQ(line_of_deep_key("b = {c = 1, " + deep + " = 1}\n"), 1U);
  EXPECT_EQ(line_of_deep_key(key_of(kMostKeyParts + 1, "\"a\"")), 1U);
  EXPECT_EQ(line_of_deep_key(key_of(kMostKeyParts + 1, " 'a' ")), 1U);
}

TEST(TomlDepth, DotsElsewhereAreNoKeys) {
  const std::string dots(100, '.');
  EXPECT_FALSE(line_of_deep_key("a = \"" + dots + "\" # " + dots + "\n"));
  EXPECT_FALSE(line_of_deep_key("a = '" + dots + "'\n"));
  EXPECT_FALSE(line_of_deep_key("a = \"\\\"" + dots + "\"\n"));
  EXPECT_FALSE(line_of_deep_key("a = \"\"\"\n" + dots + "\" \"\"" + dots + "\"\"\"\"\n"));
  EXPECT_FALSE(line_of_deep_key("a = '''" + dots + "\n" + dots + "'''\n"));
  std::string numbers = "a = [1.5";
  for (int i = 0; i < 100; ++i) numbers += ", 1.5";
  EXPECT_FALSE(line_of_deep_key(numbers + "]\n"));
  // What follows a string counts again.
  EXPECT_EQ(line_of_deep_key("a = '''" + dots + "\n'''\n" + key_of(kMostKeyParts + 1)), 3U);
  // No string hides what comes behind it by having no end.
  EXPECT_EQ(line_of_deep_key("a = 'b\n" + key_of(kMostKeyParts + 1)), 2U);
}

}  // namespace
}  // namespace encore::energy
