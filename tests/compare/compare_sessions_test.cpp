#include "app/compare.h"
#include "app/compare_report.h"
#include "tests/app/profile_json_check.h"
#include "tests/compare/written_session.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace encore::app {
namespace {

using test::contains;

bool any_contains(const std::vector<std::string>& sentences, std::string_view part) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& sentence) { return contains(sentence, part); });
}

CompareReport report_of(const energy::Session& a, const energy::Session& b,
                        std::optional<double> tolerance = {}) {
  return {"before", "after", a.info, b.info, tolerance, compare_sessions(a, b, tolerance)};
}

TEST(CompareSessions, MatchesByWhatIdentifiesAConfiguration) {
  const energy::Session a = session_of({{}, {.test = "static"}, {.structure = "kd-sah"}});
  const energy::Session b =
      session_of({{.structure = "grid-box"}, {.test = "static"}, {.ms = 9.0}});
  const Comparison comparison = compare_sessions(a, b, {});
  ASSERT_EQ(comparison.matched.size(), 2U);
  EXPECT_NEAR(comparison.matched[0].seconds.ratio, 0.9, 1e-12);
  EXPECT_NEAR(comparison.matched[1].seconds.ratio, 1.0, 1e-12);
  ASSERT_EQ(comparison.only_a.size(), 1U);
  ASSERT_EQ(comparison.only_b.size(), 1U);
  const std::string text = compare_text(report_of(a, b));
  EXPECT_TRUE(contains(text, "only in A: toys, kd-sah, build, rebuild, cpu")) << text;
  EXPECT_TRUE(contains(text, "only in B: toys, grid-box, build, rebuild, cpu")) << text;
}

TEST(CompareSessions, EqualSessionsDifferInNothing) {
  const energy::Session session = session_of({{}, {.test = "static"}});
  const Comparison comparison = compare_sessions(session, session, 0.01);
  EXPECT_TRUE(comparison.warnings.empty());
  EXPECT_TRUE(comparison.same_sensor);
  EXPECT_EQ(comparison.regressions(), 0U);
  for (const ConfigurationChange& change : comparison.matched) {
    EXPECT_EQ(change.seconds.ratio, 1.0);
    EXPECT_EQ(change.seconds.verdict, Verdict::noise);
    EXPECT_EQ(change.joules->verdict, Verdict::noise);
    EXPECT_EQ(change.watts->verdict, Verdict::noise);
  }
}

TEST(CompareSessions, TimePowerAndEnergyAreJudgedEachForItself) {
  // Faster at more power: less time, more watts, the same joules.
  const Comparison comparison =
      compare_sessions(session_of({{}}), session_of({{.ms = 8.0, .ms_ci95 = 0.08}}), 0.05);
  const ConfigurationChange& change = comparison.matched.at(0);
  EXPECT_EQ(change.seconds.verdict, Verdict::lower);
  EXPECT_EQ(change.watts->verdict, Verdict::higher);
  EXPECT_NEAR(change.watts->ratio, 1.25, 1e-12);
  EXPECT_EQ(change.joules->verdict, Verdict::noise);
  EXPECT_EQ(comparison.regressions(), 0U) << "power alone is no regression";
}

TEST(CompareSessions, MoreEnergyInTheSameTimeIsARegression) {
  const Comparison comparison =
      compare_sessions(session_of({{}, {.test = "static"}}),
                       session_of({{.joules = 0.35}, {.test = "static"}}), 0.05);
  EXPECT_EQ(comparison.regressions(), 1U);
  EXPECT_TRUE(comparison.matched[0].joules->regression);
  EXPECT_FALSE(comparison.matched[0].seconds.regression);
}

TEST(CompareSessions, RepeatsAreTakenTogether) {
  const energy::Session a = session_of({{.ms = 10.0, .repeat = "1"}, {.ms = 10.4, .repeat = "2"}});
  const energy::Session b = session_of({{.ms = 12.0}});
  const Comparison comparison = compare_sessions(a, b, {});
  ASSERT_EQ(comparison.matched.size(), 1U);
  EXPECT_EQ(comparison.matched[0].runs_a, 2U);
  EXPECT_EQ(comparison.matched[0].runs_b, 1U);
  EXPECT_NEAR(comparison.matched[0].seconds.a, std::sqrt(104.0) / 1e3, 1e-12);
  EXPECT_EQ(comparison.time_spread.degrees_of_freedom, 1U);
  // t(0.975, 1) = 12.7: two runs alone cannot tell 18 %.
  EXPECT_EQ(comparison.matched[0].seconds.verdict, Verdict::noise);
}

