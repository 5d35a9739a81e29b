#include "energy/sources/rapl.h"

#include "fixture_tree.h"

#include <unistd.h>

#include <cstdint>

namespace encore::energy {
namespace {

using Names = std::vector<std::string>;
const std::string kZone = "sys/class/powercap/intel-rapl:0/";

std::vector<Finding> find(const std::string& tree) {
  return find_rapl(fixture_root(tree));
}

TEST(Rapl, ClientHasOnePackageItsPartsAndAnUncalibratedPlatform) {
  const auto findings = find("rapl_1pkg_psys_mmio");
  EXPECT_EQ(taken(findings), (Names{"rapl:package-0", "rapl:psys"}));
  const SourceInfo& package = finding_of(findings, "rapl:package-0").info;
  EXPECT_EQ(package.domain, Domain::package);
  EXPECT_EQ(package.unit, "0");
  EXPECT_EQ(package.place, "/sys/class/powercap/intel-rapl:0/energy_uj");
  EXPECT_EQ(package.provenance.origin, Origin::measured);
  EXPECT_EQ(package.update_period, Seconds(0.001));
  // 2^-14 J, which the kernel rounds to whole picojoules.
  EXPECT_NEAR(package.energy_step->value, 1.0 / 16384.0, 1e-9);
  const SourceInfo& platform = finding_of(findings, "rapl:psys").info;
  EXPECT_EQ(platform.domain, Domain::platform);
  EXPECT_TRUE(has_text(platform.includes, "platform, uncalibrated")) << platform.includes;
  EXPECT_FALSE(has_text(platform.includes, "steps of")) << platform.includes;
  EXPECT_EQ(finding_of(findings, "rapl:package-0/core").info.domain, Domain::cores);
  EXPECT_EQ(finding_of(findings, "rapl:package-0/core").set_aside, "part of rapl:package-0");
  EXPECT_EQ(finding_of(findings, "rapl:package-0/uncore").info.domain, Domain::integrated_gpu);
}

TEST(Rapl, MemoryMappedZoneRepeatsTheRegisters) {
  const auto findings = find("rapl_1pkg_psys_mmio");
  EXPECT_EQ(finding_of(findings, "rapl:package-0@mmio").set_aside,
            "repeats rapl:package-0 (intel-rapl:0)");
}

TEST(Rapl, MemoryMappedZoneIsTakenWhereItIsTheOnlyOne) {
  const ChangingTree tree("rapl_1pkg_psys_mmio");
  for (const char* zone : {"0", "0:0", "0:1"}) {
    tree.remove(std::string("sys/class/powercap/intel-rapl:") + zone);
  }
  EXPECT_EQ(taken(find_rapl(tree.root())), (Names{"rapl:psys", "rapl:package-0@mmio"}));
}

TEST(Rapl, ServerSumsPackagesAndMemory) {
  const auto findings = find("rapl_2pkg_dram");
  EXPECT_EQ(taken(findings), (Names{"rapl:package-0", "rapl:package-0/dram", "rapl:package-1",
                                    "rapl:package-1/dram"}));
  const SourceInfo& memory = finding_of(findings, "rapl:package-1/dram").info;
  EXPECT_EQ(memory.domain, Domain::memory);
  EXPECT_EQ(memory.unit, "1");
  EXPECT_NEAR(memory.energy_step->value, 15.3e-6, 1e-9);  // fixed there, whatever the package has
}

TEST(Rapl, MirroredDiesCountOnce) {
  const auto findings = find("rapl_die_mirror");
  EXPECT_EQ(taken(findings), Names{"rapl:package-0-die-0"});
  EXPECT_EQ(findings.size(), 4U);
  EXPECT_EQ(findings[3].set_aside,
            "mirrors rapl:package-0-die-0: the same value in reading after reading");
  EXPECT_EQ(findings[3].info.unit, "0-die-3");
}

TEST(Rapl, EqualValuesThatGrowApartAreNoMirrors) {
  const ChangingTree tree("rapl_die_mirror");
  std::uint64_t pauses = 0;
  const auto findings = find_rapl(tree.root(), [&] {
    ++pauses;
    for (std::uint64_t die = 0; die < 4; ++die) {
      // Dies 0 and 1 mirror each other, 2 and 3 draw more than they do.
      const std::uint64_t watts = die < 2 ? 30 : 30 + die;
      tree.set("sys/class/powercap/intel-rapl:" + std::to_string(die) + "/energy_uj",
               std::to_string(33451002177U + pauses * 3000U * watts));
    }
  });
  EXPECT_GT(pauses, 0U);
  EXPECT_EQ(taken(findings),
            (Names{"rapl:package-0-die-0", "rapl:package-0-die-2", "rapl:package-0-die-3"}));
}

TEST(Rapl, MirrorsAreFoundEvenIfAnUpdateFallsBetweenTwoReads) {
  const ChangingTree tree("rapl_die_mirror");
  tree.set(kZone + "energy_uj", "33451002000");
  const auto findings =
      find_rapl(tree.root(), [&] { tree.set(kZone + "energy_uj", "33451002177"); });
  EXPECT_EQ(taken(findings), Names{"rapl:package-0-die-0"});
}

TEST(Rapl, PackagesOfTheirOwnAreNotReadTwice) {
  find_rapl(fixture_root("rapl_2pkg_dram"), [] { FAIL() << "no two values are close"; });
}

TEST(Rapl, ZoneNumbersAreHexadecimal) {
  const auto findings = find("rapl_hex_id");
  EXPECT_EQ(findings.size(), 12U);
  EXPECT_EQ(finding_of(findings, "rapl:package-10").info.place,
            "/sys/class/powercap/intel-rapl:a/energy_uj");
  EXPECT_EQ(finding_of(findings, "rapl:package-10/dram").info.unit, "10");
}

TEST(Rapl, CoreZoneOfAmdIsOneCore) {
  const auto findings = find("rapl_amd_core");
  EXPECT_EQ(taken(findings), Names{"rapl:package-0"});
  const Finding& core = finding_of(findings, "rapl:package-0/core");
  EXPECT_TRUE(has_text(core.set_aside, "one core only")) << core.set_aside;
  EXPECT_TRUE(has_text(core.info.includes, "one core of")) << core.info.includes;
  EXPECT_NEAR(core.info.energy_step->value, 1.0 / 65536.0, 1e-9);
}

TEST(Rapl, PlatformThatCountsJoulesAndSgxAreSaid) {
  const auto findings = find("rapl_psys_one_joule");
  const SourceInfo& platform = finding_of(findings, "rapl:psys").info;
  EXPECT_DOUBLE_EQ(platform.energy_step->value, 1.0);
  EXPECT_TRUE(has_text(platform.includes, "steps of 1 J")) << platform.includes;
  EXPECT_TRUE(has_text(platform.includes, "SGX")) << platform.includes;
}

TEST(Rapl, TreeStandsInForMissingLinks) {
  const auto findings = find("rapl_tree_only");
  EXPECT_EQ(taken(findings), (Names{"rapl:package-0", "rapl:psys"}));
  EXPECT_EQ(finding_of(findings, "rapl:package-0/core").info.place,
            "/sys/devices/virtual/powercap/intel-rapl/intel-rapl:0/intel-rapl:0:0/energy_uj");
}

TEST(Rapl, LinksThatLeadNowhereAreNoZones) {
  const ChangingTree tree("rapl_tree_only");
  std::filesystem::create_directories(tree.path("sys/class/powercap"));
  std::filesystem::create_symlink("../../gone", tree.path("sys/class/powercap/intel-rapl:0"));
  EXPECT_EQ(taken(find_rapl(tree.root())), (Names{"rapl:package-0", "rapl:psys"}));
}

TEST(Rapl, LinksAreFollowedAndNotCountedTwice) {
  const ChangingTree tree("rapl_tree_only");
  std::filesystem::create_directories(tree.path("sys/class/powercap"));
  std::filesystem::create_directory_symlink(
      "../../devices/virtual/powercap/intel-rapl/intel-rapl:0",
      tree.path("sys/class/powercap/intel-rapl:0"));
  EXPECT_EQ(find_rapl(tree.root()).size(), 1U);
}

TEST(Rapl, EmptyPowercapOfAVirtualMachineIsExplained) {
  const auto findings = find("powercap_empty");
  ASSERT_EQ(findings.size(), 1U);
  ASSERT_TRUE(findings[0].obstacle);
  EXPECT_TRUE(has_text(findings[0].obstacle->reason, "virtual machine"));
  EXPECT_TRUE(has_text(findings[0].obstacle->fix, "host"));
  EXPECT_EQ(findings[0].info.provenance.origin, Origin::unavailable);
  EXPECT_FALSE(findings[0].open);
}

TEST(Rapl, MissingPowercapNamesTheModuleOrTheContainer) {
  const ChangingTree tree("powercap_empty");
  tree.remove("sys");
  tree.set("proc/cpuinfo", "vendor_id\t: GenuineIntel\nflags\t\t: fpu vme");
  const Obstacle bare = *find_rapl(tree.root())[0].obstacle;
  EXPECT_EQ(bare.reason, "no powercap zones: /sys/class/powercap is not there");
  EXPECT_TRUE(has_text(bare.fix, "modprobe intel_rapl_msr")) << bare.fix;
  tree.set(".dockerenv", "");
  const Obstacle hidden = *find_rapl(tree.root())[0].obstacle;
  EXPECT_TRUE(has_text(hidden.reason, "container")) << hidden.reason;
  EXPECT_FALSE(has_text(hidden.fix, "modprobe")) << hidden.fix;
}

TEST(Rapl, UnknownZonesAreNamedAndLeftOut) {
  const ChangingTree tree("rapl_amd_core");
  tree.set("sys/class/powercap/intel-rapl:0:0/name", "antenna");
  const auto findings = find_rapl(tree.root());
  EXPECT_TRUE(has_text(findings[1].obstacle.value().reason, "'antenna'"));
}

/// Root may read everything: for a while, it is someone else.
class AsNobody {
 public:
  AsNobody() : was_root_(geteuid() == 0) {
    if (was_root_ && seteuid(65534) != 0) ADD_FAILURE() << "cannot become nobody";
  }
  ~AsNobody() {
    if (was_root_ && seteuid(0) != 0) ADD_FAILURE() << "cannot become root again";
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool was_root_;
};

TEST(Rapl, ForbiddenCounterNamesFileModeAndRule) {
  namespace fs = std::filesystem;
  const ChangingTree tree("rapl_amd_core");
  fs::permissions(tree.path("."), fs::perms(0755));
  fs::permissions(tree.path(kZone + "energy_uj"), fs::perms::none);
  const AsNobody nobody;
  if (!tree.root().read("/" + kZone + "name").text) GTEST_SKIP() << "nobody may not look in here";
  const auto findings = find_rapl(tree.root());
  const Finding& package = finding_of(findings, "rapl:package-0");
  ASSERT_TRUE(package.obstacle);
  EXPECT_TRUE(has_text(package.obstacle->reason,
                       "/sys/class/powercap/intel-rapl:0/energy_uj: permission denied (mode 0000"))
      << package.obstacle->reason;
  EXPECT_TRUE(has_text(package.obstacle->fix,
                       "SUBSYSTEM==\"powercap\", KERNEL==\"intel-rapl*\", "
                       "RUN+=\"/usr/bin/chgrp energy /sys/%p/energy_uj\""))
      << package.obstacle->fix;
  EXPECT_FALSE(package.open);
}

/// The package of a tree, read at times of the test's choosing.
class PackageReading : public testing::Test {
 protected:
  void open() { source_ = finding_of(find_rapl(tree_.root()), "rapl:package-0").open(); }
  void set(const std::string& microjoules) { tree_.set(kZone + "energy_uj", microjoules); }
  ReadResult at(double seconds) { return source_->read(Seconds(1000 + seconds)); }
  ReadResult at(double seconds, const std::string& microjoules) {
    set(microjoules);
    return at(seconds);
  }

