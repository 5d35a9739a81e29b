#include "energy/model/energy_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace encore::energy {
namespace {

/// Build, render and transfer at a rate each.
ModelInput gpu_frame() {
  return {
      {{33.6, 0.25}, {40.2, 0.8}, {36.0, 1.0}},
      {{"build", {0.1, 0.002}, 0}, {"render", {0.2, 0.004}, 1}, {"transfer", {0.05, 0.003}, 2}}};
}

TEST(EnergyModel, ThesisWorkedExample) {
  const ModelInput input{{{34.0, 0.0}}, {{"build", {0.02, 0.0}, 0}, {"render", {0.4, 0.0}, 0}}};
  const ModelPrediction frame = predict_sequential(input);
  EXPECT_NEAR(frame.frames_per_second.value, 2.38, 0.005);
  EXPECT_NEAR(frame.frames_per_joule.value, 0.07, 0.0005);
  EXPECT_NEAR(frame.joules.value, 14.28, 1e-12);
  EXPECT_NEAR(frame.joules_of_work[0].value, 0.68, 1e-12);
  EXPECT_NEAR(frame.joules_of_work[1].value, 13.6, 1e-12);
  EXPECT_DOUBLE_EQ(frame.watts.value, 34.0);
  // The battery of section 4.1, full: 53 Wh.
  EXPECT_NEAR(frames_for({53.0 * 3600.0, 0.0}, frame).value, 13361.3, 0.05);
}

TEST(EnergyModel, GpuRateIsTheMeanOverTime) {
  const ModelPrediction frame = predict_sequential(gpu_frame());
  const double seconds = 0.35;
  EXPECT_NEAR(frame.watts.value,
              33.6 * 0.1 / seconds + 40.2 * 0.2 / seconds + 36.0 * 0.05 / seconds, 1e-12);
  EXPECT_NEAR(frame.frames_per_joule.value, frame.frames_per_second.value / frame.watts.value,
              1e-15);
  EXPECT_NEAR(frame.joules.value * frame.frames_per_joule.value, 1.0, 1e-12);
  EXPECT_TRUE(frame.warning.empty());
}

TEST(EnergyModel, GeneralFormWithoutGapsIsTheThesisModel) {
  const ModelInput gross = gpu_frame();
  ModelInput net = gross;
  for (Uncertain& rate : net.rates) rate.value -= 19.0;
  const ModelPrediction a = predict_sequential(gross);
  const ModelPrediction b = predict_overlapping({19.0, 0.0}, a.seconds, net);
  EXPECT_NEAR(a.joules.value, b.joules.value, 1e-12);
  EXPECT_NEAR(a.watts.value, b.watts.value, 1e-12);
  EXPECT_NEAR(b.busy_share, 1.0, 1e-12);
  EXPECT_TRUE(b.warning.empty());
  // Net parts and idle make up the whole.
  double parts = 19.0 * b.seconds.value;
  for (const Uncertain& part : b.joules_of_work) parts += part.value;
  EXPECT_NEAR(parts, b.joules.value, 1e-12);
}

TEST(EnergyModel, WarnsBeyondFivePercentOfOverlapOrGap) {
  const ModelInput work{{{10.0, 0.0}}, {{"render", {1.0, 0.0}, 0}}};
  const auto warning = [&](double frame) {
    return predict_overlapping({5.0, 0.0}, {frame, 0.0}, work).warning;
  };
  EXPECT_TRUE(warning(1.0 / 1.04).empty());
  EXPECT_TRUE(warning(1.0 / 0.96).empty());
  EXPECT_NE(warning(1.0 / 1.06).find("overlaps"), std::string::npos);
  EXPECT_NE(warning(1.0 / 0.94).find("gaps"), std::string::npos);
}

TEST(EnergyModel, OverlappingWorkCostsLessThanItsSumAtGrossRates) {
  // CPU and GPU busy at once: the idle part is paid once.
  const ModelInput work{{{10.0, 0.0}, {30.0, 0.0}},
                        {{"build", {0.1, 0.0}, 0}, {"render", {0.1, 0.0}, 1}}};
  const ModelPrediction frame = predict_overlapping({20.0, 0.0}, {0.1, 0.0}, work);
  EXPECT_NEAR(frame.joules.value, 20.0 * 0.1 + 1.0 + 3.0, 1e-12);
  EXPECT_NEAR(frame.busy_share, 2.0, 1e-12);
}

/// Spread (1.96 sigma) of `figure` when every input of the model varies by its half-width.
Uncertain simulated(const std::function<double(const std::function<double(Uncertain)>&)>& figure) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr int kRuns = 40000;
  const auto draw = [&](Uncertain u) { return u.value + normal(random) * u.half_width / 1.96; };
  double mean = 0.0;
  double squares = 0.0;
  for (int run = 1; run <= kRuns; ++run) {
    const double value = figure(draw);
    const double off = value - mean;
    mean += off / run;
    squares += off * (value - mean);
  }
  return {mean, 1.96 * std::sqrt(squares / (kRuns - 1))};
}

