#include "energy/sources/simulated.h"

#include "energy/sampling/low_pass.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace encore::energy {

StepPower::StepPower(Seconds start, Watts before)
    : knots_{{start, Joules(0)}}, before_(before), last_(before) {}

void StepPower::add(Seconds end, Watts power) {
  const Knot& last = knots_.back();
  knots_.push_back({end, last.energy + power * (end - last.time)});
  last_ = power;
}

Joules StepPower::energy_until(Seconds time) const {
  if (time < knots_.front().time) return before_ * (time - knots_.front().time);
  if (time >= knots_.back().time) return knots_.back().energy + last_ * (time - knots_.back().time);
  const auto next = std::upper_bound(knots_.begin(), knots_.end(), time,
                                     [](Seconds t, const Knot& knot) { return t < knot.time; });
  const Knot& a = *(next - 1);
  return a.energy + (next->energy - a.energy) * ((time - a.time) / (next->time - a.time));
}

SimulatedSource::SimulatedSource(SimulatedSettings settings)
    : settings_(std::move(settings)), random_(settings_.seed) {
  settings_.info.kind = SourceKind::simulated;
  Provenance& provenance = settings_.info.provenance;
  provenance.origin = Origin::simulated;
  if (provenance.detail.empty()) provenance.detail = "known power, no sensor";
}

Joules SimulatedSource::true_energy(Seconds from, Seconds to) const {
  return settings_.energy_until(to) - settings_.energy_until(from);
}

double SimulatedSource::hold() {
  const double shortest = settings_.shortest_hold.value;
  const double longest = settings_.longest_hold.value;
  if (longest <= shortest) return shortest;
  return std::uniform_real_distribution<double>(shortest, longest)(random_);
}

double SimulatedSource::next_noise() {
  if (settings_.noise <= 0) return 0.0;
  const double phi = settings_.noise_correlation;
  noise_now_ = phi * noise_now_ + std::sqrt(1 - phi * phi) * normal_(random_);
  return settings_.noise * noise_now_;
}

double SimulatedSource::smoothed(Seconds time) {
  const auto mean_power = [&](Seconds from, Seconds to) {
    return (true_energy(from, to) / (to - from)).value;
  };
  const Seconds window = std::max(settings_.window, Seconds(1e-6));
  const Seconds tau = settings_.info.smoothing;
  if (tau.value <= 0) return mean_power(time - window, time);
  if (!opened_) {
    filtered_ = mean_power(time - window, time);
  } else {
    // What lies further back is below rounding: after hours, a smoothing of milliseconds would take
    // more steps than there is time for.
    const Seconds begin = std::max(filtered_until_, time - tau * 40.0);
    // Exact for power that is constant within a step.
    const double steps = std::max(1.0, std::ceil((time - begin) / (tau / 32.0)));
    const Seconds step = (time - begin) / steps;
    for (int i = 0; step.value > 0 && i < static_cast<int>(steps); ++i) {
      const Seconds from = begin + step * i;
      const double watts = mean_power(from, from + step);
      filtered_ = low_pass_step(filtered_, watts, step.value, tau.value);
    }
  }
  filtered_until_ = time;
  return filtered_;
}

void SimulatedSource::update_at(Seconds time) {
  last_update_ = time;
  if (!settings_.info.is_counter) {
    shown_ = settings_.gain * smoothed(time) + next_noise();
    return;
  }
  const double truth = settings_.gain * settings_.energy_until(time).value;
  shown_ = opened_ ? std::max(shown_, truth + next_noise()) : truth;
}

void SimulatedSource::update_until(Seconds now) {
  if (settings_.longest_hold.value <= 0) {
    update_at(now);
    opened_ = true;
    return;
  }
  if (!opened_) {
    const double age = hold() * std::uniform_real_distribution<double>(0.0, 1.0)(random_);
    update_at(now - Seconds(age));
    next_update_ = last_update_ + Seconds(std::max(hold(), age));
    opened_ = true;
  }
  const double period = settings_.shortest_hold.value;
  if (settings_.longest_hold.value <= period && settings_.info.is_counter && next_update_ <= now) {
    // Only the last of the updates that were not read matters.
    next_update_ += Seconds(std::floor((now - next_update_).value / period) * period);
  }
  while (next_update_ <= now) {
    update_at(next_update_);
    next_update_ += Seconds(hold());
  }
}

ReadResult SimulatedSource::read_counter(Seconds now, bool prime) {
  ReadResult result;
  result.state = ReadState::ok;
  const double step = settings_.info.energy_step.value_or(Joules(0)).value;
  double total = 0.0;
  bool moved = false;
  if (step > 0) {
    const std::uint64_t mask =
        settings_.counter_bits >= 64 ? ~0ULL : (1ULL << settings_.counter_bits) - 1;
    const auto raw =
        static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(shown_ / step))) & mask;
    if (prime) last_raw_ = raw;
    moved = raw != last_raw_;
    steps_ += (raw - last_raw_) & mask;
    last_raw_ = raw;
    total = static_cast<double>(steps_) * step;
  } else {
    if (prime) last_shown_ = shown_;
    moved = shown_ != last_shown_;
    joules_ += shown_ - last_shown_;
    last_shown_ = shown_;
    total = joules_;
  }
  result.reading = {.time = now, .energy = Joules(total), .power = {}, .changed = moved || prime};
  return result;
}

