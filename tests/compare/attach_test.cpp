// A meter's own recording gives a session its energies, or is refused with a reason.
#include "app/attach.h"

#include "tests/compare/recorded_session.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

using energy::Seconds;
using test::contains;
using test::error_of;
using test::TemporaryFolder;

energy::Recording recording_of(const TemporaryFolder& folder, const std::string& csv) {
  return open_recording(folder.write("meter.csv", csv).string());
}

Attached attach_to(const energy::Session& session, const energy::Recording& recording,
                   const AttachOptions& options = {}) {
  return attach_recording("session", session, recording, options);
}

AttachOptions offset_is(double seconds) {
  AttachOptions options;
  options.offset = Seconds(seconds);
  return options;
}
AttachOptions near_to(double seconds) {
  AttachOptions options;
  options.near = Seconds(seconds);
  return options;
}

/// The notes of a configuration as one text.
std::string notes_of(const Attached& attached, std::size_t i) {
  std::string text;
  for (const std::string& sentence : attached.notes.at(i).sentences) text += sentence + "\n";
  return text;
}

TEST(Attach, FindsTheOffsetAndTheEnergyOfEveryConfiguration) {
  const TemporaryFolder folder;
  const RecordedSession recorded = recorded_session();
  for (const double offset : {123.4, -7250.25}) {
    const auto recording = recording_of(folder, recorded.csv({.offset = offset, .noise = 1.0}));
    const Attached attached = attach_to(recorded.session, recording);
    EXPECT_NEAR(attached.place.offset.value, offset, attached.place.half_width.value);
    EXPECT_LT(attached.place.half_width.value, 0.2);
    EXPECT_GT(*attached.place.correlation, 0.8);
    ASSERT_EQ(attached.session.summaries.size(), recorded.truths.size());
    for (std::size_t i = 0; i < recorded.truths.size(); ++i) {
      const Truth& truth = recorded.truths[i];
      const energy::SummaryRow& row = attached.session.summaries[i];
      expect_within(row.watts, row.watts_ci95, truth.watts, 0.06);
      expect_within(row.joules, row.joules_ci95, truth.joules, 0.06);
      expect_within(row.idle_watts, row.idle_watts_ci95, kIdleWatts, 0.1);
      expect_within(row.net_joules, row.net_joules_ci95,
                    truth.joules * (1 - kIdleWatts / truth.watts), 0.2);
      EXPECT_EQ(row.source, "replay:meter.csv");
      EXPECT_EQ(row.origin, energy::Origin::measured);
    }
  }
}

TEST(Attach, ACounterOfJoulesServesAsWell) {
  const TemporaryFolder folder;
  const RecordedSession recorded = recorded_session();
  const auto recording = recording_of(folder, recorded.csv({.offset = 123.4, .counter = true}));
  const Attached attached = attach_to(recorded.session, recording);
  for (std::size_t i = 0; i < recorded.truths.size(); ++i) {
    const energy::SummaryRow& row = attached.session.summaries[i];
    expect_within(row.watts, row.watts_ci95, recorded.truths[i].watts, 0.06);
  }
  // A counter's power is the mean since the row before.
  const energy::WindowRow& idle = recorded.session.windows.front();
  std::size_t seen = 0;
  for (const energy::SampleRow& sample : attached.session.samples) {
    if (sample.time < idle.from + Seconds(0.3) || sample.time > idle.to) continue;
    ASSERT_TRUE(sample.watts);
    EXPECT_NEAR(sample.watts->value, kIdleWatts, 0.01);
    ++seen;
  }
  EXPECT_GT(seen, 10U);
}

TEST(Attach, LongPhasesAreReadAtTheirEdges) {
  const TemporaryFolder folder;
  const RecordedSession recorded = recorded_session();
  const auto recording =
      recording_of(folder, recorded.csv({.offset = 50, .spacing = 0.05, .noise = 0.5}));
  const Attached attached = attach_to(recorded.session, recording);
  const auto& build = phase_row(attached.session, "kd-sah", "build");
  const auto& render = phase_row(attached.session, "kd-sah", "render");
  EXPECT_EQ(build.method, "windows");
  expect_within(build.watts, build.watts_ci95, kBuildWatts, 0.1);
  expect_within(render.watts, render.watts_ci95, kRenderWatts, 0.1);
  EXPECT_EQ(build.note, "");
  EXPECT_EQ(phase_row(attached.session, "bvh-median", "render").method, "whole");
}

TEST(Attach, PhasesShorterThanTheClockIsKnownAreMarked) {
  const TemporaryFolder folder;
  const RecordedSession recorded = recorded_session();
  const auto recording = recording_of(folder, recorded.csv({.offset = 50, .spacing = 0.5}));
  const Attached attached = attach_to(recorded.session, recording);
  const auto& build = phase_row(attached.session, "kd-sah", "build");
  ASSERT_TRUE(build.watts);
  EXPECT_TRUE(contains(build.note, "holds some of its neighbours' energy")) << build.note;
}

