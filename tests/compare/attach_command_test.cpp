// `encore attach` as a user meets it.
#include "tests/app/profile_json_check.h"
#include "tests/app/run_program.h"
#include "tests/compare/recorded_session.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <map>

namespace encore::app {
namespace {

using test::contains;
using test::TemporaryFolder;

/// A session and a recording in files.
struct Files {
  TemporaryFolder folder;
  RecordedSession recorded = recorded_session();
  std::string session = write_session(folder.path() / "session", recorded.session);
  std::string recording =
      folder.write("meter.csv", recorded.csv({.offset = 123.4, .noise = 1.0})).string();
  std::string out = folder.path() / "new";
};

TEST(AttachCommand, WritesANewSessionAndLeavesTheOldOne) {
  const Files files;
  files.folder.write("session/machine.csv", "time_s,cpu_clock_mhz\n1,2000\n");
  std::map<std::string, std::string> before;
  for (const auto& file : std::filesystem::directory_iterator(files.session)) {
    before[file.path().string()] = test::contents_of(file.path());
  }
  const ProgramResult result =
      run_encore({"attach", files.session, files.recording, "--out", files.out});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "Energy: measured (recording meter.csv, clock +123."))
      << result.out;
  for (const auto& [path, content] : before) EXPECT_EQ(test::contents_of(path), content);
  EXPECT_EQ(test::contents_of(files.out + "/machine.csv"), "time_s,cpu_clock_mhz\n1,2000\n");
  EXPECT_EQ(test::contents_of(files.out + "/frames.csv"),
            test::contents_of(files.session + "/frames.csv"));

  const energy::Session session = energy::read_session(files.out);
  EXPECT_EQ(session.info.state, energy::SessionState::complete);
  for (std::size_t i = 0; i < files.recorded.truths.size(); ++i) {
    expect_within(session.summaries[i].joules, session.summaries[i].joules_ci95,
                  files.recorded.truths[i].joules, 0.06);
  }
  EXPECT_EQ(phase_row(session, "bvh-median", "render").origin, energy::Origin::measured);
  EXPECT_FALSE(session.samples.empty());
  EXPECT_FALSE(session.events.empty());
}

TEST(AttachCommand, JsonGoesToStandardOutputAlone) {
  const Files files;
  const ProgramResult result = run_encore({"attach", files.session, files.recording, "--out",
                                           files.out, "--json", "--offset", "123.4"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(JsonChecker(result.out).valid()) << result.out;
  EXPECT_TRUE(contains(result.out, "\"energy_provenance\": \"measured\""));
  EXPECT_EQ(result.err, "");
}

TEST(AttachCommand, TakesNegativeSeconds) {
  const Files files;
  const std::string early =
      files.folder.write("early.csv", files.recorded.csv({.offset = -50.5})).string();
  const ProgramResult result = run_encore(
      {"attach", files.session, early, "--out", files.out, "--near", "-48", "--within", "4"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "clock -50.")) << result.out;
}

TEST(AttachCommand, RefusalsLeaveNoFolder) {
  const Files files;
  const std::string other =
      files.folder.write("other.csv", recorded_session(77).csv({.noise = 1.0})).string();
  const std::string broken = files.folder.write("broken.csv", "time_s,colour\n1,2\n").string();
  const std::string nowhere = files.folder.path() / "nowhere";
  const auto expect_refused = [&](const std::string& session, const std::string& recording,
                                  const std::string& reason) {
    const ProgramResult result = run_encore({"attach", session, recording, "--out", files.out});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_TRUE(contains(result.err, reason)) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(std::filesystem::exists(files.out));
  };
  expect_refused(files.session, other, "other.csv: ");
  expect_refused(files.session, broken, "broken.csv:1: ");
  expect_refused(files.session, nowhere, "cannot be read");
  expect_refused(nowhere, files.recording, "name a session folder");
}

TEST(AttachCommand, WrongUsageIsTold) {
  const Files files;
  EXPECT_EQ(run_encore({"attach", files.session, files.recording}).exit_code, 2);
  EXPECT_EQ(
      run_encore({"attach", files.session, files.recording, "--out", files.session}).exit_code, 2);
  const ProgramResult both = run_encore({"attach", files.session, files.recording, "--out",
                                         files.out, "--near", "1", "--offset", "1"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(
      run_encore({"attach", files.session, files.recording, "--out", files.out, "--offset", "nan"})
          .exit_code,
      2);
  EXPECT_FALSE(std::filesystem::exists(files.out));
}

}  // namespace
}  // namespace encore::app