  ChangingTree tree_{"rapl_1pkg_psys_mmio"};
  std::unique_ptr<PowerSource> source_;
};

TEST_F(PackageReading, FirstReadingPrimesAndLaterOnesGrow) {
  open();
  const ReadResult first = at(0.0, "5000000");
  EXPECT_EQ(first.state, ReadState::ok);
  EXPECT_EQ(first.reading.energy, Joules(0));
  EXPECT_EQ(first.reading.time, Seconds(1000));
  EXPECT_TRUE(first.reading.changed);
  EXPECT_FALSE(first.reading.power);
  const ReadResult same = at(0.05);
  EXPECT_EQ(same.state, ReadState::ok);
  EXPECT_FALSE(same.reading.changed);
  const ReadResult more = at(0.1, "6500000");
  EXPECT_EQ(more.state, ReadState::ok);
  EXPECT_TRUE(more.reading.changed);
  EXPECT_DOUBLE_EQ(more.reading.energy.value, 1.5);
}

TEST_F(PackageReading, StartsOverAtItsRange) {
  open();
  at(0.0, "262143328000");
  const ReadResult wrapped = at(0.05, "850");
  EXPECT_EQ(wrapped.state, ReadState::ok) << wrapped.message;
  EXPECT_NEAR(wrapped.reading.energy.value, 1700e-6, 1e-15);
}

TEST_F(PackageReading, WithoutARangeAStartOverIsAGap) {
  tree_.remove(kZone + "max_energy_range_uj");
  open();
  at(0.0, "262143328000");
  const ReadResult wrapped = at(0.05, "850");
  EXPECT_EQ(wrapped.state, ReadState::restarted);
  EXPECT_EQ(wrapped.reading.energy, Joules(0));
  EXPECT_TRUE(has_text(wrapped.message, "/sys/class/powercap/intel-rapl:0/energy_uj"));
  const ReadResult next = at(0.1, "1000850");
  EXPECT_EQ(next.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(next.reading.energy.value, 1.0);
}

TEST_F(PackageReading, ResetIsAGapAndNeverAHugeEnergy) {
  open();
  at(0.0, "100000000000");
  const ReadResult reset = at(0.05, "1000");
  EXPECT_EQ(reset.state, ReadState::restarted);
  EXPECT_EQ(reset.reading.energy, Joules(0));
  EXPECT_TRUE(has_text(reset.message, "above 1000 W")) << reset.message;
}

TEST_F(PackageReading, JumpAboveEveryLoadIsAGap) {
  open();
  at(0.0, "1000000");
  EXPECT_EQ(at(1.0, "1011000000").state, ReadState::restarted);  // 1010 J in 1 s
  EXPECT_EQ(at(2.0, "2011000000").state, ReadState::ok);         // 1000 J in 1 s
}

TEST_F(PackageReading, BurstsBeyondAClientsLimitArePlausible) {
  open();
  at(0.0, "1000000");
  const ReadResult burst = at(1.0, "151000000");  // 150 W with limits of 28 W and 64 W
  EXPECT_EQ(burst.state, ReadState::ok) << burst.message;
}

TEST_F(PackageReading, LargePowerLimitsWidenTheBound) {
  tree_.set(kZone + "constraint_1_power_limit_uw", "900000000");
  open();
  at(0.0, "1000000");
  EXPECT_EQ(at(1.0, "1701000000").state, ReadState::ok);
  EXPECT_EQ(at(2.0, "3701000000").state, ReadState::restarted);
}

TEST_F(PackageReading, UpdateInAShortIntervalIsNoReset) {
  open();
  at(0.0, "1000000");
  // A millisecond's 0.2 J arrive within ten microseconds of the last reading: no 20 kW.
  EXPECT_EQ(at(0.00001, "1200000").state, ReadState::ok);
}

TEST_F(PackageReading, LongSilenceMayHideAStartOver) {
  open();
  at(0.0, "1000000");
  EXPECT_EQ(at(250.0, "2000000").state, ReadState::ok);
  EXPECT_EQ(at(550.0, "3000000").state, ReadState::restarted);  // 300 s at 1000 W exceed the range
}

TEST_F(PackageReading, FailedReadingHasNoValueAndLeavesAGap) {
  open();
  at(0.0, "1000000");
  at(0.05, "2000000");
  for (const char* nonsense : {"", "-5", "12 34", "99999999999999999999999"}) {
    const ReadResult failed = at(0.1, nonsense);
    EXPECT_EQ(failed.state, ReadState::failed) << nonsense;
    EXPECT_TRUE(has_text(failed.message, "energy_uj: ")) << failed.message;
  }
  const ReadResult back = at(0.2, "9000000");
  EXPECT_EQ(back.state, ReadState::restarted);
  EXPECT_DOUBLE_EQ(back.reading.energy.value, 1.0);  // what was known before, not a joule more
  EXPECT_DOUBLE_EQ(at(0.25, "9500000").reading.energy.value, 1.5);
}

TEST_F(PackageReading, ZoneThatIsGoneIsLost) {
  open();
  at(0.0);
  tree_.remove("sys/class/powercap/intel-rapl:0");
  EXPECT_EQ(at(0.05).state, ReadState::lost);
}

TEST_F(PackageReading, OpeningAZoneThatIsGoneSaysSo) {
  const auto findings = find_rapl(tree_.root());
  tree_.remove(kZone + "energy_uj");
  try {
    (void)finding_of(findings, "rapl:package-0").open();
    FAIL() << "opened what is gone";
  } catch (const SensorError& error) {
    EXPECT_TRUE(has_text(error.what(), "intel-rapl:0/energy_uj")) << error.what();
  }
}

TEST_F(PackageReading, NothingIsLostOverManyStartOvers) {
  open();
  std::uint64_t value = 0;
  at(0.0, "0");
  constexpr std::uint64_t kRange = 262143328850;
  for (int i = 1; i <= 60; ++i) {
    value = (value + 30'000'000'000U) % kRange;
    ASSERT_EQ(at(60.0 * i, std::to_string(value)).state, ReadState::ok);
  }
  EXPECT_DOUBLE_EQ(at(3601.0).reading.energy.value, 60 * 30'000.0);
}

}  // namespace
}  // namespace encore::energy
