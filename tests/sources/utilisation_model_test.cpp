#include "energy/sources/utilisation_model.h"

#include "energy/sources/model.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::energy {
namespace {

UtilisationModel twelve_to_forty_five() {
  return {Watts(12), Watts(45), "idle and max given by the user"};
}

/// Ticks since the start in /proc/stat's order, and two processors' lines.
std::string proc_stat(int user, int idle, int iowait, int steal) {
  return "cpu  " + std::to_string(user) + " 0 0 " + std::to_string(idle) + " " +
         std::to_string(iowait) + " 0 0 " + std::to_string(steal) +
         " 7 0\ncpu0 1 0 0 1\ncpu1 1 0 0 1\nintr 5\n";
}

TEST(UtilisationModel, ReadsProcStat) {
  const auto ticks = parse_proc_stat("cpu  10 2 30 400 50 6 7 80 9 1\ncpu0 1 1 1 1\nctxt 3\n");
  ASSERT_TRUE(ticks);
  EXPECT_EQ(ticks->busy, 10U + 2 + 30 + 6 + 7);  // guests are in user already
  EXPECT_EQ(ticks->waiting, 450U);
  EXPECT_EQ(ticks->stolen, 80U);
  EXPECT_EQ(ticks->processors, 1U);
  EXPECT_FALSE(parse_proc_stat("ctxt 3\n"));
  EXPECT_FALSE(parse_proc_stat("cpu  a b\n"));
}

TEST(UtilisationModel, WaitingForDisksIsNotWorkAndStolenTimeStandsApart) {
  const auto from = *parse_proc_stat(proc_stat(100, 100, 0, 0));
  const auto u = utilisation_between(from, *parse_proc_stat(proc_stat(130, 140, 20, 10)));
  ASSERT_TRUE(u);
  EXPECT_DOUBLE_EQ(u->busy, 0.30);
  EXPECT_DOUBLE_EQ(u->stolen, 0.10);
  EXPECT_FALSE(utilisation_between(from, from));
}

TEST(UtilisationModel, MachineEnergyIsLinearInLoad) {
  const test::TemporaryFolder root;
  const auto source =
      make_utilisation_source(twelve_to_forty_five(), SensorRoot(root.path()), LoadScope::machine);
  root.write("proc/stat", proc_stat(0, 0, 0, 0));
  EXPECT_EQ(source->read(Seconds(10)).reading.energy, Joules(0));
  root.write("proc/stat", proc_stat(50, 150, 0, 0));
  const ReadResult quarter = source->read(Seconds(11));
  EXPECT_DOUBLE_EQ(quarter.reading.energy.value, 12 + 33 * 0.25);
  EXPECT_DOUBLE_EQ(quarter.reading.power->value, 12 + 33 * 0.25);
  // No tick: the counter stands still, and catches up at the next.
  const ReadResult same = source->read(Seconds(11.001));
  EXPECT_FALSE(same.reading.changed);
  EXPECT_EQ(same.reading.energy, quarter.reading.energy);
  root.write("proc/stat", proc_stat(250, 150, 0, 0));
  const ReadResult full = source->read(Seconds(12));
  EXPECT_DOUBLE_EQ(full.reading.energy.value, 12 + 33 * 0.25 + 45);
}

TEST(UtilisationModel, ContainerLoadIsItsOwnAgainstItsQuota) {
  const test::TemporaryFolder root;
  root.write("proc/stat", proc_stat(0, 0, 0, 0));
  root.write("sys/fs/cgroup/cpu.stat", "usage_usec 1000000\nuser_usec 1\n");
  const SensorRoot sensors(root.path());
  EXPECT_EQ(load_scope(sensors), LoadScope::machine);
  root.write(".dockerenv", "");
  EXPECT_EQ(load_scope(sensors), LoadScope::container);

  const auto source =
      make_utilisation_source(twelve_to_forty_five(), sensors, LoadScope::container);
  source->read(Seconds(0));
  root.write("sys/fs/cgroup/cpu.stat", "usage_usec 2000000\nuser_usec 1\n");
  // One processor second of two seconds on two processors.
  EXPECT_DOUBLE_EQ(source->read(Seconds(2)).reading.energy.value, 2 * (12 + 33 * 0.25));
  root.write("sys/fs/cgroup/cpu.max", "100000 100000\n");
  root.write("sys/fs/cgroup/cpu.stat", "usage_usec 3000000\nuser_usec 1\n");
  EXPECT_DOUBLE_EQ(source->read(Seconds(4)).reading.power->value, 12 + 33 * 0.5);
}

TEST(UtilisationModel, AFailureIsAGapAndTellsItsPlace) {
  const test::TemporaryFolder root;
  const auto source =
      make_utilisation_source(twelve_to_forty_five(), SensorRoot(root.path()), LoadScope::machine);
  const ReadResult none = source->read(Seconds(0));
  EXPECT_EQ(none.state, ReadState::failed);
  EXPECT_EQ(none.message, "model:utilisation: /proc/stat: No such file or directory; no estimate");
  root.write("proc/stat", proc_stat(0, 100, 0, 0));
  EXPECT_EQ(source->read(Seconds(1)).state, ReadState::ok);
  root.write("proc/stat", "nonsense\n");
  EXPECT_EQ(source->read(Seconds(2)).message,
            "model:utilisation: /proc/stat: holds no line 'cpu'; no estimate");
  root.write("proc/stat", proc_stat(0, 300, 0, 0));
  EXPECT_EQ(source->read(Seconds(3)).state, ReadState::restarted);
  root.write("proc/stat", proc_stat(0, 400, 0, 0));
  const ReadResult next = source->read(Seconds(4));
  EXPECT_EQ(next.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(next.reading.energy.value, 12.0);
}

TEST(UtilisationModel, IsLabelledAnEstimate) {
  const SourceInfo info = utilisation_source_info(twelve_to_forty_five(), LoadScope::machine);
  EXPECT_EQ(info.provenance.origin, Origin::modelled);
  EXPECT_EQ(info.provenance.detail,
            "ESTIMATED from utilisation (/proc/stat): idle 12 W, max 45 W; idle and max given by "
            "the user; ±30-50 %");
  EXPECT_THROW(check(UtilisationModel{Watts(45), Watts(45), "", 0.4}), PowerModelError);
}

}  // namespace
}  // namespace encore::energy
