#include "app/window/opened_session.h"

#include "energy/session_csv.h"
#include "recording_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

namespace encore::app {
namespace {

namespace fs = std::filesystem;

energy::SessionInfo info_of(const char* sensor) {
  energy::SessionInfo info;
  info.program = "encore 0.1.0";
  info.started_utc = "2026-01-31T12:00:00Z";
  info.machine.compiler = "compiler";
  info.machine.build_type = "Release";
  info.plan.name = "window";
  info.sensor = {energy::Origin::simulated, sensor};
  energy::SessionSource source;
  source.info.name = sensor;
  source.info.domain = energy::Domain::package;
  source.info.update_period = energy::Seconds(0.01);
  source.info.poll_period = energy::Seconds(0.01);
  source.info.gain_uncertainty = 0.0;
  source.info.provenance = info.sensor;
  source.in_total = true;
  info.sources = {source};
  return info;
}

/// A session of one configuration: 50 frames a second at so many watts, `seconds` long.
struct Written {
  double watts = 50.0;
  double frame = 0.020;
  double seconds = 4.0;
  bool windows = true;  ///< false: as a kill leaves it
};

void write(const fs::path& folder, const Written& written) {
  fs::create_directory(folder);
  energy::SessionWriter writer(folder, info_of("simulated:a"),
                               {configuration_columns(), counter_columns()});
  const std::vector<energy::KeyValue> configuration = RecordingWorld::slot_of("cpu").configuration;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const double load = 1.0;  // begins after a second of idling
  const auto joules = [&](double t) {
    return 20.0 * t + (written.watts - 20.0) * std::max(0.0, t - load);
  };
  double next_sample = 0.0;
  const auto sample_until = [&](double t) {
    for (; next_sample <= t; next_sample += 0.01) {
      energy::SampleRow row;
      row.time = energy::Seconds(next_sample);
      row.source = "simulated:a";
      row.joules = energy::Joules(joules(next_sample));
      row.origin = energy::Origin::simulated;
      writer.add(row);
    }
  };
  sample_until(load);
  writer.add(energy::WindowRow{configuration, "idle", energy::Seconds(0), energy::Seconds(load)});
  double t = load;
  while (t < load + written.seconds) {
    energy::FrameRow row;
    row.time = energy::Seconds(t);
    row.configuration = configuration;
    row.operations = 1;
    row.phases[energy::Phase::render] =
        energy::Seconds(written.frame * (1.0 + 0.02 * normal(random)));
    t += row.phases[energy::Phase::render]->value;
    writer.add(row);
    sample_until(t);
  }
  sample_until(t + 0.02);
  if (written.windows) {
    writer.add(
        energy::WindowRow{configuration, "measured", energy::Seconds(load), energy::Seconds(t)});
  }
}

OpenedSession open(const fs::path& folder) {
  TaskControl control;
  return read_opened_session(folder, control);
}

std::string error_of(const fs::path& folder) {
  try {
    (void)open(folder);
  } catch (const energy::SessionError& error) {
    return error.what();
  }
  return "no error";
}

TEST(OpenedSession, FiguresOfASessionThatWasKilledAreComputed) {
  const TemporaryFolder folder;
  for (const bool windows : {true, false}) {
    const fs::path name = folder / (windows ? "with" : "without");
    write(name, {50.0, 0.020, 4.0, windows});
    const OpenedSession opened = open(name);
    EXPECT_TRUE(opened.cut_off);
    EXPECT_TRUE(opened.recomputed);
    EXPECT_EQ(opened.remarks.size(), 2U);
    ASSERT_EQ(opened.bars.size(), 1U);
    const ConfigurationBars& bars = opened.bars[0];
    EXPECT_NEAR(bars.seconds.value, 0.020, 0.0004);
    ASSERT_TRUE(bars.joules) << bars.energy.detail;
    EXPECT_NEAR(bars.joules->value, 50.0 * 0.020, 0.02);
    ASSERT_TRUE(bars.net_joules);
    EXPECT_NEAR(bars.net_joules->value, 30.0 * 0.020, 0.02);
    ASSERT_FALSE(bars.phases.empty());
    EXPECT_EQ(bars.phases[0].method, "whole");
    EXPECT_FALSE(opened.session.convergence.empty());
  }
}

TEST(OpenedSession, ARowThatWasCutOffIsLeftOutAndSaidSo) {
  const TemporaryFolder folder;
  write(folder / "s", {});
  const std::size_t before = open(folder / "s").series[0].points.size();
  std::ofstream(folder / "s/samples.csv", std::ios::app) << "5.5,simul";
  const OpenedSession opened = open(folder / "s");
  EXPECT_EQ(opened.series[0].points.size(), before);
  EXPECT_EQ(opened.remarks.front(), "samples.csv: the last row was cut off and is left out");
}

TEST(OpenedSession, AFileThatNeverGotItsHeaderIsEmpty) {
  const TemporaryFolder folder;
  write(folder / "s", {});
  std::ofstream(folder / "s/events.csv", std::ios::trunc).flush();
  const OpenedSession opened = open(folder / "s");
  EXPECT_TRUE(opened.session.events.empty());
  EXPECT_EQ(opened.remarks.front(), "events.csv has no header: nothing was written to it");
}

TEST(OpenedSession, ABadFolderGetsOneLine) {
  const TemporaryFolder folder;
  const std::string none = (folder / "none").string();
  EXPECT_EQ(error_of(none), none + " is no folder; open a session folder");
  fs::create_directory(folder / "empty");
  EXPECT_NE(error_of(folder / "empty").find("it has no session.toml"), std::string::npos);
  write(folder / "s", {});
  std::ofstream(folder / "s/samples.csv", std::ios::app) << "x,simulated:a,,,1,0,simulated\n";
  EXPECT_NE(error_of(folder / "s").find("samples.csv, row "), std::string::npos);
  EXPECT_EQ(error_of(folder / "s").find('\n'), std::string::npos);
  write(folder / "gone", {});
  fs::remove(folder / "gone/frames.csv");
  EXPECT_NE(error_of(folder / "gone").find("cannot read"), std::string::npos);
}

TEST(OpenedSession, ANewerFormatIsNamed) {
  const TemporaryFolder folder;
  write(folder / "s", {});
  std::ofstream(folder / "s/samples.csv", std::ios::trunc)
      << "time_s,source,watts,joules,changed,restarted,provenance,volts\n1,a,,,1,0,measured,5\n";
  EXPECT_NE(error_of(folder / "s").find("the column 'volts' is not one"), std::string::npos);
  EXPECT_NE(error_of(folder / "s").find("newer version"), std::string::npos);
}

TEST(OpenedSession, ReadingIsCancelled) {
  const TemporaryFolder folder;
  write(folder / "s", {});
  SessionOpener opener;
  opener.start([&folder](TaskControl& control) {
    control.stop = true;
    return open_for_window(folder / "s", control);
  });
  const auto result = opener.wait();
  EXPECT_TRUE(result.cancelled);
  EXPECT_FALSE(result.value);
  EXPECT_EQ(result.error, "");
  // The same task reads the next one.
  opener.start([&folder](TaskControl& control) { return open_for_window(folder / "s", control); });
  EXPECT_EQ(opener.progress() <= 1.0, true);
  const auto again = opener.wait();
  ASSERT_TRUE(again.value);
  EXPECT_EQ((*again.value)->bars.size(), 1U);
}

TEST(OpenedSession, TwoSessionsAreCompared) {
  const TemporaryFolder folder;
  write(folder / "a", {50.0, 0.020, 8.0, true});
  write(folder / "b", {50.0, 0.030, 8.0, true});
  const OpenedSession a = open(folder / "a");
  const OpenedSession b = open(folder / "b");
  const OpenedComparison comparison = compare_opened(a, b);
  ASSERT_EQ(comparison.matched.size(), 1U);
  const ComparedConfiguration& one = comparison.matched[0];
  EXPECT_NEAR(one.seconds.percent, 50.0, 2.0);
  ASSERT_TRUE(one.seconds.interval);
  EXPECT_LT(one.seconds.interval->first, 50.0);
  EXPECT_GT(one.seconds.interval->second, 50.0);
  EXPECT_EQ(one.seconds.verdict, Verdict::higher);
  ASSERT_TRUE(one.joules);
  EXPECT_NEAR(one.joules->percent, 50.0, 3.0);
  EXPECT_EQ(one.joules->verdict, Verdict::higher);
  EXPECT_TRUE(comparison.only_a.empty());
  const OpenedComparison same = compare_opened(a, a);
  EXPECT_EQ(same.matched.at(0).seconds.verdict, Verdict::noise);
}

TEST(OpenedSession, PanesThatRanAtOnceHaveTimesAndNoEnergy) {
  const TemporaryFolder folder;
  write(folder / "s", {50.0, 0.020, 4.0, false});
  // Rows of another configuration in the same stretch of time.
  {
    energy::SessionWriter writer(folder / "s", info_of("simulated:a"),
                                 {configuration_columns(), counter_columns()},
                                 energy::CsvWriter::Open::append);
    for (int i = 0; i < 100; ++i) {
      energy::FrameRow row;
      row.time = energy::Seconds(1.0 + 0.03 * i);
      row.configuration = RecordingWorld::slot_of("gpu").configuration;
      row.operations = 1;
      row.phases[energy::Phase::render] = energy::Seconds(0.03);
      writer.add(row);
    }
  }
  const OpenedSession opened = open(folder / "s");
  ASSERT_EQ(opened.bars.size(), 2U);
  for (const ConfigurationBars& bars : opened.bars) {
    EXPECT_FALSE(bars.joules);
    EXPECT_EQ(bars.energy.origin, energy::Origin::unavailable);
    EXPECT_GT(bars.seconds.value, 0.0);
  }
}

}  // namespace
}  // namespace encore::app
