// The runner with power sources: a counter whose truth is known, on a clock that only moves when
// the workload works or the runner sleeps.
#include "energy/runner.h"
#include "tests/support/sampling_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::energy {
namespace {

constexpr double kIdle = 10.0;  // watts
constexpr double kAbove[] = {0.0, 20.0, 0.0, 0.0, 40.0};

/// A counter that updates at its period: idle power, and more by the phase that runs.
class TrueCounter final : public PowerSource {
 public:
  TrueCounter(const LiveBusyTime& live, Seconds update_period) : live_(live) {
    info_.name = "simulated:truth";
    info_.provenance = {Origin::simulated, "constants"};
    info_.update_period = update_period;
    info_.poll_period = Seconds(0.05);
    info_.gain_uncertainty = 0.0;
  }
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  ReadResult read(Seconds now) override {
    const Seconds shown = info_.update_period * std::floor(now / info_.update_period);
    const PerPhase<Seconds> busy = live_.busy(shown);
    double joules = kIdle * shown.value;
    for (const Phase phase : kPhases) {
      joules += kAbove[static_cast<std::size_t>(phase)] * busy[phase].value;
    }
    if (!start_) start_ = joules;
    const bool changed = !last_ || *last_ != joules;
    last_ = joules;
    return {ReadState::ok, {now, Joules(joules - *start_), std::nullopt, changed}, {}};
  }

 private:
  const LiveBusyTime& live_;
  SourceInfo info_;
  std::optional<double> start_;
  std::optional<double> last_;
};

/// Builds, then renders, with a pause between operations.
class TwoPhases final : public Workload {
 public:
  explicit TwoPhases(const SamplingClock& clock) : clock_(clock) {}
  [[nodiscard]] std::string name() const override { return "two phases"; }
  [[nodiscard]] std::vector<KeyValue> configuration() const override { return {}; }
  void prepare() override {}
  void operation(PhaseLog& log) override {
    run_alone(Phase::build, log);
    run_alone(Phase::render, log);
    clock_.advance(pause);
  }
  [[nodiscard]] std::vector<Phase> separable() const override {
    return {Phase::build, Phase::render};
  }
  void run_alone(Phase phase, PhaseLog& log) override {
    const auto mark = log.mark(phase);
    clock_.advance(phase == Phase::build ? build : render);
    ++runs[phase];
  }
  [[nodiscard]] std::vector<Counter> counters(const PerPhase<Seconds>&) const override {
    return {};
  }

  Seconds build{0.02};
  Seconds render{0.03};
  Seconds pause{0.001};
  PerPhase<int> runs{};

 private:
  const SamplingClock& clock_;
};

class RunnerEnergy : public testing::Test {
 protected:
  Measurement run_it(Seconds update_period) {
    std::vector<std::unique_ptr<PowerSource>> sources;
    sources.push_back(std::make_unique<TrueCounter>(live, update_period));
    sampler = std::make_unique<Sampler>(std::move(sources), clock, SamplerSink{}, nullptr);
    clock.attach(sampler.get());
    RunContext context{clock, Seconds(1000.0), stop, {}, sampler.get(), {0}, &live};
    return run(workload, plan, context);
  }
  static Plan test_plan() {
    Plan plan;
    plan.idle_before = plan.idle_after = Seconds(2.0);
    plan.run = Seconds(3.0);
    plan.mix = Seconds(6.0);
    return plan;
  }

