#pragma once

#include "tests/compare/written_session.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::app {

inline constexpr double kIdleWatts = 20.0;
inline constexpr double kPrepareWatts = 28.0;
inline constexpr double kBuildWatts = 32.0;
inline constexpr double kRenderWatts = 46.0;

/// What a configuration really took.
struct Truth {
  double from = 0.0;  ///< of its measured window, on the session's clock
  double to = 0.0;
  double until = 0.0;  ///< end of its last window
  double operations = 0.0;
  double watts = 0.0;   ///< mean of the measured window
  double joules = 0.0;  ///< an operation
};

/// How a meter records.
struct MeterSettings {
  double offset = 0.0;  ///< session's time minus its own
  double spacing = 0.1;
  double noise = 0.0;     ///< watts
  bool counter = false;   ///< joules instead of watts
  double gap_from = 0.0;  ///< on the session's clock: no rows
  double gap_to = 0.0;
  double from = -5.0;  ///< on the session's clock: its first row
};

/// A session of a machine whose power at any time is known.
struct RecordedSession {
  struct Level {
    double from = 0.0;
    double watts = 0.0;
  };
  energy::Session session;
  std::vector<Truth> truths;
  std::vector<Level> levels;  ///< from this time on so many watts
  double end = 0.0;

  /// Mean power in [from, to].
  [[nodiscard]] double mean_watts(double from, double to) const {
    double joules = 0.0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double left = i == 0 ? from : std::max(from, levels[i].from);
      const double right = i + 1 < levels.size() ? std::min(to, levels[i + 1].from) : to;
      if (right > left) joules += levels[i].watts * (right - left);
    }
    return joules / (to - from);
  }

  /// The meter's file. Each row tells the mean power around its time.
  [[nodiscard]] std::string csv(const MeterSettings& meter) const {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    std::string text = meter.counter ? "time_s,energy_j\n" : "time_s,power_w\n";
    double joules = 1000.0;
    for (int i = 0; meter.from + meter.spacing * i < end + 5.0; ++i) {
      const double time = meter.from + meter.spacing * i;
      const double half = meter.counter ? 0.0 : meter.spacing / 2;
      const double watts =
          mean_watts(time - meter.spacing + half, time + half) + meter.noise * normal(random);
      joules += watts * meter.spacing;
      if (time >= meter.gap_from && time < meter.gap_to) continue;
      text += fmt::format("{:.4f},{:.5f}\n", time - meter.offset,
                          meter.counter ? joules : std::max(0.0, watts));
    }
    return text;
  }
};

/// Adds configurations to a session as the runner would measure them.
class SessionMaker {
 public:
  SessionMaker() {
    made_.session = session_of({});
    made_.session.info.plan.cool_down = energy::Seconds(0);
    level(kPrepareWatts);
    time_ = 1.5;
  }

  struct Lengths {
    double idle = 4.0;
    double warm_up = 0.5;
    double run = 20.0;
    double prepare = 1.0;
  };
  /// One configuration; seconds of a build and a frame, 0 where there is none.
  void add(const std::string& structure, double build, double render, const Lengths& lengths) {
    const bool renders = render > 0;
    energy::SummaryRow row =
        summary_of({.structure = structure, .test = renders ? "static" : "build", .joules = 0.0});
    level(kPrepareWatts);
    time_ += lengths.prepare;
    std::vector<energy::WindowRow> windows{idle(row, lengths.idle)};
    level(renders ? kRenderWatts : kBuildWatts);
    time_ += lengths.warm_up;
    const double from = time_;
    const std::uint64_t operations = run(row, build, render, lengths.run);
    const double to = time_;
    windows.push_back(idle(row, lengths.idle * 1.2));
    windows.push_back({row.configuration, "measured", energy::Seconds(from), energy::Seconds(to)});
    auto& all = made_.session.windows;
    all.insert(all.end(), windows.begin(), windows.end());
    made_.session.summaries.push_back(row);
    made_.truths.push_back({from, to, time_, static_cast<double>(operations), 0.0, 0.0});
  }

  RecordedSession take() {
    level(kIdleWatts);
    made_.end = time_;
    for (Truth& truth : made_.truths) {
      truth.watts = made_.mean_watts(truth.from, truth.to);
      truth.joules = truth.watts * (truth.to - truth.from) / truth.operations;
    }
    return std::move(made_);
  }

 private:
  void level(double watts) { made_.levels.push_back({time_, watts}); }
  energy::WindowRow idle(const energy::SummaryRow& row, double length) {
    level(kIdleWatts);
    time_ += length;
    return {row.configuration, "idle", energy::Seconds(time_ - length), energy::Seconds(time_)};
  }
  /// Rows of one operation each, without a pause.
  std::uint64_t run(energy::SummaryRow& row, double build, double render, double length) {
    row.operations = 0;
    for (const double start = time_; time_ < start + length; ++row.operations) {
      energy::FrameRow frame;
      frame.time = energy::Seconds(time_);
      frame.configuration = row.configuration;
      frame.operations = 1;
      if (build > 0) {
        frame.phases[energy::Phase::build] = energy::Seconds(build);
        level(kBuildWatts);
        time_ += build;
      }
      if (render > 0) {
        frame.phases[energy::Phase::render] = energy::Seconds(render);
        level(kRenderWatts);
        time_ += render;
      }
      made_.session.frames.push_back(frame);
    }
    row.mean = energy::Seconds(build + render);
    return row.operations;
  }

  RecordedSession made_;
  double time_ = 0.0;
};

/// Four configurations of irregular lengths; that of "kd-sah" has two phases of seconds.
inline RecordedSession recorded_session(unsigned seed = 3) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) / 9007199254740992.0;
  };
  SessionMaker maker;
  const auto lengths = [&]() -> SessionMaker::Lengths {
    return {between(3, 7), between(0.3, 0.9), between(11, 29), between(0.5, 2.5)};
  };
  maker.add("bvh-median", 0.0, 0.25, lengths());
  maker.add("grid-exact", 0.04, 0.0, lengths());
  maker.add("kd-sah", 4.0, 5.0, lengths());
  maker.add("brute", 0.0, 1.1, lengths());
  return maker.take();
}

/// Eight equal configurations.
inline RecordedSession repeating_session() {
  SessionMaker maker;
  for (int i = 0; i < 8; ++i) maker.add("structure-" + std::to_string(i), 0.0, 0.5, {});
  return maker.take();
}

/// The truth lies in the interval, which is no wider than asked for.
template <class Unit>
void expect_within(std::optional<Unit> value, std::optional<Unit> half_width, double truth,
                   double relative_half_width) {
  ASSERT_TRUE(value && half_width);
  EXPECT_NEAR(value->value, truth, half_width->value);
  EXPECT_LT(half_width->value, relative_half_width * truth);
}

/// The total's row of phases.csv.
inline const energy::PhaseRow& phase_row(const energy::Session& session,
                                         const std::string& structure, const std::string& phase) {
  for (const energy::PhaseRow& row : session.phases) {
    const bool of_it = row.configuration.at(2).value == structure && row.phase == phase;
    if (of_it && row.source == "total") return row;
  }
  throw std::out_of_range(structure + " " + phase);
}

}  // namespace encore::app
