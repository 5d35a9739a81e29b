// The table of keys: none twice, each with words, every action of a menu in it.
#include "ui/shortcuts.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace {

using namespace encore::ui;

TEST(ShortcutTable, HasNoKeyTwice) {
  std::set<std::tuple<int, char, bool, bool>> seen;
  for (const Shortcut& s : shortcuts()) {
    EXPECT_TRUE(seen.insert({s.key, s.character, s.control, s.shift}).second) << s.text;
    EXPECT_TRUE((s.key == 0) != (s.character == 0)) << s.text;
  }
  EXPECT_GT(seen.size(), 35U);
}

TEST(ShortcutTable, EveryActionHasKeysAndWords) {
  for (int a = 0; a <= static_cast<int>(Action::escape); ++a) {
    const auto action = static_cast<Action>(a);
    EXPECT_FALSE(shortcut_text(action).empty()) << a;
    bool meant = false;
    for (const Shortcut& s : shortcuts()) meant |= s.action == action && !s.meaning.empty();
    EXPECT_TRUE(meant) << a;
  }
}

TEST(ShortcutTable, GroupsAreInOnePiece) {
  std::set<std::string_view> ended;
  std::string_view group;
  for (const Shortcut& s : shortcuts()) {
    if (s.group == group) continue;
    EXPECT_TRUE(ended.insert(s.group).second) << s.group;
    group = s.group;
  }
}

TEST(ShortcutTable, NamesTheCamerasByNumber) {
  EXPECT_EQ(shortcut_text(Action::recall_camera, 7), "7");
  EXPECT_EQ(shortcut_text(Action::store_camera, 9), "Ctrl+9");
  EXPECT_EQ(shortcut_text(Action::redo), "Ctrl+Shift+Z");
}

}  // namespace