TEST(Attach, TheNewSessionKeepsWhatTheOldOneKnew) {
  const TemporaryFolder folder;
  RecordedSession recorded = recorded_session();
  recorded.session.convergence = {{recorded.session.summaries[0].configuration,
                                   Seconds(1),
                                   "watts",
                                   30.0,
                                   {},
                                   {},
                                   {},
                                   {},
                                   {},
                                   {}},
                                  {recorded.session.summaries[0].configuration,
                                   Seconds(1),
                                   "time_per_operation",
                                   0.1,
                                   {},
                                   {},
                                   {},
                                   {},
                                   {},
                                   {}}};
  recorded.session.samples = {{Seconds(3), "rapl:package-0", energy::Watts(9), energy::Joules(27),
                               true, false, energy::Origin::measured}};
  const auto recording = recording_of(folder, recorded.csv({.offset = 123.4}));
  const Attached attached = attach_to(recorded.session, recording);
  const energy::Session& session = attached.session;
  EXPECT_EQ(session.frames, recorded.session.frames);
  EXPECT_EQ(session.windows, recorded.session.windows);
  ASSERT_EQ(session.convergence.size(), 1U);
  EXPECT_EQ(session.convergence[0].quantity, "time_per_operation");

  ASSERT_EQ(session.info.sources.size(), 2U);
  EXPECT_FALSE(session.info.sources[0].in_total);
  const energy::SessionSource& source = session.info.sources[1];
  EXPECT_TRUE(source.in_total);
  EXPECT_EQ(source.info.kind, energy::SourceKind::replay);
  EXPECT_EQ(source.info.domain, energy::Domain::system);
  EXPECT_EQ(session.info.sensor, source.info.provenance);
  EXPECT_TRUE(contains(session.info.sensor.detail, "meter.csv, clock +123."))
      << session.info.sensor.detail;
  EXPECT_TRUE(contains(session.events.at(0).message, "correlation"));

  // Samples of both sources, in the order of time, on the session's clock.
  double last = 0.0;
  std::size_t others = 0;
  for (const energy::SampleRow& row : session.samples) {
    EXPECT_GE(row.time.value, last);
    last = row.time.value;
    others += row.source == "rapl:package-0" ? 1 : 0;
  }
  EXPECT_EQ(others, 1U);
  EXPECT_NEAR(last, recorded.truths.back().until, 0.2);

  // Attached once more, the first recording makes room for the second.
  const Attached again = attach_to(session, recording);
  EXPECT_EQ(again.session.info.sources, session.info.sources);
  EXPECT_EQ(again.session.samples, session.samples);
  EXPECT_EQ(again.session.phases, session.phases);
}

TEST(Attach, WhatTheRecordingMissesHasNoEnergy) {
  const TemporaryFolder folder;
  RecordedSession recorded = recorded_session();
  energy::SummaryRow& missed = recorded.session.summaries[2];
  missed.watts = energy::Watts(99);
  missed.joules = energy::Joules(99);
  missed.origin = energy::Origin::measured;
  missed.counters = {{"nodes", 5.0}, {"joules_per_mray", 4.0}, {"energy_delay_js", 3.0}};
  const Truth& truth = recorded.truths[2];
  const auto recording = recording_of(
      folder, recorded.csv({.offset = 123.4, .gap_from = truth.from, .gap_to = truth.to}));
  const Attached attached = attach_to(recorded.session, recording);
  const energy::SummaryRow& row = attached.session.summaries[2];
  EXPECT_FALSE(row.watts);
  EXPECT_FALSE(row.joules);
  EXPECT_EQ(row.source, "");
  EXPECT_EQ(row.origin, energy::Origin::unavailable);
  EXPECT_EQ(row.counters[0].value, 5.0);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_FALSE(row.counters[i].value);
    EXPECT_TRUE(row.counters[i].unavailable);
  }
  EXPECT_FALSE(attached.notes[2].sentences.empty());
  EXPECT_TRUE(attached.session.summaries[1].watts);
  EXPECT_TRUE(attached.session.summaries[3].watts);
}

TEST(Attach, AGapInAWindowIsTold) {
  const TemporaryFolder folder;
  const RecordedSession recorded = recorded_session();
  const Truth& truth = recorded.truths[1];
  const auto recording = recording_of(folder, recorded.csv({.offset = 123.4,
                                                            .noise = 0.3,
                                                            .gap_from = truth.from + 4.0,
                                                            .gap_to = truth.from + 6.5}));
  const Attached attached = attach_to(recorded.session, recording);
  expect_within(attached.session.summaries[1].watts, attached.session.summaries[1].watts_ci95,
                truth.watts, 0.06);
  EXPECT_TRUE(contains(notes_of(attached, 1), "gave no value in 2.")) << notes_of(attached, 1);
}