TEST(CompareSessions, WhatElseDiffersIsTold) {
  energy::SessionInfo other = written_info();
  other.machine.cpu_model = "another processor";
  other.machine.build_type = "Debug";
  other.settings[1].value = "4";
  const Comparison comparison =
      compare_sessions(session_of({{}}), session_of({{.triangles = "1001"}}, other), {});
  EXPECT_TRUE(
      any_contains(comparison.warnings, "processor: 'processor' in A, 'another processor'"));
  EXPECT_TRUE(any_contains(comparison.warnings, "build type: 'Release' in A, 'Debug' in B"));
  EXPECT_TRUE(any_contains(comparison.warnings, "session B was measured with a Debug build"));
  EXPECT_TRUE(any_contains(comparison.warnings, "setting threads: '8' in A, '4' in B"));
  EXPECT_TRUE(any_contains(comparison.warnings, "1000 triangles in A, 1001 in B"));
  EXPECT_FALSE(comparison.same_sensor);
}

TEST(CompareSessions, ACutOffSessionIsTold) {
  energy::Session b = session_of({{}});
  b.info.state = energy::SessionState::interrupted;
  EXPECT_TRUE(any_contains(compare_sessions(session_of({{}}), b, {}).warnings,
                           "session B is not complete (interrupted)"));
}

TEST(CompareSessions, AnotherSensorWidensWhatItTellsAndOnlyThat) {
  energy::SessionInfo other = written_info();
  other.sources[0].info.name = "battery:BAT0";
  const Comparison comparison =
      compare_sessions(session_of({{}}), session_of({{.ms = 11.0, .joules = 0.33}}, other), {});
  EXPECT_FALSE(comparison.same_sensor);
  EXPECT_TRUE(any_contains(comparison.warnings, "power source: 'rapl:package-0' in A"));
  EXPECT_TRUE(any_contains(comparison.warnings, "gain errors do not cancel"));
  EXPECT_EQ(comparison.matched[0].seconds.verdict, Verdict::higher);
  EXPECT_EQ(comparison.matched[0].joules->verdict, Verdict::noise);
  // 1.96 times 5 % twice, in quadrature with 1 % twice.
  EXPECT_NEAR(std::log(*comparison.matched[0].joules->high / 1.1),
              std::sqrt(2.0 * std::pow(1.959963984540054 * 0.05, 2) + 0.01 * 0.01 +
                        std::pow(0.003 / 0.33, 2)),
              1e-9);
}

TEST(CompareSessions, MeasuredIsNotComparedWithModelled) {
  energy::Session b = session_of({{}});
  b.info.sensor.origin = energy::Origin::modelled;
  b.summaries[0].origin = energy::Origin::modelled;
  const Comparison comparison = compare_sessions(session_of({{}}), b, {});
  EXPECT_FALSE(comparison.matched[0].joules);
  EXPECT_FALSE(comparison.matched[0].watts);
  EXPECT_TRUE(any_contains(comparison.warnings, "energy is measured in A and modelled in B"));
}

TEST(CompareSessions, WithoutEnergyTimesAreComparedAllTheSame) {
  const Comparison comparison =
      compare_sessions(session_of({{.joules = 0.0}}), session_of({{.joules = 0.0}}), {});
  EXPECT_FALSE(comparison.matched[0].joules);
  EXPECT_EQ(comparison.matched[0].seconds.verdict, Verdict::noise);
}

TEST(CompareReport, ChangesShowAsManyDigitsAsTheyCarry) {
  FigureChange change;
  change.ratio = 0.87654;
  EXPECT_EQ(change_text(change), "-12.3 % (?)");
  change.low = 0.82;
  change.high = 0.93;
  EXPECT_EQ(change_text(change), "-12 % (-18 to -7)");
  change.low = 0.8762;
  change.high = 0.8769;
  EXPECT_EQ(change_text(change), "-12.346 % (-12.380 to -12.310)");
}

TEST(CompareReport, SaysWhatTheVerdictsAre) {
  const energy::Session a = session_of({{}, {.test = "static"}, {.structure = "kd-sah"}});
  const energy::Session b =
      session_of({{.ms = 8.0}, {.test = "static", .ms = 12.0}, {.structure = "kd-sah"}});
  const std::string text = compare_text(report_of(a, b, 0.05));
  EXPECT_TRUE(contains(text, "faster")) << text;
  EXPECT_TRUE(contains(text, "slower (REGRESSION)")) << text;
  EXPECT_TRUE(contains(text, "no difference beyond noise")) << text;
  EXPECT_TRUE(contains(text, "REGRESSION: 1 of 3 configurations are worse by more than 5 %"));
  EXPECT_TRUE(contains(text, "Both used the same power source")) << text;
  EXPECT_TRUE(contains(text, "Intervals come from within one run each")) << text;
}

TEST(CompareReport, JsonIsJson) {
  const energy::Session a = session_of({{}, {.structure = "kd-sah", .joules = 0.0}});
  const energy::Session b = session_of({{.ms_ci95 = 0.0}, {.structure = "grid-box"}});
  for (const std::optional<double> tolerance : {std::optional<double>(), std::optional(0.05)}) {
    const std::string json = compare_json(report_of(a, b, tolerance));
    EXPECT_TRUE(JsonChecker(json).valid()) << json;
    EXPECT_TRUE(contains(json, R"("ratio_low": null)")) << json;
    EXPECT_TRUE(contains(json, R"("verdict": "unknown")")) << json;
  }
}

}  // namespace
}  // namespace encore::app
