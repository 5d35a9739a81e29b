#include "energy/session_csv.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <locale>
#include <string>
#include <string_view>

namespace encore::energy {
namespace {

using test::contents_of;
using test::TemporaryFolder;

SessionColumns test_columns() {
  return {{"scene", "structure"}, {"nodes", "sah_cost"}};
}

SessionInfo test_info() {
  SessionInfo info;
  info.program = "encore 1.2.3";
  info.command_line = "encore profile 'a scene' --set x=\"1\"";
  info.started_utc = "2026-01-31T23:59:59Z";
  info.machine.cpu_model = "A \"quoted\" processor";
  info.machine.memory_bytes = 1234567890123ULL;
  info.machine.virtual_machine = false;
  info.machine.compiler = "c++";
  info.machine.build_type = "Release";
  info.machine.build_id = "v1.2-3-gabcdef0-dirty";
  info.machine.microcode = "0x2c";
  info.machine.cpu_min_mhz = 800.0;
  info.machine.cpu_max_mhz = 5200.125;
  info.machine.boost = true;
  info.machine.cpu_temperature_c = 48.5;
  info.machine.power_supply = "mains";
  info.machine.container = "docker";
  info.machine.gpus = {"One (amdgpu)", "Two"};
  info.plan.run = Seconds(1.25);
  info.plan.max_operations = 77;
  info.sensor = {Origin::unavailable, "no sensor; a reason"};
  info.scenes = {"toys", "smörgåsbord"};
  info.settings = {{"memory", "pool"}, {"set", "grid.density=1.5"}, {"set", "b=2"}};
  return info;
}

FrameRow test_frame(double time) {
  FrameRow row;
  row.time = Seconds(time);
  row.configuration = {{"scene", "a, \"b\""}, {"structure", "kd-sah"}};
  row.operations = 3;
  row.phases[Phase::build] = Seconds(0.001);
  row.phases[Phase::render] = Seconds(0.0625);
  row.joules[Phase::render] = Joules(1.5);
  return row;
}

SummaryRow test_summary() {
  SummaryRow row = summarise({test_frame(0.0), test_frame(1.0)}, {{{0, 6, 0, 0, 6}}});
  row.counters = {{"nodes", 2551.0}, {"sah_cost", std::nullopt}};
  row.watts = Watts(20.5);
  row.origin = Origin::simulated;
  return row;
}

void write_test_session(const std::filesystem::path& folder) {
  SessionWriter writer(folder, test_info(), test_columns());
  writer.add(test_frame(0.5));
  writer.add(test_frame(0.75));
  writer.add(test_summary());
  writer.finish(SessionState::complete);
}

void expect_equal_times(std::optional<Seconds> a, std::optional<Seconds> b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  EXPECT_DOUBLE_EQ(a.value_or(Seconds(0)).value, b.value_or(Seconds(0)).value);
}

void expect_test_session(const std::filesystem::path& folder) {
  const Session session = read_session(folder);
  SessionInfo info = test_info();
  info.state = SessionState::complete;
  EXPECT_EQ(session.info, info);

  ASSERT_EQ(session.frames.size(), 2U);
  const FrameRow frame = test_frame(0.75);
  EXPECT_EQ(session.frames[1].time, frame.time);
  EXPECT_EQ(session.frames[1].configuration, frame.configuration);
  EXPECT_EQ(session.frames[1].operations, frame.operations);
  EXPECT_EQ(session.frames[1].joules, frame.joules);
  EXPECT_EQ(session.frames[1].origin, frame.origin);
  for (const Phase phase : kPhases) {
    expect_equal_times(session.frames[1].phases[phase], frame.phases[phase]);
  }

  ASSERT_EQ(session.summaries.size(), 1U);
  const SummaryRow summary = test_summary();
  EXPECT_EQ(session.summaries[0].configuration, summary.configuration);
  EXPECT_EQ(session.summaries[0].operations, 6U);
  EXPECT_EQ(session.summaries[0].phase_counts, summary.phase_counts);
  EXPECT_EQ(session.summaries[0].counters, summary.counters);
  EXPECT_EQ(session.summaries[0].shares, summary.shares);
  EXPECT_EQ(session.summaries[0].watts, summary.watts);
  EXPECT_FALSE(session.summaries[0].joules);
  EXPECT_EQ(session.summaries[0].origin, Origin::simulated);
  expect_equal_times(session.summaries[0].mean, summary.mean);
  expect_equal_times(session.summaries[0].ci95, summary.ci95);
  expect_equal_times(session.summaries[0].median, summary.median);
}

TEST(Session, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  write_test_session(folder.path());
  expect_test_session(folder.path());
}

TEST(Session, IsTheSameInEveryLocale) {
  /// A decimal comma and grouped thousands, as in German.
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const TemporaryFolder plain;
  write_test_session(plain.path());
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const TemporaryFolder german;
  write_test_session(german.path());
  expect_test_session(german.path());
  std::locale::global(before);
  for (const char* file : {"session.toml", "frames.csv", "summary.csv", "samples.csv"}) {
    EXPECT_EQ(contents_of(plain.path() / file), contents_of(german.path() / file)) << file;
  }
}

TEST(Session, MissingIsEmptyOrUnavailableButNeverZero) {
  const TemporaryFolder folder;
  write_test_session(folder.path());
  const auto frames = parse_csv(contents_of(folder.path() / "frames.csv"));
  const auto cell = [&](std::string_view column) {
    for (std::size_t i = 0; i < frames[0].size(); ++i) {
      if (frames[0][i] == column) return frames[1][i];
    }
    return std::string("no such column");
  };
  EXPECT_EQ(cell("animate_ms"), "");
  EXPECT_EQ(cell("build_ms"), "1");
  EXPECT_EQ(cell("build_joules"), "unavailable");
  EXPECT_EQ(cell("render_joules"), "1.5");
  EXPECT_EQ(cell("energy_provenance"), "unavailable");
}

TEST(Session, KilledProgramLosesNoFinishedRow) {
  const TemporaryFolder folder;
  int told[2];
  ASSERT_EQ(::pipe(told), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // Write rows until killed, and tell the parent of each one.
    SessionWriter writer(folder.path(), test_info(), test_columns());
    for (int i = 0;; ++i) {
      writer.add(test_frame(i));
      const char done = 1;
      if (::write(told[1], &done, 1) != 1) ::_exit(1);
    }
  }
  ::close(told[1]);
  std::size_t rows = 0;
  for (char done = 0; rows < 50 && ::read(told[0], &done, 1) == 1;) ++rows;
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(told[0]);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(rows, 50U);

  const Session session = read_session(folder.path());
  EXPECT_GE(session.frames.size(), rows);
  EXPECT_EQ(session.info.state, SessionState::running) << "so one sees that it was cut off";
}

TEST(Session, WhatIsWrongIsToldWithItsPlace) {
  const TemporaryFolder folder;
  write_test_session(folder.path());
  const auto message = [&] {
    try {
      read_session(folder.path());
    } catch (const SessionError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string frames = contents_of(folder.path() / "frames.csv");
  const auto header = std::string_view(frames).substr(0, frames.find('\n'));
  const auto separators = static_cast<std::size_t>(std::count(header.begin(), header.end(), ','));
  folder.write("frames.csv", frames + "0.5,a,b,many" + std::string(separators - 3, ',') + "\n");
  EXPECT_NE(message().find("frames.csv, row 3: column operations holds 'many'"), std::string::npos)
      << message();
  for (const char* count : {"-1", "1.5", "nan", "inf", "1e300"}) {
    folder.write("frames.csv",
                 frames + "0.5,a,b," + count + std::string(separators - 3, ',') + "\n");
    EXPECT_NE(message().find("operations holds '" + std::string(count)), std::string::npos)
        << message();
  }
  folder.write("frames.csv", frames + "0.5,a\n");
  EXPECT_NE(message().find("frames.csv, row 3"), std::string::npos) << message();
  folder.write("session.toml", "program = 7\n");
  EXPECT_NE(message().find("session.toml: program"), std::string::npos) << message();
  folder.write("session.toml", "program = \n");
  EXPECT_NE(message().find("session.toml:1"), std::string::npos) << message();
}

TEST(Session, AFolderThatCannotBeWrittenIsTold) {
  EXPECT_THROW(SessionWriter("/nowhere/at/all", test_info(), test_columns()), SessionError);
}

}  // namespace
}  // namespace encore::energy