TEST(Attach, OnlyWhatCameAfterAResumeCounts) {
  const TemporaryFolder folder;
  RecordedSession recorded = recorded_session();
  const Truth& truth = recorded.truths[1];
  // The clock left out a pause before the third configuration.
  recorded.session.events.push_back({Seconds(truth.until), "", "the study was resumed; so it is"});
  const auto recording =
      recording_of(folder, recorded.csv({.offset = 40, .noise = 0.5, .from = truth.until - 1}));
  const Attached attached = attach_to(recorded.session, recording);
  EXPECT_NEAR(attached.place.offset.value, 40, 0.1);
  EXPECT_FALSE(attached.session.summaries[1].watts);
  EXPECT_TRUE(attached.session.summaries[2].watts);
  ASSERT_EQ(attached.warnings.size(), 1U);
  EXPECT_TRUE(contains(attached.warnings[0], "resumed"));
}

TEST(Attach, AGivenOffsetIsTakenAndQuestioned) {
  const TemporaryFolder folder;
  const RecordedSession recorded = recorded_session();
  const auto recording = recording_of(folder, recorded.csv({.offset = 123.4}));
  const Attached right = attach_to(recorded.session, recording, offset_is(123.4));
  EXPECT_EQ(right.place.offset.value, 123.4);
  EXPECT_FALSE(right.place.correlation);
  EXPECT_TRUE(right.warnings.empty());
  const Attached wrong = attach_to(recorded.session, recording, offset_is(121.4));
  EXPECT_EQ(wrong.place.offset.value, 121.4);
  ASSERT_EQ(wrong.warnings.size(), 1U);
  EXPECT_TRUE(contains(wrong.warnings[0], "fit better at an offset of +123.")) << wrong.warnings[0];
  // The sign the wrong way round.
  EXPECT_TRUE(contains(error_of([&] { attach_to(recorded.session, recording, offset_is(-123.4)); }),
                       "lies outside of the session"));
}

TEST(Attach, ALoadThatRepeatsItselfNeedsARoughOffset) {
  const TemporaryFolder folder;
  const RecordedSession recorded = repeating_session();
  const auto recording = recording_of(folder, recorded.csv({.offset = 123.4, .noise = 1.0}));
  const std::string refusal = error_of([&] { attach_to(recorded.session, recording); });
  EXPECT_TRUE(contains(refusal, "the load repeats itself")) << refusal;
  EXPECT_TRUE(contains(refusal, "--near")) << refusal;
  const Attached attached = attach_to(recorded.session, recording, near_to(123.4 + 4.0));
  EXPECT_NEAR(attached.place.offset.value, 123.4, attached.place.half_width.value);
}

TEST(Attach, RefusesWhatCannotBeAligned) {
  const TemporaryFolder folder;
  const RecordedSession recorded = recorded_session();
  const auto refusal = [&](const std::string& csv) {
    return error_of([&] { attach_to(recorded.session, recording_of(folder, csv)); });
  };
  // Recordings of other runs.
  for (unsigned seed = 77; seed < 97; ++seed) {
    EXPECT_TRUE(contains(refusal(recorded_session(seed).csv({.noise = 1.0})), "meter.csv: "));
  }
  // Steady power, and a recording of seconds.
  std::string steady = "time_s,watts\n";
  for (int i = 0; i < 400; ++i) steady += std::to_string(i) + ",20\n";
  EXPECT_TRUE(contains(refusal(steady), "shows no steps of load")) << refusal(steady);
  EXPECT_TRUE(contains(refusal("time_s,watts\n0,20\n0.1,20\n0.2,20\n"), "overlap enough"));
  // In the right place, but only of the first idle window.
  const auto recording = recording_of(folder, recorded.csv({}));
  const AttachOptions early = offset_is(-(recorded.end + 1.0));
  EXPECT_TRUE(contains(error_of([&] { attach_to(recorded.session, recording, early); }),
                       "no configuration of session gets any energy from it"));
}

TEST(Attach, RefusesASessionThatWasNeverIdle) {
  const TemporaryFolder folder;
  RecordedSession recorded = recorded_session();
  const auto recording = recording_of(folder, recorded.csv({.offset = 9.0}));
  std::erase_if(recorded.session.windows, [](const auto& row) { return row.kind == "idle"; });
  const std::string refusal = error_of([&] { attach_to(recorded.session, recording); });
  EXPECT_TRUE(contains(refusal, "the session was never idle")) << refusal;
  // With the offset given, powers are there, but none above idle.
  const Attached attached = attach_to(recorded.session, recording, offset_is(9.0));
  EXPECT_TRUE(attached.session.summaries[0].watts);
  EXPECT_FALSE(attached.session.summaries[0].net_joules);
}

TEST(Attach, RefusesASessionWithoutWindows) {
  const TemporaryFolder folder;
  RecordedSession recorded = recorded_session();
  const auto recording = recording_of(folder, recorded.csv({}));
  recorded.session.windows.clear();
  EXPECT_TRUE(contains(error_of([&] { attach_to(recorded.session, recording); }),
                       "session: no configuration was measured to its end"));
}

}  // namespace
}  // namespace encore::app