ModelInput drawn(const ModelInput& input, const std::function<double(Uncertain)>& draw) {
  ModelInput result = input;
  for (Uncertain& rate : result.rates) rate = {draw(rate), 0.0};
  for (FrameWork& work : result.work) work.seconds = {draw(work.seconds), 0.0};
  return result;
}

TEST(EnergyModel, HalfWidthsAreThoseOfASimulation) {
  ModelInput input = gpu_frame();
  input.work.push_back({"update", {0.08, 0.002}, 0});  // shares the build's rate
  const ModelPrediction frame = predict_sequential(input);
  using Draw = std::function<double(Uncertain)>;
  const auto near = [](const Uncertain& told, const Uncertain& seen) {
    EXPECT_NEAR(told.half_width, seen.half_width, 0.03 * seen.half_width);
  };
  near(frame.joules, simulated([&](const Draw& draw) {
         return predict_sequential(drawn(input, draw)).joules.value;
       }));
  near(frame.watts, simulated([&](const Draw& draw) {
         return predict_sequential(drawn(input, draw)).watts.value;
       }));
  near(frame.frames_per_joule, simulated([&](const Draw& draw) {
         return predict_sequential(drawn(input, draw)).frames_per_joule.value;
       }));
  near(frame.frames_per_second, simulated([&](const Draw& draw) {
         return predict_sequential(drawn(input, draw)).frames_per_second.value;
       }));
}

TEST(EnergyModel, GeneralHalfWidthsAreThoseOfASimulation) {
  const ModelInput input = gpu_frame();
  const Uncertain idle{19.0, 0.5};
  const Uncertain length{0.4, 0.006};
  const ModelPrediction frame = predict_overlapping(idle, length, input);
  using Draw = std::function<double(Uncertain)>;
  const auto predict = [&](const Draw& draw) {
    return predict_overlapping({draw(idle), 0.0}, {draw(length), 0.0}, drawn(input, draw));
  };
  const Uncertain joules = simulated([&](const Draw& draw) { return predict(draw).joules.value; });
  const Uncertain watts = simulated([&](const Draw& draw) { return predict(draw).watts.value; });
  EXPECT_NEAR(frame.joules.half_width, joules.half_width, 0.03 * joules.half_width);
  EXPECT_NEAR(frame.watts.half_width, watts.half_width, 0.03 * watts.half_width);
}

TEST(EnergyModel, ASharedRateIsOneUncertainNumber) {
  // Two halves at one rate are as uncertain as the whole, two rates of their own less so.
  const ModelInput whole{{{30.0, 3.0}}, {{"frame", {1.0, 0.0}, 0}}};
  const ModelInput shared{{{30.0, 3.0}}, {{"build", {0.5, 0.0}, 0}, {"render", {0.5, 0.0}, 0}}};
  const ModelInput own{{{30.0, 3.0}, {30.0, 3.0}},
                       {{"build", {0.5, 0.0}, 0}, {"render", {0.5, 0.0}, 1}}};
  EXPECT_NEAR(predict_sequential(whole).joules.half_width, 3.0, 1e-12);
  EXPECT_NEAR(predict_sequential(shared).joules.half_width, 3.0, 1e-12);
  EXPECT_NEAR(predict_sequential(own).joules.half_width, 3.0 / std::sqrt(2.0), 1e-12);
}

TEST(EnergyModel, FramesForACapacityCarryBothUncertainties) {
  const ModelPrediction frame = predict_sequential({{{10.0, 0.5}}, {{"frame", {1.0, 0.0}, 0}}});
  const Uncertain frames = frames_for({1000.0, 30.0}, frame);
  EXPECT_NEAR(frames.value, 100.0, 1e-12);
  EXPECT_NEAR(frames.half_width, 100.0 * std::hypot(0.05, 0.03), 1e-12);
}

TEST(EnergyModel, NetRateOfTheThesisFormula) {
  const Uncertain net = above_idle({33.6, 0.3}, {19.0, 0.4});
  EXPECT_NEAR(net.value, 14.6, 1e-12);
  EXPECT_NEAR(net.half_width, 0.5, 1e-12);
}

TEST(EnergyModel, RefusesWhatIsNoFrame) {
  const ModelInput good{{{10.0, 0.0}}, {{"frame", {1.0, 0.0}, 0}}};
  ModelInput negative = good;
  negative.work[0].seconds.value = -1.0;
  ModelInput unknown = good;
  unknown.rates[0].value = std::nan("");
  ModelInput without_rate = good;
  without_rate.work[0].rate = 1;
  ModelInput instant = good;
  instant.work[0].seconds.value = 0.0;
  for (const ModelInput& bad : {negative, unknown, without_rate, instant}) {
    EXPECT_THROW((void)predict_sequential(bad), std::invalid_argument);
  }
  EXPECT_THROW((void)predict_overlapping({5.0, 0.0}, {0.0, 0.0}, good), std::invalid_argument);
  EXPECT_THROW((void)predict_overlapping({-5.0, 0.0}, {1.0, 0.0}, good), std::invalid_argument);
}

}  // namespace
}  // namespace encore::energy
