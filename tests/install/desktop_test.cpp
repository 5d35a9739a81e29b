// Desktops can read what tells them of the program.
#include "run_command.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::test {
namespace {

const std::string kDesktop = ENCORE_SOURCE_DIR "/assets/desktop/";

TEST(Desktop, TheEntryIsValid) {
  if (std::string(ENCORE_DESKTOP_FILE_VALIDATE).empty()) {
    GTEST_SKIP() << "desktop-file-validate is missing: apt-get install desktop-file-utils";
  }
  const auto result = run_command(shell_word(ENCORE_DESKTOP_FILE_VALIDATE) + " " +
                                  shell_word(kDesktop + "encore.desktop"));
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output, "");
}

TEST(Desktop, TheMetainfoIsValid) {
  if (std::string(ENCORE_APPSTREAMCLI).empty()) {
    GTEST_SKIP() << "appstreamcli is missing: apt-get install appstream";
  }
  const auto result = run_command(shell_word(ENCORE_APPSTREAMCLI) + " validate --no-net " +
                                  shell_word(kDesktop + "encore.metainfo.xml"));
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST(Desktop, EntryAndMetainfoNameWhatIsInstalled) {
  const std::string entry = contents_of(kDesktop + "encore.desktop");
  EXPECT_NE(entry.find("\nExec=encore %f\n"), std::string::npos);
  EXPECT_NE(entry.find("\nIcon=encore\n"), std::string::npos);
  const std::string metainfo = contents_of(kDesktop + "encore.metainfo.xml");
  EXPECT_NE(metainfo.find("<launchable type=\"desktop-id\">encore.desktop<"), std::string::npos);
  EXPECT_NE(metainfo.find("<binary>encore</binary>"), std::string::npos);
}

TEST(Desktop, IconsHaveTheSizeThatTheyAreInstalledAs) {
  for (const int side : {16, 32, 48, 64, 128, 256, 512}) {
    const std::string size = std::to_string(side);
    const std::string png = contents_of(kDesktop + "icons/" + size + "x" + size + "/encore.png");
    ASSERT_GT(png.size(), 24U) << size;
    // A PNG's header holds width and height at bytes 16 and 20, the high byte first.
    const auto number = [&png](std::size_t at) {
      return static_cast<unsigned char>(png[at + 2]) * 256 +
             static_cast<unsigned char>(png[at + 3]);
    };
    EXPECT_EQ(number(16), side);
    EXPECT_EQ(number(20), side);
  }
}

}  // namespace
}  // namespace encore::test
