#include "energy/sources/model.h"

#include "energy/attribution/busy_timeline.h"
#include "energy/sources/model_spec.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::energy {
namespace {

PowerModel build_and_render() {
  PowerModel model;
  model.idle = Watts(12);
  model.delta[Phase::build] = Watts(18);
  model.delta[Phase::render] = Watts(20);
  model.detail = "given by the user";
  return model;
}

template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const PowerModelError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no PowerModelError was thrown";
  return {};
}

TEST(Model, EnergyIsIdleTimesTimePlusDeltasTimesBusyTime) {
  BusyTimes busy;
  busy.phases[Phase::build] = Seconds(2);
  busy.phases[Phase::render] = Seconds(5);
  EXPECT_DOUBLE_EQ(modelled_energy(build_and_render(), Seconds(10), busy)->value,
                   12.0 * 10 + 18.0 * 2 + 20.0 * 5);
}

TEST(Model, TheThesisFormIsTheSpecialCaseWithoutIdleTime) {
  // P_k = idle + delta_k, and the phases fill the time.
  BusyTimes busy;
  busy.phases[Phase::build] = Seconds(0.02);
  busy.phases[Phase::render] = Seconds(0.4);
  const PowerModel model = model_preset("thesis-laptop");
  EXPECT_NEAR(modelled_energy(model, Seconds(0.42), busy)->value, 33.6 * 0.02 + 34.6 * 0.4, 1e-12);
}

TEST(Model, GpuTimeMayOverlapPhases) {
  PowerModel model = build_and_render();
  model.gpu = Watts(30);
  BusyTimes busy;
  busy.phases[Phase::render] = Seconds(4);
  busy.gpu = Seconds(3);
  EXPECT_DOUBLE_EQ(modelled_energy(model, Seconds(4), busy)->value, 48.0 + 80.0 + 90.0);
}

TEST(Model, WhatHasNoConstantHasNoEnergyRatherThanNone) {
  BusyTimes busy;
  busy.phases[Phase::transfer] = Seconds(0.001);
  EXPECT_FALSE(modelled_energy(build_and_render(), Seconds(1), busy));
  BusyTimes gpu;
  gpu.gpu = Seconds(0.001);
  EXPECT_FALSE(modelled_energy(build_and_render(), Seconds(1), gpu));
}

TEST(Model, SourceFollowsLiveBusyTime) {
  LiveBusyTime live;
  const auto source = make_model_source(build_and_render(), [&](Seconds now) {
    return BusyTimes{live.busy(now), Seconds(0)};
  });
  EXPECT_EQ(source->read(Seconds(100)).reading.energy, Joules(0));
  live.begin(Phase::build, Seconds(101));
  // In the midst of a phase: one second idle, half a second of building.
  const ReadResult inside = source->read(Seconds(101.5));
  EXPECT_EQ(inside.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(inside.reading.energy.value, 12.0 * 1.5 + 18.0 * 0.5);
  live.end(Seconds(102));
  live.begin(Phase::render, Seconds(102));
  live.end(Seconds(104));
  const ReadResult after = source->read(Seconds(105));
  EXPECT_DOUBLE_EQ(after.reading.energy.value, 12.0 * 5 + 18.0 * 1 + 20.0 * 2);
  EXPECT_FALSE(after.reading.power);
}

TEST(Model, SourceFailsWhileAnUnknownPhaseRunsAndRestartsBehindIt) {
  LiveBusyTime live;
  const auto source = make_model_source(build_and_render(), [&](Seconds now) {
    return BusyTimes{live.busy(now), Seconds(0)};
  });
  source->read(Seconds(0));
  live.begin(Phase::transfer, Seconds(1));
  const ReadResult during = source->read(Seconds(2));
  EXPECT_EQ(during.state, ReadState::failed);
  EXPECT_EQ(during.message,
            "model:constants: no power is known for transfer, which runs: energy is missing "
            "meanwhile; give transfer=<watts above idle>");
  live.end(Seconds(2));
  EXPECT_EQ(source->read(Seconds(2.5)).state, ReadState::failed);
  const ReadResult back = source->read(Seconds(4));
  EXPECT_EQ(back.state, ReadState::restarted);
  EXPECT_EQ(back.message, "model:constants: back, as transfer rests");
  const ReadResult later = source->read(Seconds(5));
  EXPECT_EQ(later.state, ReadState::ok);
  EXPECT_DOUBLE_EQ((later.reading.energy - back.reading.energy).value, 12.0);
}

TEST(Model, ProvenanceNamesTheConstantsAndIsNeverMeasured) {
  const SourceInfo info = model_source_info(build_and_render());
  EXPECT_EQ(info.kind, SourceKind::model);
  EXPECT_EQ(info.provenance.origin, Origin::modelled);
  EXPECT_EQ(info.provenance.detail,
            "idle 12 W; above it: build 18 W, render 20 W (given by the user; uncertainty not "
            "given, taken as 20 %)");
  EXPECT_DOUBLE_EQ(info.gain_uncertainty, 0.2);
  const SourceInfo thesis = model_source_info(model_preset("thesis-laptop"));
  EXPECT_NE(thesis.provenance.detail.find("standard uncertainty 3 %"), std::string::npos);
  EXPECT_DOUBLE_EQ(thesis.gain_uncertainty, 0.03);
}

TEST(Model, ImpossibleConstantsAreRefused) {
  PowerModel model = build_and_render();
  model.delta[Phase::build] = Watts(-1);
  EXPECT_EQ(error_of([&] { make_model_source(model, {}); }),
            "power model: build must be from 0 to 100000 W, not -1");
  PowerModel bare;
  bare.idle = Watts(3);
  EXPECT_EQ(error_of([&] { check(bare); }),
            "power model: nothing is given above idle; add build=<watts>, render=<watts> or "
            "busy=<watts>");
  model = build_and_render();
  model.uncertainty = 1.5;
  EXPECT_EQ(error_of([&] { check(model); }),
            "power model: the relative uncertainty must be from 0 to 1, not 1.5");
}

}  // namespace
}  // namespace encore::energy
