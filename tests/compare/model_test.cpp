// Models fitted to sessions of a machine whose powers are known.
#include "app/exit_code.h"
#include "app/model_report.h"
#include "tests/app/profile_json_check.h"
#include "tests/app/run_program.h"
#include "tests/compare/written_session.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace encore::app {
namespace {

using energy::Phase;
using test::contains;
using test::TemporaryFolder;

/// A machine: watts of the whole while a phase runs, and while none does.
struct Machine {
  double idle = 19.0;
  double animate = 33.6;
  double build = 33.6;
  double render = 40.2;
  double transfer = 36.0;
};

/// Milliseconds of one operation.
struct Times {
  double animate = 0.0;
  double build = 0.0;
  double render = 0.0;
  double transfer = 0.0;
  double gap = 0.0;
};

/// Adds a configuration as that machine would have measured it.
void add(energy::Session& session, const Machine& machine, const std::string& structure,
         const std::string& test, const Times& ms) {
  energy::SummaryRow row = summary_of({.structure = structure, .test = test});
  const double busy = ms.animate + ms.build + ms.render + ms.transfer;
  row.mean = energy::Seconds(busy / 1e3);
  row.ci95.reset();
  row.shares = {};
  const auto share = [&](Phase phase, double time) {
    if (time > 0.0) row.shares[phase] = time / busy;
  };
  share(Phase::animate, ms.animate);
  share(Phase::build, ms.build);
  share(Phase::render, ms.render);
  share(Phase::transfer, ms.transfer);
  const double millijoules = machine.animate * ms.animate + machine.build * ms.build +
                             machine.render * ms.render + machine.transfer * ms.transfer +
                             machine.idle * ms.gap;
  row.joules = energy::Joules(millijoules / 1e3);
  const double gain = 1.959963984540054 * energy::SourceInfo{}.gain_uncertainty;
  row.joules_ci95 = energy::Joules(millijoules / 1e3 * std::hypot(0.01, gain));
  row.watts = energy::Watts(millijoules / (busy + ms.gap));
  row.idle_watts = energy::Watts(machine.idle);
  row.idle_watts_ci95 = energy::Watts(std::hypot(0.2, gain * machine.idle));
  session.summaries.push_back(row);

  // Three rows of one operation each, as far apart as an operation and its gap are long.
  for (int i = 0; i < 3; ++i) {
    energy::FrameRow frame;
    frame.time = energy::Seconds(i * (busy + ms.gap) / 1e3);
    frame.configuration = row.configuration;
    frame.operations = 1;
    frame.origin = energy::Origin::measured;
    for (const Phase phase : energy::kPhases) {
      if (row.shares[phase]) frame.phases[phase] = row.mean * *row.shares[phase];
    }
    session.frames.push_back(frame);
  }
}

/// Two structures in all three tests; `gap`: of every operation, in milliseconds.
energy::Session measured(const Machine& machine, double gap = 0.0, double transfer = 0.0) {
  energy::Session session = session_of({});
  add(session, machine, "bvh-median", "build", {.build = 20.0, .gap = gap});
  add(session, machine, "kd-sah", "build", {.build = 300.0, .gap = gap});
  add(session, machine, "bvh-median", "static", {.render = 400.0, .gap = gap});
  add(session, machine, "kd-sah", "static", {.render = 250.0, .gap = gap});
  add(session, machine, "bvh-median", "dynamic",
      {.animate = 5.0, .build = 20.0, .render = 410.0, .transfer = transfer, .gap = gap});
  add(session, machine, "kd-sah", "dynamic",
      {.animate = 5.0, .build = 300.0, .render = 260.0, .transfer = transfer, .gap = gap});
  return session;
}

bool any_contains(const std::vector<std::string>& sentences, std::string_view part) {
  for (const std::string& sentence : sentences) {
    if (contains(sentence, part)) return true;
  }
  return false;
}

std::map<std::string, double> rates_of(const energy::RateFit& fit, const ModelData& data) {
  std::map<std::string, double> rates;
  for (std::size_t k = 0; k < data.rates.size(); ++k) {
    if (fit.rates[k]) rates[data.rates[k]] = fit.rates[k]->value;
  }
  return rates;
}

TEST(Model, ARateAPhasePredictsDynamicTests) {
  const ModelReport report = make_model_report("s", measured({}), {});
  auto rates = rates_of(report.phase, report.by_phase);
  EXPECT_NEAR(rates.at("build"), 33.6, 1e-9);
  EXPECT_NEAR(rates.at("render (cpu)"), 40.2, 1e-9);
  const auto errors = energy::errors_of(report.phase, report.by_phase.observations, false);
  EXPECT_EQ(errors.count, 2U);
  EXPECT_NEAR(errors.rms, 0.0, 1e-9);
  // The thesis' one rate for the whole CPU lies between, and is off where rates differ.
  const double cpu = rates_of(report.processor, report.by_processor).at("cpu");
  EXPECT_GT(cpu, 33.6);
  EXPECT_LT(cpu, 40.2);
  const auto single = energy::errors_of(report.processor, report.by_processor.observations, false);
  EXPECT_GT(single.rms, 0.02);
}

/// The last configuration of a session as that of another device and policy.
void set_last(energy::Session& session, const std::string& device, const std::string& policy) {
  auto& configuration = session.summaries.back().configuration;
  for (energy::KeyValue& part : configuration) {
    if (part.key == "device") part.value = device;
    if (part.key == "policy") part.value = policy;
  }
  for (std::size_t i = session.frames.size() - 3; i < session.frames.size(); ++i) {
    session.frames[i].configuration = configuration;
  }
}

/// What was called building becomes updating.
void set_last_to_update(energy::Session& session) {
  auto& shares = session.summaries.back().shares;
  shares[Phase::update] = shares[Phase::build];
  shares[Phase::build].reset();
}

TEST(Model, ADevicesOwnUpdatesAreItsWorkAndItsBuildsTheCpus) {
  const Machine gpu{.animate = 33.6, .build = 50.0, .render = 60.0, .transfer = 36.0};
  energy::Session session = session_of({});
  add(session, {}, "bvh-median", "build", {.build = 20.0});
  add(session, gpu, "bvh-median", "build", {.build = 2.0});
  set_last(session, "gpu", "refit");
  set_last_to_update(session);
  add(session, gpu, "bvh-median", "static", {.render = 40.0});
  set_last(session, "gpu", "static");
  // Rebuilt by the CPU, refitted by the GPU.
  add(session, {.build = 33.6, .render = 60.0}, "bvh-median", "dynamic",
      {.build = 20.0, .render = 40.0});
  set_last(session, "gpu", "rebuild");
  add(session, gpu, "bvh-median", "dynamic", {.build = 2.0, .render = 40.0});
  set_last(session, "gpu", "refit");
  set_last_to_update(session);

  const ModelReport report = make_model_report("s", session, {});
  const auto by_phase = rates_of(report.phase, report.by_phase);
  EXPECT_NEAR(by_phase.at("build"), 33.6, 1e-9);
  EXPECT_NEAR(by_phase.at("update (gpu)"), 50.0, 1e-9);
  EXPECT_NEAR(by_phase.at("render (gpu)"), 60.0, 1e-9);
  const auto by_processor = rates_of(report.processor, report.by_processor);
  EXPECT_NEAR(by_processor.at("cpu"), 33.6, 1e-9);
  EXPECT_GT(by_processor.at("gpu"), 50.0);

  ASSERT_EQ(report.own.size(), 2U);
  EXPECT_NEAR(report.own[0].watts, (33.6 * 20.0 + 60.0 * 40.0) / 60.0, 1e-9);
  EXPECT_NEAR(report.own[1].watts, (50.0 * 2.0 + 60.0 * 40.0) / 42.0, 1e-9);
}

TEST(Model, OneRateIsEnoughForAMachineThatHasOne) {
  const Machine machine{.animate = 34.0, .build = 34.0, .render = 34.0, .transfer = 34.0};
  const ModelReport report = make_model_report("s", measured(machine), {});
  EXPECT_NEAR(rates_of(report.processor, report.by_processor).at("cpu"), 34.0, 1e-9);
  EXPECT_NEAR(energy::errors_of(report.processor, report.by_processor.observations, false).worst,
              0.0, 1e-9);
}

TEST(Model, OwnTestsAreTheThesisMix) {
  const ModelReport report = make_model_report("s", measured({}), {});
  ASSERT_EQ(report.own.size(), 2U);
  // (33.6 x 20 + 40.2 x 410) / 430 for all 435 ms, against 33.6 x 25 + 40.2 x 410.
  const double watts = (33.6 * 20.0 + 40.2 * 410.0) / 430.0;
  EXPECT_NEAR(report.own[0].watts, watts, 1e-9);
  EXPECT_NEAR(report.own[0].error, watts * 435.0 / (33.6 * 25.0 + 40.2 * 410.0) - 1.0, 1e-9);
  EXPECT_FALSE(report.own[0].outside);
}

TEST(Model, ADynamicRateThatIsNoMixIsTold) {
  energy::Session session = measured({});
  session.summaries.back().watts = energy::Watts(45.0);
  const ModelReport report = make_model_report("s", session, {});
  EXPECT_TRUE(report.own[1].outside);
  EXPECT_TRUE(any_contains(model_caveats(report), "1 of 2 dynamic configurations draw more"));
}

TEST(Model, GapsAreForTheModelAboveIdle) {
  // 30 ms of idling in each operation: a fifth to a twentieth of the energy of short builds.
  const ModelReport report = make_model_report("s", measured({}, 30.0), {});
  ASSERT_TRUE(report.general.fitted()) << report.general.problem;
  EXPECT_NEAR(report.idle->value, 19.0, 1e-12);
  auto rates = rates_of(report.general, report.by_phase);
  EXPECT_NEAR(rates.at("build"), 33.6 - 19.0, 1e-6);
  EXPECT_NEAR(rates.at("render (cpu)"), 40.2 - 19.0, 1e-6);
  const auto general = energy::errors_of(report.general, report.by_phase.observations, false);
  EXPECT_NEAR(general.worst, 0.0, 1e-9);
  EXPECT_GT(energy::errors_of(report.phase, report.by_phase.observations, false).rms, 0.02);
  EXPECT_TRUE(any_contains(model_caveats(report), "fill less than 95 %"));
}

TEST(Model, IdleThatNobodyMeasuredIsNotMadeUp) {
  energy::Session session = measured({});
  for (energy::SummaryRow& row : session.summaries) row.idle_watts.reset();
  const ModelReport report = make_model_report("s", session, {});
  EXPECT_FALSE(report.idle);
  EXPECT_FALSE(report.general.fitted());
  EXPECT_TRUE(contains(report.general.problem, "idle power has to be given"));
  EXPECT_THROW((void)calibration_of(report), UsageError);
  EXPECT_TRUE(contains(model_text(report), "give it with --idle"));
  const ModelReport given = make_model_report("s", session, {.idle_watts = 19.0});
  EXPECT_TRUE(given.general.fitted());
  EXPECT_NEAR(rates_of(given.general, given.by_phase).at("build"), 14.6, 1e-9);
}

TEST(Model, TransferThatNoTestIsolatesIsTold) {
  const ModelReport report = make_model_report("s", measured({}, 0.0, 50.0), {});
  EXPECT_TRUE(any_contains(model_caveats(report), "no test isolates transfer"));
  EXPECT_GT(report.phase.checks.back().assumed_share, 0.05);
  EXPECT_EQ(rates_of(report.phase, report.by_phase).count("transfer"), 0U);
}

TEST(Model, ModelledJoulesProveNothing) {
  energy::Session session = measured({});
  session.info.sensor.origin = energy::Origin::modelled;
  EXPECT_TRUE(
      any_contains(model_caveats(make_model_report("s", session, {})), "nothing of the machine"));
}

TEST(Model, CalibrationIsTheModelAboveIdle) {
  const energy::Calibration calibration =
      calibration_of(make_model_report("s", measured({}, 30.0), {}));
  EXPECT_NEAR(calibration.model.idle.value, 19.0, 1e-12);
  EXPECT_NEAR(calibration.model.delta[Phase::build]->value, 14.6, 1e-6);
  EXPECT_NEAR(calibration.model.delta[Phase::animate]->value, 14.6, 1e-6);
  EXPECT_NEAR(calibration.model.delta[Phase::render]->value, 21.2, 1e-6);
  EXPECT_FALSE(calibration.model.delta[Phase::transfer]);
  EXPECT_FALSE(calibration.model.gpu);
  EXPECT_NEAR(*calibration.model.uncertainty, 0.05, 1e-4);  // the sensor's gain
  EXPECT_EQ(calibration.machine, "processor");
}

TEST(Model, JsonIsJson) {
  for (const double gap : {0.0, 30.0}) {
    const std::string json =
        model_json(make_model_report("s", measured({}, gap, 10.0), {.battery_wh = 53.0}));
    EXPECT_TRUE(JsonChecker(json).valid()) << json;
  }
}

TEST(ModelCommand, ShowsTheModelsAndSavesConstants) {
  const TemporaryFolder folder;
  const std::string session = write_session(folder.path() / "session", measured({}, 30.0));
  const std::string file = folder.path() / "machine.toml";
  const ProgramResult result =
      run_encore({"model", session, "--battery", "53", "--save-calibration", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "Idle: 19.000 ± 0.082 W, from its baselines")) << result.out;
  EXPECT_TRUE(contains(result.out, "a charge")) << result.out;
  EXPECT_TRUE(contains(result.out, "Errors on dynamic tests")) << result.out;
  EXPECT_NEAR(energy::read_calibration(file).model.delta[Phase::build]->value, 14.6, 1e-6);
  const ProgramResult json = run_encore({"model", session, "--json"});
  EXPECT_TRUE(JsonChecker(json.out).valid()) << json.out;
}

TEST(ModelCommand, ASessionWithoutJoulesIsTold) {
  const TemporaryFolder folder;
  energy::Session session = session_of({{.joules = 0.0}});
  session.info.sensor = {energy::Origin::unavailable, "no sensor was found"};
  const ProgramResult result =
      run_encore({"model", write_session(folder.path() / "session", session)});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(contains(result.err, "no configuration has joules (no sensor was found)"))
      << result.err;
}

}  // namespace
}  // namespace encore::app
