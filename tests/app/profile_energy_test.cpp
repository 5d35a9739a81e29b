// `encore profile` with a simulated sensor: the truth is what the power model says, so what the
// whole chain finds can be held to it, on any machine and at any load.
#include "energy/session_csv.h"
#include "tests/app/run_program.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace encore::app {
namespace {

using test::TemporaryFolder;

constexpr double kIdle = 12.0;
const std::map<std::string, double> kAbove{{"animate", 6.0}, {"build", 20.0}, {"render", 45.0}};
const std::string kTruth = "idle=12,animate=6,build=20,render=45";

struct Profiled {
  ProgramResult program;
  energy::Session session;
};

Profiled profile(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "session").string();
  arguments.insert(arguments.begin(), "profile");
  for (const char* word : {"--quiet", "--out"}) arguments.emplace_back(word);
  arguments.push_back(out);
  Profiled run;
  run.program = run_encore(arguments);
  EXPECT_EQ(run.program.exit_code, 0) << run.program.err;
  if (run.program.exit_code == 0) run.session = energy::read_session(out);
  return run;
}

/// Four half-widths: a rare miss of the 95 % interval is no failure of the program.
void expect_near(double found, std::optional<double> half_width, double truth) {
  ASSERT_TRUE(half_width);
  EXPECT_GT(*half_width, 0.0);
  EXPECT_LT(*half_width, 0.35 * truth) << "so that the test can fail";
  EXPECT_NEAR(found, truth, 2.0 * *half_width + 1e-9);
}

TEST(ProfileEnergy, FindsThePowerOfEachPhaseWithAFastCounter) {
  const Profiled run =
      profile({"toys", "--source", "simulated:rapl", "--model", kTruth, "--structure", "kd-sah",
               "--test", "dynamic", "--size", "192", "--seconds", "1.5", "--idle", "0.5"});
  ASSERT_EQ(run.session.summaries.size(), 1U);
  const energy::SummaryRow& row = run.session.summaries[0];
  EXPECT_EQ(row.origin, energy::Origin::simulated);
  EXPECT_EQ(row.source, "simulated:rapl");
  ASSERT_TRUE(row.idle_watts && row.joules && row.net_joules);
  expect_near(row.idle_watts->value, row.idle_watts_ci95->value, kIdle);
  EXPECT_NEAR(row.joules->value, row.watts->value * row.joules->value / row.watts->value, 1e-12);

  std::size_t told = 0;
  for (const energy::PhaseRow& phase : run.session.phases) {
    const auto above = kAbove.find(phase.phase);
    if (phase.source != "total" || above == kAbove.end() || !phase.watts) continue;
    if (phase.phase == "animate") continue;  // some microseconds a frame
    expect_near(phase.watts->value, phase.watts_ci95->value, kIdle + above->second);
    ++told;
  }
  EXPECT_EQ(told, 2U) << run.program.out;
}

TEST(ProfileEnergy, OnePhaseIsTheWhole) {
  const Profiled run =
      profile({"cow", "--source", "simulated:nvml", "--model", kTruth, "--structure", "bvh-median",
               "--test", "build", "--seconds", "2", "--idle", "1"});
  ASSERT_EQ(run.session.summaries.size(), 1U);
  for (const energy::PhaseRow& phase : run.session.phases) {
    if (phase.phase != "build" || phase.source != "total") continue;
    EXPECT_EQ(phase.method, "whole");
    expect_near(phase.watts->value, phase.watts_ci95->value, kIdle + kAbove.at("build"));
  }
  EXPECT_FALSE(run.session.samples.empty());
  EXPECT_FALSE(run.session.convergence.empty());
  EXPECT_GE(run.session.windows.size(), 3U);
}

TEST(ProfileEnergy, AModelGivesExactlyItsConstants) {
  const Profiled run = profile({"cow", "--model", kTruth, "--structure", "bvh-median", "--test",
                                "static", "--size", "64", "--seconds", "0.5"});
  ASSERT_EQ(run.session.summaries.size(), 1U);
  EXPECT_EQ(run.session.summaries[0].origin, energy::Origin::modelled);
  EXPECT_NE(run.session.info.sensor.detail.find("render 45 W"), std::string::npos)
      << run.session.info.sensor.detail;
  for (const energy::PhaseRow& phase : run.session.phases) {
    if (phase.phase == "render" && phase.source == "total") {
      EXPECT_NEAR(phase.watts->value, kIdle + 45.0, 1.5);
    }
  }
}

TEST(ProfileEnergy, WithoutASourceNothingIsZero) {
  const Profiled run = profile({"cow", "--source", "none", "--structure", "bvh-median", "--test",
                                "build", "--seconds", "0.1"});
  ASSERT_EQ(run.session.summaries.size(), 1U);
  EXPECT_EQ(run.session.summaries[0].origin, energy::Origin::unavailable);
  EXPECT_FALSE(run.session.summaries[0].watts);
  EXPECT_FALSE(run.session.summaries[0].joules);
  EXPECT_TRUE(run.session.samples.empty());
  EXPECT_TRUE(run.session.phases.empty());
  EXPECT_NE(run.program.out.find("unavailable (no power source was asked for"), std::string::npos)
      << run.program.out;
}

TEST(ProfileEnergy, ASourceThatIsNotThereEndsWithItsReason) {
  const TemporaryFolder folder;
  const ProgramResult none = run_encore(
      {"profile", "cow", "--source", "battery", "--sysfs-root", folder.path().string(), "--quiet"});
  EXPECT_EQ(none.exit_code, 4) << none.err;
  EXPECT_NE(none.err.find("--source battery"), std::string::npos) << none.err;
  const ProgramResult wrong = run_encore({"profile", "cow", "--source", "batery"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("battery"), std::string::npos) << wrong.err;
  EXPECT_EQ(run_encore({"profile", "cow", "--model", "idle=1,rendr=2"}).exit_code, 2);
  EXPECT_EQ(run_encore({"profile", "cow", "--until", "-1%"}).exit_code, 2);
  EXPECT_EQ(run_encore({"profile", "cow", "--plan", "thesys"}).exit_code, 2);
}

TEST(ProfileEnergy, MeasuresUntilItIsKnownWellEnough) {
  const Profiled run =
      profile({"cow", "--source", "none", "--structure", "grid-box", "--test", "build", "--seconds",
               "0.2", "--until", "20%", "--until-limit", "2"});
  ASSERT_EQ(run.session.summaries.size(), 1U);
  ASSERT_FALSE(run.session.events.empty());
  EXPECT_NE(run.session.events.back().message.find("20 % of time_per_operation"), std::string::npos)
      << run.session.events.back().message;
}

}  // namespace
}  // namespace encore::app
