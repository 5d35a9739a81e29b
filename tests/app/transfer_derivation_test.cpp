#include "app/transfer_derivation.h"

#include "app/profile_report.h"
#include "app/workloads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace encore::app {
namespace {

using energy::Joules;
using energy::Origin;
using energy::Phase;
using energy::Seconds;
using energy::SummaryRow;

using Parts = std::map<std::string, std::string>;

std::vector<energy::KeyValue> configuration(const Parts& parts) {
  Parts all{{"scene", "toys"},  {"device", "cpu"}, {"structure", "kd-sah"}, {"policy", "rebuild"},
            {"memory", "pool"}, {"repeat", "1"},   {"triangles", "11000"}};
  for (const auto& [key, value] : parts) all[key] = value;
  std::vector<energy::KeyValue> result;
  for (const std::string& column : configuration_columns()) {
    result.push_back({column, all[column]});
  }
  return result;
}

/// A row that takes so many ms and joules, both ± 3 %, of which nothing is gain.
SummaryRow row_of(const Parts& parts, double ms, std::optional<double> joules) {
  SummaryRow row;
  row.configuration = configuration(parts);
  row.operations = 10;
  row.mean = Seconds(ms / 1e3);
  row.ci95 = Seconds(0.03 * ms / 1e3);
  if (joules) {
    row.joules = Joules(*joules);
    row.joules_ci95 = row.joules_ci95_without_gain = Joules(0.03 * *joules);
    row.origin = Origin::measured;
  }
  return row;
}

/// The thesis' three tests: a frame of 100 ms and 4 J, a build of 30 and 1, a render of 60 and 2.5.
class TransferDerivation : public testing::Test {
 protected:
  TransferDerivation() {
    frames = row_of({{"device", "gpu"}, {"test", "forced"}, {"width", "256"}, {"height", "256"}},
                    100, 4.0);
    frames.phase_counts[Phase::build] = frames.phase_counts[Phase::render] = 10;
    frames.phase_counts[Phase::transfer] = 10;
    frames.shares[Phase::transfer] = 0.08;
    frames.counters = {{"transfer_bytes", 4096.0}};
    build = row_of({{"test", "build"}}, 30, 1.0);
    render = row_of({{"device", "gpu"},
                     {"test", "static"},
                     {"policy", "static"},
                     {"width", "256"},
                     {"height", "256"}},
                    60, 2.5);
    phase.configuration = frames.configuration;
    phase.source = "total";
    phase.phase = "transfer";
    phase.joules = Joules(0.4);
    phase.joules_ci95 = Joules(0.1);
    phase.origin = Origin::measured;
  }
  TransferFigures derive() {
    const std::vector<SummaryRow> rows{build, frames, render};
    const auto all = derive_transfers(rows, std::vector{phase});
    EXPECT_EQ(all.size(), 1U);
    return all.at(0);
  }

