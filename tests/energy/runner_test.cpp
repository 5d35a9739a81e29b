#include "energy/runner.h"

#include "tests/support/fake_clock.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace encore::energy {
namespace {

/// An operation that animates and builds for fixed times of a fake clock, and wastes some between.
class FakeWorkload final : public Workload {
 public:
  explicit FakeWorkload(FakeClock& clock) : clock_(clock) {}

  [[nodiscard]] std::string name() const override { return "fake"; }
  [[nodiscard]] std::vector<KeyValue> configuration() const override {
    return {{"operations_so_far", std::to_string(operations)}};
  }
  void prepare() override {
    prepared = true;
    clock_.advance(5.0);
  }
  void operation(PhaseLog& log) override {
    EXPECT_TRUE(prepared);
    if (animate_s > 0) {
      const auto mark = log.mark(Phase::animate);
      clock_.advance(animate_s);
    }
    clock_.advance(between_s);
    {
      const auto mark = log.mark(Phase::build);
      clock_.advance(build_s);
    }
    ++operations;
    if (operations == stop_after && stop != nullptr) *stop = true;
  }
  [[nodiscard]] std::vector<Counter> counters(const PerPhase<Seconds>&) const override {
    return {};
  }

  // Powers of two, so that sums are exact.
  double animate_s = 0.0;
  double between_s = 0.0;
  double build_s = 1.0 / 256;
  int operations = 0;
  int stop_after = -1;
  std::atomic<bool>* stop = nullptr;
  bool prepared = false;

 private:
  FakeClock& clock_;
};

class Runner : public testing::Test {
 protected:
  Measurement run_it() {
    return run(workload, plan,
               RunContext{clock, Seconds(1000.0), stop, observer, nullptr, {}, nullptr});
  }

  static Plan test_plan() {
    Plan plan;
    plan.warm_up = Seconds(1.0 / 64);
    plan.run = Seconds(1.0 / 8);
    plan.row = Seconds(1.0 / 64);
    return plan;
  }

  FakeClock clock;
  FakeWorkload workload{clock};
  Plan plan = test_plan();
  std::atomic<bool> stop{false};
  RunObserver observer;
};

TEST_F(Runner, RunsExactlyAsManyOperationsAsFitTheTimes) {
  const Measurement m = run_it();
  EXPECT_EQ(m.phase_counts[Phase::build], 32U);
  EXPECT_EQ(m.phase_counts[Phase::render], 0U);
  EXPECT_EQ(workload.operations, 4 + 32) << "warm-up and measured";
  EXPECT_FALSE(m.stopped);
}

TEST_F(Runner, GathersShortOperationsIntoRowsAndCountsFromTheSessionsStart) {
  const Measurement m = run_it();
  ASSERT_EQ(m.rows.size(), 8U);
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    EXPECT_EQ(m.rows[i].operations, 4U);
    EXPECT_EQ(m.rows[i].phases[Phase::build], Seconds(1.0 / 256));
    EXPECT_FALSE(m.rows[i].phases[Phase::animate]) << "did not happen, so it is missing, not 0";
    EXPECT_EQ(m.rows[i].time, Seconds(5.0 + 1.0 / 64 + static_cast<double>(i) / 64));
  }
}

TEST_F(Runner, ALongRunKeepsABoundedNumberOfRowsAndItsMean) {
  workload.build_s = 1.0 / 64;
  plan.run = Seconds(3000.0);
  std::size_t told = 0;
  observer.on_row = [&](const FrameRow&) { ++told; };
  const Measurement m = run_it();
  EXPECT_EQ(told, 192000U);
  EXPECT_LT(m.rows.size(), 65536U);
  const SummaryRow summary = summarise(m.rows, m.phase_counts);
  EXPECT_EQ(summary.operations, 192000U);
  EXPECT_NEAR(summary.mean.value, 1.0 / 64, 1e-12);
}

TEST_F(Runner, LongOperationsHaveARowEach) {
  workload.build_s = 0.5;
  const Measurement m = run_it();
  ASSERT_EQ(m.rows.size(), 3U) << "the least number of operations, though the time is long over";
  for (const FrameRow& row : m.rows) EXPECT_EQ(row.operations, 1U);
}

TEST_F(Runner, ShortOperationsNeverMakeMoreThanAHundredRowsASecond) {
  workload.build_s = 1.0 / 65536;
  plan = Plan{};
  plan.run = Seconds(2.0);
  const Measurement m = run_it();
  EXPECT_LE(m.rows.size(), 200U);
  EXPECT_GE(m.rows.size(), 190U);
  EXPECT_EQ(m.phase_counts[Phase::build], 2U * 65536U);
}

