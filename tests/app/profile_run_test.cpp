#include "app/profile_run.h"

#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "app/profile_folder.h"
#include "energy/session_csv.h"
#include "tests/app/profile_fakes.h"
#include "tests/app/profile_json_check.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

namespace encore::app {
namespace {

using test::TemporaryFolder;

/// Sets an environment variable for the length of a test.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

class Profile : public testing::Test {
 protected:
  Profile() {
    options.quiet = true;
    options.measuring.seconds = 0.0;
    options.measuring.sources = {"none"};  // whatever this machine has
    options.size = "16x8";
    options.scenes = {"triangle"};
    options.structures = {"brute", "bvh-median"};
    options.out = (folder.path() / "session").string();
  }
  ProfileResult run_it() {
    Terminal terminal(true);
    return run_profile(options, fakes.tools(), stop, terminal);
  }
  energy::Session session() { return energy::read_session(options.out); }

  TemporaryFolder folder;
  ProfileOptions options;
  FakeTools fakes;
  std::atomic<bool> stop{false};
};

TEST_F(Profile, MeasuresEveryTestOfEveryStructureThatApplies) {
  const ProfileResult result = run_it();
  EXPECT_EQ(result.code, ExitCode::ok);
  const energy::Session s = session();
  EXPECT_EQ(s.info.state, energy::SessionState::complete);
  EXPECT_EQ(s.info.scenes, std::vector<std::string>{"triangle"});
  EXPECT_EQ(s.info.sensor.origin, energy::Origin::unavailable);
  EXPECT_FALSE(s.info.sensor.detail.empty());
  // Two structures, build and static; a still scene has no dynamic test.
  ASSERT_EQ(s.summaries.size(), 4U);
  std::uint64_t operations = 0;
  for (const auto& summary : s.summaries) {
    EXPECT_EQ(summary.operations, 3U) << "the least number, for no time at all";
    EXPECT_FALSE(summary.joules);
    operations += summary.operations;
  }
  std::uint64_t in_rows = 0;
  for (const auto& frame : s.frames) in_rows += frame.operations;
  EXPECT_EQ(in_rows, operations);
}

TEST_F(Profile, JsonHoldsAResultForEachConfiguration) {
  options.json = true;
  const std::string json = run_it().output;
  EXPECT_TRUE(JsonChecker(json).valid()) << json;
  std::size_t results = 0;
  for (std::size_t at = 0; (at = json.find("\"ms_per_operation\":", at)) != std::string::npos;
       ++at) {
    ++results;
  }
  EXPECT_EQ(results, 4U);
}

TEST_F(Profile, PoliciesThatComeToTheSameAreMeasuredOnce) {
  options.policies = {"rebuild", "refit"};
  options.tests = {"build", "static"};
  fakes.can_refit = false;
  run_it();
  EXPECT_EQ(session().summaries.size(), 4U);
  fakes.can_refit = true;
  options.out += "-refits";
  run_it();
  EXPECT_EQ(session().summaries.size(), 6U) << "builds, updates and frames of two structures";
}

TEST_F(Profile, InterruptKeepsWhatWasMeasured) {
  const WorkloadTools tools = [&] {
    WorkloadTools t = fakes.tools();
    // Interrupt while the second structure's renderer is made: the first one is done by then.
    t.make_renderer = [this, renderers = 0](Device,
                                            int) mutable -> std::unique_ptr<renderer::Renderer> {
      if (++renderers == 2) stop = true;
      return std::make_unique<FakeRenderer>(fakes.frames);
    };
    return t;
  }();
  Terminal terminal(true);
  const ProfileResult result = run_profile(options, tools, stop, terminal);
  EXPECT_EQ(result.code, ExitCode::interrupted);
  EXPECT_NE(result.output.find("(interrupted)"), std::string::npos);
  EXPECT_NE(result.output.find("brute"), std::string::npos);
  const energy::Session s = session();
  EXPECT_EQ(s.info.state, energy::SessionState::interrupted);
  EXPECT_EQ(s.summaries.size(), 3U) << "all but the second structure's frames";
}

TEST_F(Profile, AWrongStructureEndsTheRunWithItsOwnExitCode) {
  fakes.lie = true;
  testing::internal::CaptureStderr();
  const ProfileResult result = run_it();
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_EQ(result.code, ExitCode::mismatch);
  EXPECT_NE(message.find("differ from brute force"), std::string::npos) << message;
  EXPECT_NE(message.find("direction ("), std::string::npos) << message;
  EXPECT_EQ(session().info.state, energy::SessionState::failed);
  EXPECT_TRUE(session().frames.empty()) << "it was never timed";
}

TEST_F(Profile, NothingIsEverOverwritten) {
  run_it();
  EXPECT_THROW(run_it(), UsageError);
  const std::string file = (folder.path() / "file").string();
  std::ofstream(file) << "mine";
  options.out = file;
  EXPECT_THROW(run_it(), UsageError);
  options.out = (folder.path() / "empty").string();
  std::filesystem::create_directory(options.out);
  EXPECT_EQ(run_it().code, ExitCode::ok) << "an empty folder is fine";
}

TEST_F(Profile, AFolderThatCannotBeMadeIsOneClearMessage) {
  options.out = "/proc/encore/session";
  try {
    run_it();
    FAIL();
  } catch (const energy::SessionError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot make the folder /proc/encore/session"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(Profile, SessionsGoToTheUsersDataByDefault) {
  const Environment data("XDG_DATA_HOME", (folder.path() / "data").string());
  const auto parent = folder.path() / "data" / "encore" / "sessions";
  EXPECT_EQ(make_session_folder("", "2026-01-31T23:59:59Z", "toys"),
            parent / "20260131T235959Z-toys");
  EXPECT_EQ(make_session_folder("", "2026-01-31T23:59:59Z", "toys"),
            parent / "20260131T235959Z-toys-2")
      << "two runs in one second do not share a folder";
  EXPECT_EQ(make_session_folder("", "2026-01-31T23:59:59Z", "../a b").filename(),
            "20260131T235959Z-..-a-b");
}

TEST_F(Profile, ARelativeDataFolderIsIgnoredAsXdgAsks) {
  const Environment data("XDG_DATA_HOME", "relative");
  const Environment home("HOME", folder.path().string());
  const auto made = make_session_folder("", "2026-01-31T23:59:59Z", "toys");
  EXPECT_EQ(made.parent_path(), folder.path() / ".local" / "share" / "encore" / "sessions");
}

TEST_F(Profile, WrongWordsAreUsageErrorsBeforeAnythingIsWritten) {
  const auto wrong = [&](auto&& change) {
    const ProfileOptions before = options;
    change();
    EXPECT_THROW(run_it(), UsageError);
    EXPECT_FALSE(std::filesystem::exists(options.out));
    options = before;
  };
  wrong([&] { options.tests = {"stetic"}; });
  wrong([&] { options.policies = {"refiit"}; });
  wrong([&] { options.devices = {"cpu", "gpo"}; });
  wrong([&] {
    options.devices = {"gpu"};
    options.structures = {"brute"};
  });
  wrong([&] {
    options.devices = {"raster"};
    options.tests = {"build", "forced"};
  });
  wrong([&] { options.size = "0"; });
  wrong([&] { options.update_case = "typical"; });
  wrong([&] { options.presets = {"slow"}; });
  wrong([&] { options.groupings = {"pairs"}; });
  wrong([&] { options.tests = {"dynamic"}; });  // a still scene: nothing is left to measure
}

/// The whole command, with the program's own structures and renderer.
TEST(ProfileCommand, MeasuresASampleSceneFromTheCommandLine) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "s").string();
  CLI::App app;
  ExitCode code = ExitCode::failure;
  add_profile_command(app, code);
  testing::internal::CaptureStdout();
  app.parse("profile --quiet --json --source none --seconds 0.01 --size 32 --threads 1 --out " +
            out + " triangle");
  const std::string json = testing::internal::GetCapturedStdout();
  EXPECT_EQ(code, ExitCode::ok);
  EXPECT_TRUE(JsonChecker(json).valid()) << json;
  const energy::Session session = energy::read_session(out);
  EXPECT_EQ(session.summaries.size(), 2 * (accel::all_structure_kinds().size() - 1))
      << "all but brute, build and static";
}

TEST(ProfileCommand, MeasuresAMovingSceneUnderEveryPolicy) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "s").string();
  CLI::App app;
  ExitCode code = ExitCode::failure;
  add_profile_command(app, code);
  testing::internal::CaptureStdout();
  app.parse(
      "profile toys --quiet --source none --seconds 0.01 --size 16 --structure bvh-median,grid-box "
      "--test "
      "dynamic --policy rebuild,refit,auto,static --out " +
      out);
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(code, ExitCode::ok);
  const energy::Session session = energy::read_session(out);
  ASSERT_EQ(session.summaries.size(), 4U + 2U) << "a grid's refit is its rebuild";
  for (const auto& row : session.summaries) {
    const std::string& policy = row.configuration[4].value;
    if (policy == "auto") {
      EXPECT_EQ(row.phase_counts[energy::Phase::build] + row.phase_counts[energy::Phase::update],
                row.operations);
      continue;
    }
    EXPECT_EQ(row.phase_counts[energy::Phase::build], policy == "rebuild" ? row.operations : 0);
    EXPECT_EQ(row.phase_counts[energy::Phase::update], policy == "refit" ? row.operations : 0);
  }
}

TEST(ProfileCommand, InterruptGivesItsExitCode) {
  const TemporaryFolder folder;
  CLI::App app;
  ExitCode code = ExitCode::ok;
  add_profile_command(app, code);
  interrupted = true;
  testing::internal::CaptureStdout();
  app.parse("profile triangle --quiet --source none --out " + (folder.path() / "s").string());
  const std::string text = testing::internal::GetCapturedStdout();
  interrupted = false;
  EXPECT_EQ(code, ExitCode::interrupted);
  EXPECT_NE(text.find("Nothing was measured."), std::string::npos) << text;
}

}  // namespace
}  // namespace encore::app