  SummaryRow frames, build, render;
  energy::PhaseRow phase;
};

TEST_F(TransferDerivation, IsTheFrameWithoutBuildAndRender) {
  const TransferFigures figures = derive();
  EXPECT_EQ(figures.note, "");
  EXPECT_NEAR(figures.derived_ms.value_or(0), 10.0, 1e-9);
  EXPECT_NEAR(figures.derived_joules.value_or(0), 0.5, 1e-9);
  EXPECT_NEAR(figures.derived_ms_ci95.value_or(0), 0.03 * std::sqrt(1e4 + 900 + 3600), 1e-9);
  EXPECT_NEAR(figures.derived_joules_ci95.value_or(0), 0.03 * std::sqrt(16 + 1 + 6.25), 1e-9);
  EXPECT_NEAR(figures.ms.value_or(0), 8.0, 1e-9) << "as it was told apart";
  EXPECT_EQ(figures.joules, 0.4);
  EXPECT_EQ(figures.joules_ci95, 0.1);
  EXPECT_EQ(figures.bytes, 4096.0);
  EXPECT_EQ(figures.origin, Origin::measured);
}

TEST_F(TransferDerivation, BelowZeroIsShownAsItIs) {
  render.mean = Seconds(0.09);
  render.joules = Joules(3.5);
  const TransferFigures figures = derive();
  EXPECT_NEAR(figures.derived_ms.value_or(0), -20.0, 1e-9);
  EXPECT_NEAR(figures.derived_joules.value_or(0), -0.5, 1e-9);
  const std::string text = transfer_text({figures}, {build, frames, render});
  EXPECT_NE(text.find("-20.0 ± 3.6"), std::string::npos) << text;
  EXPECT_NE(text.find("-500 ± "), std::string::npos) << text;
}

TEST_F(TransferDerivation, TheSensorsGainGoesIntoTheDifferenceOnce) {
  frames.joules_ci95_without_gain = build.joules_ci95_without_gain =
      render.joules_ci95_without_gain = Joules(0.0);
  frames.joules_ci95 = Joules(0.1 * 4.0);
  EXPECT_NEAR(derive().derived_joules_ci95.value_or(0), 0.1 * 0.5, 1e-9);
}

TEST_F(TransferDerivation, JoulesNeedAllThreeTestsToHaveThem) {
  build.joules.reset();
  build.origin = Origin::unavailable;
  const TransferFigures figures = derive();
  EXPECT_TRUE(figures.derived_ms);
  EXPECT_FALSE(figures.derived_joules);
  EXPECT_FALSE(figures.derived_joules_ci95);
  EXPECT_EQ(figures.joules, 0.4) << "what was told apart stays";
  const auto record = to_record(figures);
  EXPECT_EQ(record.size(), transfer_header(configuration_columns()).size());
  EXPECT_EQ(record[record.size() - 4], "unavailable");
}

TEST_F(TransferDerivation, TheWeakestProvenanceIsTheResults) {
  render.origin = Origin::modelled;
  EXPECT_EQ(derive().origin, Origin::modelled);
}

TEST_F(TransferDerivation, SaysWhichTestIsMissing) {
  for (const auto& [change, missing] : std::vector<std::pair<Parts, std::string>>{
           {{{"test", "build"}, {"structure", "kd-median"}},
            "this session has no test build of device cpu under policy rebuild to derive it from"},
           {{{"test", "build"}, {"memory", "malloc"}}, "test build"},
           {{{"test", "build"}, {"scene", "cow"}}, "test build"},
           {{{"test", "build"}, {"repeat", "2"}}, "test build"}}) {
    build.configuration = configuration(change);
    const TransferFigures figures = derive();
    EXPECT_NE(figures.note.find(missing), std::string::npos) << figures.note;
    EXPECT_FALSE(figures.derived_ms);
    EXPECT_TRUE(figures.ms);
  }
  render.configuration[6].value = "768";
  EXPECT_EQ(derive().note,
            "this session has no test build of device cpu under policy rebuild and no test static "
            "of device gpu at 256x256 to derive it from");
  const std::string text = transfer_text({derive()}, {build, frames, render});
  EXPECT_NE(text.find("- not derived: this session has no test build"), std::string::npos) << text;
}

TEST_F(TransferDerivation, UpdatesOfTheDeviceAreHeldAgainstItsOwn) {
  frames.configuration = configuration({{"device", "gpu"},
                                        {"test", "forced"},
                                        {"policy", "refit"},
                                        {"width", "256"},
                                        {"height", "256"},
                                        {"update_case", "worst"}});
  std::swap(frames.phase_counts[Phase::build], frames.phase_counts[Phase::update]);
  build.configuration =
      configuration({{"test", "build"}, {"policy", "refit"}, {"update_case", "worst"}});
  EXPECT_NE(derive().note.find("no test build of device gpu under policy refit"), std::string::npos)
      << derive().note << ": the CPU's update is no part of these frames";
  build.configuration[2].value = "gpu";
  EXPECT_NEAR(derive().derived_ms.value_or(0), 10.0, 1e-9);
}

TEST_F(TransferDerivation, WhatTheFramesDidNotDoIsNotSubtracted) {
  frames.phase_counts[Phase::build] = 0;
  EXPECT_NEAR(derive().derived_ms.value_or(0), 40.0, 1e-9);
  frames.phase_counts[Phase::build] = 5;  // every second frame moved something
  EXPECT_NEAR(derive().derived_ms.value_or(0), 25.0, 1e-9);
  EXPECT_NEAR(derive().derived_joules.value_or(0), 1.0, 1e-9);
}

TEST_F(TransferDerivation, AnimationIsTakenOffAsItWasToldApart) {
  frames.shares[Phase::animate] = 0.02;
  TransferFigures figures = derive();
  EXPECT_NEAR(figures.derived_ms.value_or(0), 8.0, 1e-9);
  EXPECT_FALSE(figures.derived_joules) << "nobody could tell what animating took";

  energy::PhaseRow animate = phase;
  animate.phase = "animate";
  animate.joules = Joules(0.1);
  animate.joules_ci95 = Joules(0.0);
  const std::vector<SummaryRow> rows{build, frames, render};
  figures = derive_transfers(rows, std::vector{phase, animate}).at(0);
  EXPECT_NEAR(figures.derived_joules.value_or(0), 0.4, 1e-9);
}

TEST_F(TransferDerivation, TheSameGroupGoesBeforeOthers) {
  SummaryRow other = build;
  other.configuration[0].value = "other";
  other.mean = Seconds(0.010);
  frames.configuration[0].value = render.configuration[0].value = "mine";
  SummaryRow mine = build;
  mine.configuration[0].value = "mine";
  const std::vector<SummaryRow> both{other, frames, mine, render};
  EXPECT_NEAR(derive_transfers(both, {}).at(0).derived_ms.value_or(0), 10.0, 1e-9);
  const std::vector<SummaryRow> one{other, frames, render};
  EXPECT_NEAR(derive_transfers(one, {}).at(0).derived_ms.value_or(0), 30.0, 1e-9)
      << "builds are often a group of their own";
}

TEST_F(TransferDerivation, TheCpuTransfersNothing) {
  frames.configuration[2].value = "cpu";
  const std::vector<SummaryRow> rows{build, frames, render};
  EXPECT_TRUE(derive_transfers(rows, {}).empty());
  EXPECT_EQ(transfer_text({}, rows), "");
}

}  // namespace
}  // namespace encore::app
