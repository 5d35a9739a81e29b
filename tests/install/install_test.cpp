// What `cmake --install` leaves is whole, and works wherever it is moved.
#include "run_command.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace encore::test {
namespace {

namespace fs = std::filesystem;

CommandResult install(const fs::path& prefix, const fs::path& destination = {}) {
  return run_command("DESTDIR=" + shell_word(destination.string()) + " " +
                     shell_word(ENCORE_CMAKE) + " --install " + shell_word(ENCORE_BUILD_DIR) +
                     " --prefix " + shell_word(prefix.string()));
}

/// The program of an installation, started in an empty home.
CommandResult run_installed(const fs::path& program, const fs::path& home,
                            const std::string& arguments) {
  fs::create_directories(home);
  return run_command("cd " + shell_word(home.string()) + " && HOME=" + shell_word(home.string()) +
                     " XDG_DATA_HOME= " + shell_word(program.string()) + " " + arguments);
}

TEST(Install, HoldsTheProgramWhatItReadsAndWhatADesktopShows) {
  const TemporaryFolder folder;
  const CommandResult result = install("/usr", folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.output;

  const fs::path usr = folder.path() / "usr";
  for (const char* file :
       {"bin/encore", "share/encore/scenes/jelly.toml", "share/encore/studies/quick.toml",
        "share/encore/studies/thesis.toml", "share/encore/thesis/appendix_a_build.csv",
        "share/applications/encore.desktop", "share/metainfo/invalid.encore.encore.metainfo.xml",
        "share/icons/hicolor/scalable/apps/encore.svg", "share/doc/encore/README.md",
        "share/doc/encore/copyright", "share/doc/encore/docs/manual.md",
        "share/doc/encore/docs/images/toys.png"}) {
    std::error_code error;
    EXPECT_GT(fs::file_size(usr / file, error), 0U) << file;
    EXPECT_FALSE(error) << file;
  }
  for (const char* side : {"16", "32", "48", "64", "128", "256", "512"}) {
    const std::string size = std::string(side) + "x" + side;
    EXPECT_TRUE(fs::exists(usr / "share/icons/hicolor" / size / "apps/encore.png")) << size;
  }
  EXPECT_TRUE(fs::exists(usr / "share/man/man1/encore.1.gz") ||
              fs::exists(usr / "share/man/man1/encore.1"));
}

TEST(Install, PutsNothingAnywhereElse) {
  const TemporaryFolder folder;
  ASSERT_EQ(install("/usr", folder.path()).exit_code, 0);
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_EQ(entry.path().filename(), "usr");
  }
  for (const auto& entry : fs::directory_iterator(folder.path() / "usr")) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "bin" || name == "share") << name;
  }
}

TEST(Install, AMovedProgramFindsItsScenesAndStudies) {
  const TemporaryFolder folder;
  const CommandResult result = install(folder.path() / "first place");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const fs::path moved = folder.path() / "second place";
  fs::rename(folder.path() / "first place", moved);
  // Names that no other installation on this machine can have.
  const fs::path share = moved / "share" / "encore";
  fs::copy_file(share / "scenes" / "jelly.toml", share / "scenes" / "only-here.toml");
  fs::copy_file(share / "studies" / "quick.toml", share / "studies" / "only-here.toml");

  const fs::path home = folder.path() / "home";
  const auto info = run_installed(moved / "bin" / "encore", home, "info only-here");
  EXPECT_EQ(info.exit_code, 0) << info.output;
  const auto study = run_installed(moved / "bin" / "encore", home, "study only-here --dry-run");
  EXPECT_EQ(study.exit_code, 0) << study.output;
  EXPECT_TRUE(fs::is_empty(home));
}

TEST(Install, AProgramAloneSaysWhatIsMissingAndWhereItLooked) {
  if (fs::exists(ENCORE_SHARE_FOLDER)) {
    GTEST_SKIP() << "encore is installed on this machine: " << ENCORE_SHARE_FOLDER;
  }
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "bin");
  fs::copy_file(ENCORE_BINARY, folder.path() / "bin" / "encore");
  const std::string looked = "looked in " + (folder.path() / "share" / "encore").string();
  for (const char* arguments : {"info jelly", "study quick --dry-run"}) {
    const auto run =
        run_installed(folder.path() / "bin" / "encore", folder.path() / "home", arguments);
    EXPECT_EQ(run.exit_code, 3) << run.output;
    EXPECT_NE(run.output.find(looked), std::string::npos) << run.output;
    EXPECT_NE(run.output.find("install the program again"), std::string::npos) << run.output;
  }
}

TEST(Install, AnUnknownStudyIsAnswered) {
  const auto run = run_command(shell_word(ENCORE_BINARY) + " study quikc --dry-run");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.output.find("did you mean 'quick'? (the studies that ship: quick, thesis)"),
            std::string::npos)
      << run.output;
}

}  // namespace
}  // namespace encore::test
