#include "energy/sources/choose_total.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace encore::energy {
namespace {

using Chosen = std::vector<std::size_t>;

SourceInfo source(SourceKind kind, Domain domain, const std::string& unit = "",
                  bool is_counter = true) {
  SourceInfo info;
  info.kind = kind;
  info.domain = domain;
  info.unit = unit;
  info.is_counter = is_counter;
  return info;
}
SourceInfo rapl(Domain domain, const std::string& unit = "") {
  return source(SourceKind::rapl, domain, unit);
}
const SourceInfo kBattery = source(SourceKind::battery, Domain::system, "BAT0", false);
const SourceInfo kMeter = source(SourceKind::meter, Domain::system, "", false);

TEST(ChooseTotal, NothingOfNothing) {
  EXPECT_EQ(choose_total({}), Chosen{});
}

TEST(ChooseTotal, PackagesMemoryAndGpuAddUpWithoutTheirPartsAndTheWhole) {
  EXPECT_EQ(choose_total({rapl(Domain::platform), rapl(Domain::cores, "0"),
                          rapl(Domain::package, "0"), rapl(Domain::integrated_gpu, "0"),
                          rapl(Domain::memory, "0"), rapl(Domain::package, "1"),
                          source(SourceKind::nvml, Domain::gpu, "0000:01:00.0"), kBattery, kMeter}),
            (Chosen{2, 4, 5, 6}));
}

TEST(ChooseTotal, OneCounterOnTwoWaysCountsOnce) {
  EXPECT_EQ(choose_total({rapl(Domain::package, "0"),
                          source(SourceKind::perf_energy, Domain::package, "0"),
                          source(SourceKind::nvml, Domain::gpu, "0000:01:00.0"),
                          source(SourceKind::hwmon, Domain::gpu, "0000:01:00.0"),
                          source(SourceKind::hwmon, Domain::gpu, "0000:02:00.0")}),
            (Chosen{0, 2, 4}));
}

TEST(ChooseTotal, SocketGaugeOfAnApuIsNotAddedToItsPackage) {
  EXPECT_EQ(choose_total({source(SourceKind::hwmon, Domain::socket, "0000:04:00.0", false),
                          rapl(Domain::package, "0")}),
            Chosen{1});
}

TEST(ChooseTotal, AMeterStandsBeforeTheBatteryAndOnlyOneIsTaken) {
  EXPECT_EQ(
      choose_total({kBattery, kMeter, source(SourceKind::replay, Domain::system, "b", false)}),
      Chosen{1});
}

TEST(ChooseTotal, BatteryPacksAddUp) {
  EXPECT_EQ(choose_total({kBattery, source(SourceKind::battery, Domain::system, "BAT1", false),
                          rapl(Domain::platform)}),
            (Chosen{0, 1}));
}

TEST(ChooseTotal, AGpuAloneIsNoTotalWhereABatterySeesAll) {
  EXPECT_EQ(choose_total({source(SourceKind::nvml, Domain::gpu, "0"), kBattery}), Chosen{1});
  EXPECT_EQ(choose_total({source(SourceKind::nvml, Domain::gpu, "0")}), Chosen{0});
}

TEST(ChooseTotal, TheRestIsTakenInItsOrder) {
  EXPECT_EQ(choose_total({rapl(Domain::cores, "0"), rapl(Domain::platform),
                          rapl(Domain::integrated_gpu, "0")}),
            (Chosen{0, 2}));
  EXPECT_EQ(choose_total({rapl(Domain::platform), rapl(Domain::cores, "0"),
                          source(SourceKind::nvml, Domain::gpu, "0", false)}),
            (Chosen{0, 2}));
}

TEST(ChooseTotal, InventedSourcesOnlyIfNothingIsReal) {
  const SourceInfo model = source(SourceKind::model, Domain::package, "0");
  const SourceInfo simulated = source(SourceKind::simulated, Domain::system, "", false);
  EXPECT_EQ(choose_total({model, rapl(Domain::cores, "0")}), Chosen{1});
  EXPECT_EQ(choose_total({simulated, model, kBattery}), Chosen{2});
  EXPECT_EQ(choose_total({simulated}), Chosen{0});
  EXPECT_EQ(choose_total({simulated, model}), Chosen{1});
}

/// Whatever is there and in whatever order: the same joule is never added twice.
TEST(ChooseTotal, NeverCountsAJouleTwice) {
  std::mt19937 random(7);
  const SourceKind kinds[] = {SourceKind::rapl,   SourceKind::perf_energy, SourceKind::hwmon,
                              SourceKind::nvml,   SourceKind::battery,     SourceKind::meter,
                              SourceKind::replay, SourceKind::model,       SourceKind::simulated};
  const auto pick = [&](unsigned n) {
    return std::uniform_int_distribution<unsigned>(0, n - 1)(random);
  };
  for (int run = 0; run < 3000; ++run) {
    std::vector<SourceInfo> sources;
    for (unsigned i = pick(9) + 1; i > 0; --i) {
      sources.push_back(source(kinds[pick(9)], static_cast<Domain>(pick(8)),
                               std::to_string(pick(2)), pick(2) == 0));
    }
    const Chosen chosen = choose_total(sources);
    ASSERT_FALSE(chosen.empty());
    ASSERT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
    for (const std::size_t a : chosen) {
      for (const std::size_t b : chosen) {
        if (a == b) continue;
        ASSERT_FALSE(sources[a].domain == sources[b].domain && sources[a].unit == sources[b].unit);
        if (sources[a].unit != sources[b].unit && sources[a].domain == Domain::package) continue;
        ASSERT_FALSE(holds(sources[a].domain, sources[b].domain));
      }
    }
  }
}

}  // namespace
}  // namespace encore::energy
