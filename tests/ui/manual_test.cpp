// The manual's Markdown is read whole, and its own text has what the reader expects.
#include "ui/manual.h"

#include "ui/manual_text.h"
#include "ui/shortcuts.h"

#include <gtest/gtest.h>

namespace {

using namespace encore::ui;
using Kind = ManualBlock::Kind;

TEST(ManualText, IsReadIntoBlocks) {
  const Manual manual = parse_manual(
      "# Title\n\nWords with `code` inside.\n- one\n- two `2`\n\n## Chapter\n"
      "| key | does |\n|---|---|\n| F1 | `a|b` |\n### Part\nunclosed ` tick");
  ASSERT_EQ(manual.blocks.size(), 8U);
  EXPECT_EQ(manual.blocks[0].level, 1);
  EXPECT_EQ(manual.blocks[1].line,
            (ManualLine{{"Words with ", false}, {"code", true}, {" inside.", false}}));
  EXPECT_EQ(manual.blocks[2].kind, Kind::bullet);
  EXPECT_EQ(manual.blocks[5].kind, Kind::table);
  ASSERT_EQ(manual.blocks[5].rows.size(), 2U);
  EXPECT_EQ(plain_text(manual.blocks[5].rows[1][1]), "a|b");
  EXPECT_EQ(plain_text(manual.blocks[7].line), "unclosed ` tick");
  EXPECT_EQ(manual.chapters, (std::vector<std::size_t>{4, 6}));
}

TEST(ManualText, OddTablesKeepTheirColumns) {
  const Manual manual = parse_manual("| a | b |\n|---|---|\n| only one |\n| 1 | 2 | 3 |\n|");
  ASSERT_EQ(manual.blocks.size(), 1U);
  for (const auto& row : manual.blocks[0].rows) EXPECT_EQ(row.size(), 2U);
}

TEST(ManualText, IsSearched) {
  const Manual manual = parse_manual("# A\nThe Kd-tree.\n| x |\n|---|\n| a KD-Tree |\n");
  EXPECT_EQ(search_manual(manual, " kd-tree "), (std::vector<std::size_t>{1, 2}));
  EXPECT_TRUE(search_manual(manual, "").empty());
  EXPECT_TRUE(search_manual(manual, "octree").empty());
}

TEST(ManualText, OwnManualHasChaptersAndTheKeys) {
  const Manual manual = parse_manual(manual_text());
  EXPECT_GT(manual.chapters.size(), 8U);
  for (const char* words : {"provenance", "recording", "heatmap", "Escape"}) {
    EXPECT_FALSE(search_manual(manual, words).empty()) << words;
  }
}

}  // namespace
