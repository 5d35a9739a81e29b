#include "energy/model/energy_model.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace encore::energy {

namespace {

constexpr double kBusyTolerance = 0.05;

/// First-order propagation: adds up (derivative x half-width)^2 of independent inputs.
class Propagation {
 public:
  void add(double derivative, double half_width) {
    const double part = derivative * half_width;
    squares_ += part * part;
  }
  [[nodiscard]] double half_width() const { return std::sqrt(squares_); }

 private:
  double squares_ = 0.0;
};

void check(const Uncertain& value, const std::string& name) {
  if (!(std::isfinite(value.value) && value.value >= 0.0 && std::isfinite(value.half_width) &&
        value.half_width >= 0.0)) {
    throw std::invalid_argument(fmt::format("{} is {} ± {}; it must be a number of 0 or more", name,
                                            value.value, value.half_width));
  }
}

void check(const ModelInput& input) {
  for (std::size_t i = 0; i < input.rates.size(); ++i) {
    check(input.rates[i], fmt::format("rate {}", i));
  }
  for (const FrameWork& work : input.work) {
    check(work.seconds, "the time of " + work.name);
    if (work.rate >= input.rates.size()) {
      throw std::invalid_argument(work.name + " has no rate");
    }
  }
}

/// 1 / x.
Uncertain reciprocal(Uncertain x) {
  return {1.0 / x.value, x.half_width / (x.value * x.value)};
}

/// Energy above `idle` and its parts; with idle 0 that is all of it.
struct WorkSums {
  double seconds = 0.0;
  double joules = 0.0;
  std::vector<double> seconds_of_rate;
  std::vector<Uncertain> joules_of_work;
};

WorkSums add_up(const ModelInput& input) {
  WorkSums sums;
  sums.seconds_of_rate.assign(input.rates.size(), 0.0);
  for (const FrameWork& work : input.work) {
    const Uncertain& rate = input.rates[work.rate];
    sums.seconds += work.seconds.value;
    sums.seconds_of_rate[work.rate] += work.seconds.value;
    sums.joules += rate.value * work.seconds.value;
    Propagation part;
    part.add(rate.value, work.seconds.half_width);
    part.add(work.seconds.value, rate.half_width);
    sums.joules_of_work.push_back({rate.value * work.seconds.value, part.half_width()});
  }
  return sums;
}

}  // namespace

ModelPrediction predict_sequential(const ModelInput& input) {
  check(input);
  const WorkSums sums = add_up(input);
  if (!(sums.seconds > 0.0)) throw std::invalid_argument("a frame without any busy time");

  // E = sum P_k t_k; the mean rate is E / T with T = sum t_k, so its slope in t_k is (P_k - E/T)/T.
  const double mean_rate = sums.joules / sums.seconds;
  Propagation seconds;
  Propagation joules;
  Propagation watts;
  for (const FrameWork& work : input.work) {
    const double rate = input.rates[work.rate].value;
    seconds.add(1.0, work.seconds.half_width);
    joules.add(rate, work.seconds.half_width);
    watts.add((rate - mean_rate) / sums.seconds, work.seconds.half_width);
  }
  for (std::size_t i = 0; i < input.rates.size(); ++i) {
    joules.add(sums.seconds_of_rate[i], input.rates[i].half_width);
    watts.add(sums.seconds_of_rate[i] / sums.seconds, input.rates[i].half_width);
  }

  ModelPrediction prediction;
  prediction.seconds = {sums.seconds, seconds.half_width()};
  prediction.frames_per_second = reciprocal(prediction.seconds);
  prediction.watts = {mean_rate, watts.half_width()};
  prediction.joules = {sums.joules, joules.half_width()};
  prediction.frames_per_joule = reciprocal(prediction.joules);
  prediction.joules_of_work = sums.joules_of_work;
  return prediction;
}

ModelPrediction predict_overlapping(Uncertain idle_watts, Uncertain frame_seconds,
                                    const ModelInput& input) {
  check(input);
  check(idle_watts, "the idle rate");
  check(frame_seconds, "the time of a frame");
  if (!(frame_seconds.value > 0.0)) throw std::invalid_argument("a frame that takes no time");
  const WorkSums sums = add_up(input);
  const double length = frame_seconds.value;
  const double total = idle_watts.value * length + sums.joules;

  // E = P_idle T + sum dP_k t_k; the mean rate is E / T, whose slope in T is -sum dP_k t_k / T^2.
  Propagation joules;
  Propagation watts;
  joules.add(length, idle_watts.half_width);
  joules.add(idle_watts.value, frame_seconds.half_width);
  watts.add(1.0, idle_watts.half_width);
  watts.add(sums.joules / (length * length), frame_seconds.half_width);
  for (const FrameWork& work : input.work) {
    const double rate = input.rates[work.rate].value;
    joules.add(rate, work.seconds.half_width);
    watts.add(rate / length, work.seconds.half_width);
  }
  for (std::size_t i = 0; i < input.rates.size(); ++i) {
    joules.add(sums.seconds_of_rate[i], input.rates[i].half_width);
    watts.add(sums.seconds_of_rate[i] / length, input.rates[i].half_width);
  }

  ModelPrediction prediction;
  prediction.seconds = frame_seconds;
  prediction.frames_per_second = reciprocal(frame_seconds);
  prediction.watts = {total / length, watts.half_width()};
  prediction.joules = {total, joules.half_width()};
  prediction.frames_per_joule = reciprocal(prediction.joules);
  prediction.joules_of_work = sums.joules_of_work;
  prediction.busy_share = sums.seconds / length;
  if (std::fabs(prediction.busy_share - 1.0) > kBusyTolerance) {
    prediction.warning = fmt::format(
        "busy time is {:.0f} % of the frame's time: work {}, and a model of rates that "
        "follow each other does not hold",
        100.0 * prediction.busy_share, prediction.busy_share > 1.0 ? "overlaps" : "leaves gaps");
  }
  return prediction;
}

Uncertain frames_for(Uncertain capacity_joules, const ModelPrediction& prediction) {
  check(capacity_joules, "the capacity");
  const Uncertain& per_joule = prediction.frames_per_joule;
  Propagation frames;
  frames.add(per_joule.value, capacity_joules.half_width);
  frames.add(capacity_joules.value, per_joule.half_width);
  return {capacity_joules.value * per_joule.value, frames.half_width()};
}

Uncertain above_idle(Uncertain gross_watts, Uncertain idle_watts) {
  return {gross_watts.value - idle_watts.value,
          std::hypot(gross_watts.half_width, idle_watts.half_width)};
}

}  // namespace encore::energy