TEST_F(Runner, TheMostOperationsEndTheRunEarly) {
  plan.max_operations = 5;
  const Measurement m = run_it();
  EXPECT_EQ(m.phase_counts[Phase::build], 5U);
  ASSERT_EQ(m.rows.size(), 2U);
  EXPECT_EQ(m.rows[1].operations, 1U) << "the last row holds what is left";
}

TEST_F(Runner, ZeroSecondsStillMeasureTheLeastNumberOfOperations) {
  plan.warm_up = plan.run = Seconds(0);
  EXPECT_EQ(run_it().phase_counts[Phase::build], plan.min_operations);
}

TEST_F(Runner, TimeBetweenPhasesIsNotCounted) {
  workload.animate_s = 1.0 / 512;
  workload.between_s = 1.0 / 256;
  const Measurement m = run_it();
  for (const FrameRow& row : m.rows) {
    EXPECT_EQ(row.total(), Seconds(1.0 / 256 + 1.0 / 512));
    EXPECT_EQ(row.phases[Phase::animate], Seconds(1.0 / 512));
  }
}

TEST_F(Runner, StopKeepsWhatWasMeasured) {
  workload.stop = &stop;
  workload.stop_after = 4 + 6;
  const Measurement m = run_it();
  EXPECT_TRUE(m.stopped);
  EXPECT_EQ(m.phase_counts[Phase::build], 6U);
  ASSERT_EQ(m.rows.size(), 2U);
  EXPECT_EQ(m.rows[1].operations, 2U);
}

TEST_F(Runner, StopWhileWarmingUpMeasuresNothing) {
  workload.stop = &stop;
  workload.stop_after = 2;
  const Measurement m = run_it();
  EXPECT_TRUE(m.stopped);
  EXPECT_TRUE(m.rows.empty());
  EXPECT_EQ(workload.operations, 2);
}

TEST_F(Runner, TellsRowsAsTheyComeAndProgressUpToTheEnd) {
  std::vector<FrameRow> told;
  double progress = -1.0;
  observer.on_row = [&](const FrameRow& row) { told.push_back(row); };
  observer.on_progress = [&](double share, std::string_view) {
    EXPECT_GE(share, progress);
    EXPECT_LE(share, 1.0);
    progress = share;
  };
  const Measurement m = run_it();
  EXPECT_EQ(told, m.rows);
  EXPECT_EQ(progress, 1.0);
  EXPECT_EQ(told.back().configuration[0].value, "36") << "asked for when the row is finished";
}

TEST_F(Runner, SummaryAddsUpTheRows) {
  workload.animate_s = 1.0 / 256;
  workload.build_s = 3.0 / 256;
  const Measurement m = run_it();
  const SummaryRow s = summarise(m.rows, m.phase_counts);
  EXPECT_EQ(s.operations, m.phase_counts[Phase::build]);
  EXPECT_EQ(s.mean, Seconds(1.0 / 64));
  EXPECT_EQ(s.ci95, Seconds(0.0));
  EXPECT_EQ(s.shares[Phase::animate], 0.25);
  EXPECT_EQ(s.shares[Phase::build], 0.75);
  EXPECT_FALSE(s.shares[Phase::render]);
  EXPECT_EQ(s.seconds, Seconds(static_cast<double>(s.operations) / 64));
}

TEST(PhaseLog, PhasesDoNotNest) {
  const FakeClock clock;
  PhaseLog log(clock);
  const auto mark = log.mark(Phase::build);
  EXPECT_THROW((void)log.mark(Phase::render), std::logic_error);
}

TEST(PhaseLog, RecordsStartAndEndInOrder) {
  FakeClock clock;
  PhaseLog log(clock);
  {
    const auto mark = log.mark(Phase::update);
    clock.advance(2.0);
  }
  {
    const auto mark = log.mark(Phase::render);
    clock.advance(1.0);
  }
  ASSERT_EQ(log.spans().size(), 2U);
  EXPECT_EQ(log.spans()[0].phase, Phase::update);
  EXPECT_EQ(log.spans()[0].start, Seconds(1000.0));
  EXPECT_EQ(log.spans()[0].end, Seconds(1002.0));
  EXPECT_EQ(log.spans()[1].end - log.spans()[1].start, Seconds(1.0));
  log.clear();
  EXPECT_TRUE(log.spans().empty());
}

TEST(PhaseLog, NeverAllocatesWhileMarking) {
  const FakeClock clock;
  PhaseLog log(clock, 2);
  const PhaseSpan* memory = log.spans().data();
  for (int i = 0; i < 2; ++i) {
    const auto mark = log.mark(Phase::build);
  }
  EXPECT_EQ(log.spans().data(), memory);
  EXPECT_THROW((void)log.mark(Phase::build), std::logic_error) << "full";
  EXPECT_EQ(log.spans().size(), 2U);
}

}  // namespace
}  // namespace encore::energy
