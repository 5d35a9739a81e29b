#include "energy/sampling/sampler.h"

#include "tests/support/fake_clock.h"

#include <gtest/gtest.h>

#include <map>

namespace encore::energy {
namespace {

/// Plays results that a test scripts; when there are no more, a steady 10 W.
class ScriptedSource final : public PowerSource {
 public:
  ScriptedSource(std::string name, Seconds poll) {
    info_.name = std::move(name);
    info_.poll_period = poll;
    info_.update_period = poll;
  }
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  ReadResult read(Seconds now) override {
    ++reads;
    if (!script.empty()) {
      ReadResult result = script.front();
      script.erase(script.begin());
      result.reading.time = now;
      return result;
    }
    return {ReadState::ok, {now, Joules(10 * now.value), Watts(10), true}, {}};
  }

  std::vector<ReadResult> script;
  int reads = 0;

 private:
  SourceInfo info_;
};

struct Sampling {
  FakeClock clock;
  ScriptedSource* fast = nullptr;
  ScriptedSource* slow = nullptr;
  Seconds asleep;
  std::vector<SamplerEvent> events;
  std::map<std::string, int> readings;
  std::unique_ptr<Sampler> sampler;

  Sampling() {
    auto a = std::make_unique<ScriptedSource>("fast", Seconds(0.1));
    auto b = std::make_unique<ScriptedSource>("slow", Seconds(1.0));
    fast = a.get();
    slow = b.get();
    std::vector<std::unique_ptr<PowerSource>> sources;
    sources.push_back(std::move(a));
    sources.push_back(std::move(b));
    SamplerSink sink;
    sink.on_event = [this](const SamplerEvent& event) { events.push_back(event); };
    sink.on_reading = [this](const SourceInfo& info, const ReadResult&) { ++readings[info.name]; };
    sampler = std::make_unique<Sampler>(std::move(sources), clock, sink,
                                        [this] { return clock.now() + asleep; });
  }
  void run_for(double seconds) {
    const Seconds end = clock.now() + Seconds(seconds);
    while (clock.now() < end) {
      const Seconds next = sampler->poll();
      clock.advance((std::min(next, end) - clock.now()).value);
    }
  }
};

TEST(Sampler, ReadsEachSourceAtItsOwnPeriod) {
  Sampling setup;
  setup.run_for(10.0);
  EXPECT_NEAR(setup.fast->reads, 100, 1);
  EXPECT_NEAR(setup.slow->reads, 10, 1);
  EXPECT_EQ(setup.readings["fast"], setup.fast->reads);
  EXPECT_TRUE(setup.events.empty());
  const TraceView view = setup.sampler->trace(0).view();
  EXPECT_NEAR(view.energy_between(Seconds(1000), Seconds(1009))->value, 90, 1e-9);
}

TEST(Sampler, ReadsAtOnceWhenAsked) {
  Sampling setup;
  setup.sampler->read_now();
  EXPECT_EQ(setup.fast->reads, 1);
  EXPECT_EQ(setup.slow->reads, 1);
  setup.clock.advance(0.01);
  setup.sampler->read_now(Seconds(0.5));
  EXPECT_EQ(setup.fast->reads, 2);
  EXPECT_EQ(setup.slow->reads, 1) << "updates too seldom to be worth it";
}

TEST(Sampler, TellsAFailureOnceAndLeavesAGap) {
  Sampling setup;
  setup.run_for(1.0);
  const ReadResult failed{ReadState::failed, {}, "fast: permission denied"};
  setup.fast->script = {failed, failed, failed};
  setup.run_for(2.0);
  ASSERT_EQ(setup.events.size(), 1U);
  EXPECT_EQ(setup.events[0].message, "fast: permission denied");
  EXPECT_EQ(setup.events[0].source, "fast");
  const TraceView view = setup.sampler->trace(0).view();
  EXPECT_FALSE(view.energy_between(Seconds(1000), Seconds(1002.5)));
  EXPECT_GT(view.gaps_between(Seconds(1000), Seconds(1003)).value, 0.25);
  EXPECT_TRUE(setup.sampler->trace(1).view().energy_between(Seconds(1000), Seconds(1002)))
      << "the other source goes on";
}

TEST(Sampler, NeverReadsALostSourceAgain) {
  Sampling setup;
  setup.fast->script = {{ReadState::lost, {}, "fast: the device was removed"}};
  setup.run_for(1.0);
  EXPECT_EQ(setup.fast->reads, 1);
  EXPECT_TRUE(setup.sampler->lost(0));
  EXPECT_FALSE(setup.sampler->lost(1));
  EXPECT_TRUE(setup.sampler->trace(0).view().empty()) << "never a 0 in place of a reading";
  ASSERT_EQ(setup.events.size(), 1U);
}

TEST(Sampler, SuspendVoidsTheStretchOfEverySource) {
  Sampling setup;
  setup.run_for(1.0);
  setup.asleep = Seconds(3600);
  setup.run_for(1.0);
  ASSERT_EQ(setup.events.size(), 1U);
  EXPECT_NE(setup.events[0].message.find("suspended for 3600 s"), std::string::npos);
  for (const std::size_t source : {0U, 1U}) {
    const TraceView view = setup.sampler->trace(source).view();
    EXPECT_FALSE(view.energy_between(view.points().front().time, view.points().back().time));
  }
}

TEST(Sampler, ARestartedCounterBeginsANewStretch) {
  Sampling setup;
  setup.run_for(0.5);
  setup.fast->script = {{ReadState::restarted,
                         {{}, Joules(10005), std::nullopt, true},
                         "fast: the counter was reset"}};
  setup.run_for(0.5);
  ASSERT_EQ(setup.events.size(), 1U);
  EXPECT_FALSE(setup.sampler->trace(0).view().energy_between(Seconds(1000), Seconds(1000.9)));
}

TEST(Sampler, CountsItsOwnCost) {
  Sampling setup;
  setup.run_for(10.0);
  const SamplerCost cost = setup.sampler->cost();
  EXPECT_NEAR(cost.elapsed.value, 10.0, 1e-9);
  EXPECT_GT(cost.processor.value, 0.0);
  EXPECT_GE(cost.polls, 100U);
}

TEST(SamplerThread, PollsUntilItIsDestroyed) {
  const SteadyClock clock;
  std::vector<std::unique_ptr<PowerSource>> sources;
  sources.push_back(std::make_unique<ScriptedSource>("fast", Seconds(0.001)));
  Sampler sampler(std::move(sources), clock);
  {
    const SamplerThread thread(sampler, clock);
    while (sampler.trace(0).size() < 20) {
      sampler.read_now();
      std::this_thread::yield();
    }
  }
  const std::size_t size = sampler.trace(0).size();
  EXPECT_GE(size, 20U);
  EXPECT_EQ(sampler.trace(0).size(), size);
}

}  // namespace
}  // namespace encore::energy
