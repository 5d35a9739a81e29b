#include "scene/text_suggestion.h"

#include <gtest/gtest.h>

#include <array>

namespace encore::scene {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"translate", "rotate", "scale", "bvh-median",
                                                    "fit"};

TEST(TextSuggestion, FindsSlipsOfEachKind) {
  EXPECT_EQ(closest_name("translte", kNames), "translate");    // one missing
  EXPECT_EQ(closest_name("transslate", kNames), "translate");  // one too many
  EXPECT_EQ(closest_name("sccle", kNames), "scale");           // a wrong one
  EXPECT_EQ(closest_name("roatte", kNames), "rotate");         // two swapped
  EXPECT_EQ(closest_name("Scale", kNames), "scale");           // other case
  EXPECT_EQ(closest_name("bvh_median", kNames), "bvh-median");
}

TEST(TextSuggestion, SaysNothingWhenNothingIsNear) {
  EXPECT_EQ(closest_name("elephant", kNames), "");
  EXPECT_EQ(closest_name("x", kNames), "");
  EXPECT_EQ(closest_name("", kNames), "");
  EXPECT_EQ(closest_name(std::string(10000, 's'), kNames), "");
  EXPECT_EQ(closest_name("scale", {}), "");
}

TEST(TextSuggestion, OfEquallyNearNamesTheFirstIsTaken) {
  constexpr std::array<std::string_view, 2> names = {"kd-sah", "kd-sat"};
  EXPECT_EQ(closest_name("kd-sax", names), "kd-sah");
}

TEST(TextSuggestion, WordsItAsAQuestion) {
  EXPECT_EQ(did_you_mean("scal", kNames), "; did you mean 'scale'?");
  EXPECT_EQ(did_you_mean("elephant", kNames), "");
}

}  // namespace
}  // namespace encore::scene