ReadResult SimulatedSource::read(Seconds now) {
  const std::string& name = settings_.info.name;
  const auto failure = [&](ReadState state, std::string message) {
    failed_ = !first_read_;
    ReadResult result = integral_.failed(std::move(message));
    result.state = state;
    return result;
  };
  bool restarted = false;
  for (const SimulatedFault& fault : settings_.faults) {
    if (now < fault.from) continue;
    if (fault.kind == SimulatedFault::Kind::lose) {
      return failure(ReadState::lost, name + ": gone, as its script says");
    }
    if (fault.kind == SimulatedFault::Kind::fail && now < fault.to) {
      return failure(ReadState::failed, name + ": no value, as its script says");
    }
    restarted = restarted || (fault.kind == SimulatedFault::Kind::reset && !first_read_ &&
                              last_read_ < fault.from);
  }
  update_until(now);
  ReadResult result;
  if (settings_.info.is_counter) {
    // Only energy after the first good reading is known.
    result = read_counter(now, first_read_ || failed_ || restarted);
    if (failed_ || restarted) {
      result.state = ReadState::restarted;
      result.message = name + (failed_ ? ": readings are back" : ": the counter was reset");
    }
  } else {
    const double step = settings_.info.power_step.value_or(Watts(0)).value;
    const double watts = step > 0 ? std::round(shown_ / step) * step : shown_;
    result = integral_.add(now, Watts(std::max(0.0, watts)));
  }
  failed_ = false;
  first_read_ = false;
  last_read_ = now;
  return result;
}

namespace {

/// Watts about a mean that swing slowly, as a cumulative energy.
std::function<Joules(Seconds)> swinging(double mean) {
  return [mean](Seconds time) {
    constexpr double kRate = 2 * 3.14159265358979323846 / 7.0;  // once in 7 s
    return Joules(mean * (time.value - 0.2 / kRate * std::cos(kRate * time.value)));
  };
}

SimulatedSettings rapl() {
  SimulatedSettings s;
  s.info.domain = Domain::package;
  s.info.includes = "a made-up processor package of about 35 W";
  s.info.update_period = s.shortest_hold = s.longest_hold = Seconds(0.001);
  s.info.poll_period = Seconds(0.05);
  s.info.energy_step = Joules(61035e-9);
  s.counter_bits = 32;
  s.energy_until = swinging(35.0);
  return s;
}

SimulatedSettings nvml() {
  SimulatedSettings s;
  s.info.domain = Domain::gpu;
  s.info.includes = "a made-up graphics card of about 120 W";
  s.info.update_period = s.shortest_hold = s.longest_hold = Seconds(0.1);
  s.info.poll_period = Seconds(0.05);
  s.info.energy_step = Joules(0.001);
  s.energy_until = swinging(120.0);
  return s;
}

SimulatedSettings battery() {
  SimulatedSettings s;
  s.info.domain = Domain::system;
  s.info.includes = "a made-up laptop of about 30 W";
  s.info.is_counter = false;
  s.info.update_period = Seconds(4.5);
  s.shortest_hold = Seconds(3);
  s.longest_hold = Seconds(6);
  s.info.poll_period = Seconds(0.25);
  s.info.power_step = Watts(0.01);
  s.energy_until = swinging(30.0);
  return s;
}

}  // namespace

std::vector<std::string> simulated_presets() {
  return {"rapl", "nvml", "battery"};
}

SimulatedSettings simulated_preset(std::string_view preset) {
  SimulatedSettings settings;
  if (preset == "rapl") {
    settings = rapl();
  } else if (preset == "nvml") {
    settings = nvml();
  } else if (preset == "battery") {
    settings = battery();
  } else {
    throw std::invalid_argument("simulated:" + std::string(preset) +
                                ": no such simulated sensor; there are simulated:rapl, "
                                "simulated:nvml and simulated:battery");
  }
  settings.info.name = "simulated:" + std::string(preset);
  settings.info.place = "this program";
  settings.info.kind = SourceKind::simulated;
  settings.info.provenance = {Origin::simulated, "known power, no sensor"};
  return settings;
}

std::unique_ptr<SimulatedSource> make_simulated(std::string_view preset, std::uint64_t seed) {
  SimulatedSettings settings = simulated_preset(preset);
  settings.seed = seed;
  return std::make_unique<SimulatedSource>(std::move(settings));
}

}  // namespace encore::energy