  SamplingClock clock;
  LiveBusyTime live{1U << 16U};
  TwoPhases workload{clock};
  Plan plan = test_plan();
  std::atomic<bool> stop{false};
  std::unique_ptr<Sampler> sampler;
};

TEST_F(RunnerEnergy, FollowsThePlan) {
  const Measurement m = run_it(Seconds(0.0001));
  ASSERT_EQ(m.idle.size(), 2U);
  for (const Window& idle : m.idle) EXPECT_NEAR((idle.to - idle.from).value, 2.0, 1e-9);
  EXPECT_GE((m.measured.to - m.measured.from).value, 3.0);
  EXPECT_GE(m.measured.from, m.idle[0].to + plan.warm_up);
  EXPECT_GE(m.idle[1].from, m.measured.to);
  EXPECT_NEAR(m.busy.operations(m.measured.from, m.measured.to),
              static_cast<double>(m.phase_counts[Phase::build]), 1e-6);
}

TEST_F(RunnerEnergy, RowsHoldExactEnergiesWhereTheSensorSeesEachPhase) {
  const Measurement m = run_it(Seconds(0.0001));
  EXPECT_TRUE(m.mixed.empty()) << "every phase is seen by itself: nothing to mix";
  for (const FrameRow& row : m.rows) {
    ASSERT_TRUE(row.joules[Phase::build]);
    ASSERT_TRUE(row.joules[Phase::render]);
    const double update = 1e-4;  // seconds: what an edge may be off by
    EXPECT_NEAR(row.joules[Phase::build]->value, 0.02 * (kIdle + 20), 60 * update);
    EXPECT_NEAR(row.joules[Phase::render]->value, 0.03 * (kIdle + 40), 60 * update);
    EXPECT_NEAR(row.operation_joules->value, 0.6 + 1.5, 60 * update);
    EXPECT_GT(row.operation_joules_ci95->value, 0.0);
    EXPECT_EQ(row.origin, Origin::simulated);
    EXPECT_FALSE(row.joules[Phase::animate]);
  }
}

TEST_F(RunnerEnergy, MixesPhasesThatAreTooShortForTheSensor) {
  workload.build = Seconds(0.002);
  workload.render = Seconds(0.003);
  const Measurement m = run_it(Seconds(0.05));
  ASSERT_EQ(m.mixed.size(), 1U);
  EXPECT_GT((m.mixed[0].to - m.mixed[0].from).value, 2.0);
  EXPECT_LT((m.mixed[0].to - m.mixed[0].from).value, 9.0);
  EXPECT_NE(workload.runs[Phase::build], workload.runs[Phase::render]);
  for (const FrameRow& row : m.rows) {
    EXPECT_FALSE(row.joules[Phase::build]) << "a row of 10 ms is too short for this sensor";
    EXPECT_FALSE(row.operation_joules);
    EXPECT_EQ(row.origin, Origin::unavailable);
  }
}

/// Attributes a run and holds it to the constants.
void expect_truth(const Measurement& m, const Sampler& sampler, AttributionMethod method) {
  AttributionInput input;
  input.source = &sampler.info(0);
  input.trace = sampler.trace(0).view();
  input.busy = &m.busy;
  input.measured = {m.measured};
  input.mixed = m.mixed;
  input.idle = m.idle;
  const Attribution found = attribute(input);
  ASSERT_TRUE(found.idle);
  EXPECT_NEAR(found.idle->watts.value, kIdle, std::max(0.01, found.idle->watts.half_width));
  EXPECT_LT(found.idle->watts.half_width, 0.05 * kIdle);
  ASSERT_EQ(found.phases.size(), 2U);
  for (const PhaseEnergy& phase : found.phases) {
    const double above = phase.column == "build" ? 20.0 : 40.0;
    ASSERT_TRUE(phase.watts) << phase.column << ": " << phase.reason;
    EXPECT_EQ(phase.method, method);
    EXPECT_NEAR(phase.watts->value, kIdle + above, 0.01 * above) << phase.column;
    EXPECT_LT(phase.watts->half_width, 0.1 * above) << phase.column;
  }
}

TEST_F(RunnerEnergy, PhasesAreFoundByTheirEdges) {
  const Measurement m = run_it(Seconds(0.0001));
  expect_truth(m, *sampler, AttributionMethod::windows);
}

TEST_F(RunnerEnergy, PhasesAreFoundByRegression) {
  workload.build = Seconds(0.002);
  workload.render = Seconds(0.003);
  const Measurement m = run_it(Seconds(0.023));
  expect_truth(m, *sampler, AttributionMethod::regression);
}

TEST_F(RunnerEnergy, StopsWhenItIsGoodEnough) {
  plan.until = 0.01;
  plan.until_limit = Seconds(60.0);
  std::vector<std::unique_ptr<PowerSource>> none;
  int rows = 0;
  RunContext context{clock, Seconds(1000.0), stop, {}, nullptr, {}, nullptr};
  context.observer.on_row = [&](const FrameRow&) { ++rows; };
  context.observer.enough = [&] { return rows >= 200; };
  const Measurement m = run(workload, plan, context);
  EXPECT_GE(rows, 200);
  EXPECT_LE(rows, 202);
  EXPECT_GT((m.measured.to - m.measured.from).value, plan.run.value);
}

TEST_F(RunnerEnergy, GivesUpAtTheLimit) {
  plan.until = 0.01;
  plan.until_limit = Seconds(20.0);
  RunContext context{clock, Seconds(1000.0), stop, {}, nullptr, {}, nullptr};
  context.observer.enough = [] { return false; };
  const Measurement m = run(workload, plan, context);
  EXPECT_NEAR((m.measured.to - m.measured.from).value, 20.0, 0.1);
}

}  // namespace
}  // namespace encore::energy
