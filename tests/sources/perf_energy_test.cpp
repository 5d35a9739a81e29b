#include "energy/sources/perf_energy.h"

#include "energy/sources/perf_pmu.h"
#include "fixture_tree.h"

#include <cerrno>
#include <map>
#include <memory>

namespace encore::energy {
namespace {

using Names = std::vector<std::string>;
const std::string kEvents = "sys/bus/event_source/devices/power/events/";

/// The kernel's side: one counter an event and processor.
struct FakePerf {
  int open_error = 0;
  int read_error = 0;
  std::map<int, std::pair<std::uint64_t, int>> opened;  ///< config and processor by file
  std::map<int, std::uint64_t> values;
  int closed = 0;

  PerfCalls calls() {
    PerfCalls calls;
    calls.open = [this](std::uint32_t type, std::uint64_t config, int cpu) {
      if (open_error != 0) return -open_error;
      EXPECT_EQ(type, 20U);
      const int file = 100 + static_cast<int>(opened.size());
      opened[file] = {config, cpu};
      return file;
    };
    calls.read = [this](int file, std::uint64_t& value) {
      if (read_error != 0) return -read_error;
      value = values[file];
      return 0;
    };
    calls.close = [this](int) { ++closed; };
    return calls;
  }
};

TEST(PerfEnergy, EveryEventIsOpenedOnceAPackage) {
  FakePerf perf;
  const auto findings = find_perf_energy(fixture_root("perf_2pkg"), perf.calls());
  EXPECT_EQ(taken(findings), (Names{"perf:package-0", "perf:package-1", "perf:package-0/dram",
                                    "perf:package-1/dram", "perf:psys"}));
  EXPECT_EQ(perf.opened[101], (std::pair<std::uint64_t, int>{2, 18}));
  EXPECT_EQ(perf.opened[104], (std::pair<std::uint64_t, int>{5, 0}));
  EXPECT_EQ(perf.closed, 5);  // looking leaves nothing open
  EXPECT_EQ(findings[1].info.unit, "1");
  EXPECT_EQ(findings[1].info.domain, Domain::package);
  EXPECT_TRUE(has_text(findings[4].info.includes, "platform, uncalibrated"));
}

TEST(PerfEnergy, CountsAreScaledToJoules) {
  FakePerf perf;
  const auto findings = find_perf_energy(fixture_root("perf_2pkg"), perf.calls());
  const auto source = findings[0].open();
  const int file = perf.opened.rbegin()->first;
  perf.values[file] = 1'000'000;
  EXPECT_EQ(source->read(Seconds(1)).reading.energy, Joules(0));
  perf.values[file] += 3ULL << 32U;
  const ReadResult result = source->read(Seconds(1.1));
  EXPECT_EQ(result.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(result.reading.energy.value, 3.0);
  EXPECT_FALSE(source->read(Seconds(1.2)).reading.changed);
  // The kernel's counter never starts over: what falls has been reset.
  perf.values[file] = 5;
  EXPECT_EQ(source->read(Seconds(1.3)).state, ReadState::restarted);
}

TEST(PerfEnergy, FailedReadsAreGapsAndEndedCountersAreLost) {
  FakePerf perf;
  const auto findings = find_perf_energy(fixture_root("perf_2pkg"), perf.calls());
  auto source = findings[0].open();
  source->read(Seconds(1));
  perf.read_error = EIO;
  const ReadResult failed = source->read(Seconds(1.1));
  EXPECT_EQ(failed.state, ReadState::failed);
  EXPECT_TRUE(has_text(failed.message, "energy-pkg on processor 0: ")) << failed.message;
  perf.read_error = 0;
  EXPECT_EQ(source->read(Seconds(1.2)).state, ReadState::restarted);
  perf.read_error = ENODATA;
  EXPECT_EQ(source->read(Seconds(1.3)).state, ReadState::lost);
  const int closed = perf.closed;
  source.reset();
  EXPECT_EQ(perf.closed, closed + 1);
}

TEST(PerfEnergy, RefusalNamesTheSettingAndTheWayOut) {
  for (const int error : {EACCES, EPERM}) {
    FakePerf perf;
    perf.open_error = error;
    const auto findings = find_perf_energy(fixture_root("perf_2pkg"), perf.calls());
    EXPECT_TRUE(taken(findings).empty());
    const Obstacle& obstacle = findings[0].obstacle.value();
    EXPECT_TRUE(has_text(obstacle.reason, "kernel.perf_event_paranoid is 2")) << obstacle.reason;
    EXPECT_TRUE(has_text(obstacle.fix, "sysctl kernel.perf_event_paranoid=0")) << obstacle.fix;
    EXPECT_TRUE(has_text(obstacle.fix, "cap_perfmon")) << obstacle.fix;
    EXPECT_EQ(perf.closed, 0);
  }
}

TEST(PerfEnergy, OtherRefusalsArePassedOn) {
  FakePerf perf;
  perf.open_error = ENODEV;
  const auto findings = find_perf_energy(fixture_root("perf_2pkg"), perf.calls());
  EXPECT_TRUE(has_text(findings[0].obstacle.value().reason, "No such device"));
  EXPECT_EQ(findings[0].obstacle->fix, "");
}

TEST(PerfEnergy, RefusedLaterThrows) {
  FakePerf perf;
  const auto findings = find_perf_energy(fixture_root("perf_2pkg"), perf.calls());
  perf.open_error = EACCES;
  EXPECT_THROW((void)findings[0].open(), SensorError);
}

TEST(PerfEnergy, OddFilesAreObstaclesThatNameTheFile) {
  const std::pair<std::string, std::string> cases[] = {
      {kEvents + "energy-pkg.scale", "1e-3 J"},
      {kEvents + "energy-pkg.scale", "-1"},
      {kEvents + "energy-pkg.scale", "0"},
      {kEvents + "energy-pkg.unit", "Watts"},
      {kEvents + "energy-pkg", "event=0x02,umask=0x1"},
      {kEvents + "energy-pkg", "config=2"},
      {"sys/bus/event_source/devices/power/type", "twenty"},
      {"sys/bus/event_source/devices/power/cpumask", "0-"},
  };
  for (const auto& [file, content] : cases) {
    const ChangingTree tree("perf_2pkg");
    tree.set(file, content);
    FakePerf perf;
    const auto findings = find_perf_energy(tree.root(), perf.calls());
    ASSERT_TRUE(findings[0].obstacle) << file << " = " << content;
    EXPECT_TRUE(has_text(findings[0].obstacle->reason, "/" + file)) << findings[0].obstacle->reason;
    EXPECT_TRUE(has_text(findings[0].obstacle->reason, content)) << findings[0].obstacle->reason;
  }
}

TEST(PerfEnergy, MissingUnitFileIsAnObstacle) {
  const ChangingTree tree("perf_2pkg");
  tree.remove(kEvents + "energy-pkg.unit");
  FakePerf perf;
  EXPECT_TRUE(find_perf_energy(tree.root(), perf.calls())[0].obstacle);
}

TEST(PerfEnergy, CopiesOfATreeAreNotCounted) {
  const auto findings = find_perf_energy(fixture_root("perf_2pkg"));
  EXPECT_TRUE(taken(findings).empty());
  EXPECT_TRUE(has_text(findings[0].obstacle.value().reason, "on the machine itself only"));
}

TEST(PerfEnergy, MissingPmuIsExplained) {
  const auto findings = find_perf_energy(fixture_root("powercap_empty"));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_TRUE(has_text(findings[0].obstacle.value().reason, "virtual machine"));
}

TEST(PerfEnergy, PartsOfAPackageAreSetAside) {
  const ChangingTree tree("perf_2pkg");
  tree.set(kEvents + "energy-gpu", "event=0x04");
  tree.set(kEvents + "energy-gpu.scale", "2.3283064365386962890625e-10");
  tree.set(kEvents + "energy-gpu.unit", "Joules");
  FakePerf perf;
  const auto findings = find_perf_energy(tree.root(), perf.calls());
  EXPECT_EQ(finding_of(findings, "perf:package-1/uncore").set_aside, "part of perf:package-1");
}

TEST(PerfEnergy, PackagesWithSeveralDiesAreNumberedAsPowercapDoes) {
  const ChangingTree tree("perf_2pkg");
  tree.set("sys/devices/system/cpu/cpu18/topology/physical_package_id", "0");
  tree.set("sys/devices/system/cpu/cpu18/topology/die_id", "1");
  FakePerf perf;
  const auto findings = find_perf_energy(tree.root(), perf.calls());
  EXPECT_EQ(findings[0].info.unit, "0-die-0");
  EXPECT_EQ(findings[1].info.name, "perf:package-0-die-1");
}

TEST(PerfEnergy, PowercapIsPreferredForTheSameCounter) {
  FakePerf perf;
  auto findings = find_perf_energy(fixture_root("perf_2pkg"), perf.calls());
  auto powercap = find_rapl(fixture_root("rapl_2pkg_dram"));
  powercap[2].obstacle = Obstacle{"package-1 cannot be read", ""};
  ASSERT_EQ(powercap[2].info.name, "rapl:package-1");
  set_repeated_aside(findings, powercap);
  EXPECT_EQ(finding_of(findings, "perf:package-0").set_aside, "the same counter as rapl:package-0");
  EXPECT_EQ(taken(findings), (Names{"perf:package-1", "perf:psys"}));
}

TEST(PerfEnergy, ListsOfProcessors) {
  EXPECT_EQ(parse_cpu_list("0"), std::vector<int>{0});
  EXPECT_EQ(parse_cpu_list("0,18"), (std::vector<int>{0, 18}));
  EXPECT_EQ(parse_cpu_list("0-2,8"), (std::vector<int>{0, 1, 2, 8}));
  for (const char* wrong : {"", ",", "0,", "a", "3-1", "-1", "0-999999999", "0 1"}) {
    EXPECT_FALSE(parse_cpu_list(wrong)) << wrong;
  }
  // The limit holds for all parts together.
  ASSERT_TRUE(parse_cpu_list("0-65535"));
  EXPECT_EQ(parse_cpu_list("0-65535")->size(), 65536U);
  EXPECT_FALSE(parse_cpu_list("0-65535,0"));
}

}  // namespace
}  // namespace encore::energy
