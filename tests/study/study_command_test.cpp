#include "energy/session_csv.h"
#include "tests/app/run_program.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::app {
namespace {

using test::contents_of;
using test::TemporaryFolder;

const std::string kStudy = R"(name = "small"
source = "none"
[plan]
name = "quick"
seconds = 0.02
warm_up_s = 0
repeats = 2
order = "abba"
[[group]]
name = "g"
scenes = ["triangle", "scissors"]
structures = ["bvh-median", "grid-box"]
tests = ["build", "forced"]
policies = ["rebuild", "refit"]
update_cases = ["best"]
sizes = [16]
)";
// Two scenes: bvh builds and updates, grid builds, each alone and before a frame.
constexpr std::size_t kTests = 2 * (3 + 3);

struct StudyFolder {
  TemporaryFolder folder;
  std::string file = (folder.path() / "small.toml").string();
  std::string session = (folder.path() / "session").string();

  StudyFolder() { folder.write("small.toml", kStudy); }
};

TEST(StudyCommand, DryRunTellsWhatItWouldDoAndWritesNothing) {
  const StudyFolder study;
  const ProgramResult run = run_encore({"study", study.file, "--dry-run"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("12 tests described, 12 measured, each 2 times"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("24 runs are left: at least 0.48 s"), std::string::npos) << run.out;
  EXPECT_FALSE(std::filesystem::exists(study.session));
}

TEST(StudyCommand, MeasuresEveryTestOnceARepeatIntoOneSession) {
  const StudyFolder study;
  const ProgramResult run = run_encore({"study", study.file, "--out", study.session, "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const energy::Session session = energy::read_session(study.session);
  EXPECT_EQ(session.info.state, energy::SessionState::complete);
  EXPECT_EQ(session.summaries.size(), 2 * kTests);
  EXPECT_EQ(session.summaries.front().configuration.front().value, "g");
}

TEST(StudyCommand, ResumesAfterACrashWithoutRepeatingWhatIsDone) {
  const StudyFolder study;
  ASSERT_EQ(run_encore({"study", study.file, "--out", study.session, "--quiet"}).exit_code, 0);
  // As a crash in the middle leaves it: some summaries, and a part of the next row.
  const std::filesystem::path summary = std::filesystem::path(study.session) / "summary.csv";
  std::string text = contents_of(summary);
  std::size_t end = 0;
  for (int line = 0; line < 6; ++line) end = text.find('\n', end) + 1;
  study.folder.write("session/summary.csv", text.substr(0, end + 10));
  const energy::Session before = energy::read_session(study.session);
  ASSERT_EQ(before.summaries.size(), 5U);

  const ProgramResult run = run_encore({"study", study.file, "--resume", study.session});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("5 of 24 runs are done already"), std::string::npos) << run.err;
  const energy::Session after = energy::read_session(study.session);
  ASSERT_EQ(after.summaries.size(), 2 * kTests);
  for (std::size_t i = 0; i < before.summaries.size(); ++i) {
    EXPECT_EQ(after.summaries[i], before.summaries[i]) << "kept as it was";
  }
  for (std::size_t i = 1; i < after.frames.size(); ++i) {
    ASSERT_GE(after.frames[i].time, after.frames[i - 1].time) << "one clock for the whole session";
  }

  const ProgramResult again = run_encore({"study", study.file, "--resume", study.session});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(energy::read_session(study.session).summaries.size(), 2 * kTests);
}

TEST(StudyCommand, RefusesToGoOnWithAnotherStudy) {
  const StudyFolder study;
  ASSERT_EQ(run_encore({"study", study.file, "--out", study.session, "--quiet"}).exit_code, 0);
  study.folder.write("small.toml", kStudy + "threads = 1\n");
  const ProgramResult run = run_encore({"study", study.file, "--resume", study.session});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("its file has changed"), std::string::npos) << run.err;
}

TEST(StudyCommand, ErrorsNameTheirPlace) {
  const StudyFolder study;
  study.folder.write("small.toml", "[[group]]\nname = \"g\"\nscenes = [\"tois\"]\n");
  const ProgramResult run = run_encore({"study", study.file, "--dry-run"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("small.toml:1:1: group g: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("toys"), std::string::npos) << "the nearest name: " << run.err;
  const ProgramResult missing = run_encore({"study", "nowhere.toml"});
  EXPECT_EQ(missing.exit_code, 3);
}

}  // namespace
}  // namespace encore::app
