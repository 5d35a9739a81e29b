#include "energy/sources/model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace encore::energy {

namespace {

/// Rounding of differences of busy times is not work.
constexpr double kNoTime = 1e-9;
/// A gap lasts until nothing unknown ran for so long: one gap, not one a frame.
constexpr Seconds kQuiet(1.0);

void check_power(std::string_view name, Watts power) {
  if (power.value >= 0.0 && power.value <= kLargestModelPower) return;
  throw PowerModelError(fmt::format("power model: {} must be from 0 to {} W, not {}", name,
                                    kLargestModelPower, power.value));
}

/// The names of what was busy without a constant.
std::vector<std::string> unknown_loads(const PowerModel& model, const BusyTimes& busy) {
  std::vector<std::string> names;
  for (const Phase phase : kPhases) {
    if (!model.delta[phase] && busy.phases[phase].value > kNoTime) {
      names.emplace_back(to_string(phase));
    }
  }
  if (!model.gpu && busy.gpu.value > kNoTime) names.emplace_back("gpu");
  return names;
}

BusyTimes between(const BusyTimes& from, const BusyTimes& to) {
  BusyTimes difference;
  for (const Phase phase : kPhases) {
    difference.phases[phase] = to.phases[phase] - from.phases[phase];
  }
  difference.gpu = to.gpu - from.gpu;
  return difference;
}

class ModelSource final : public PowerSource {
 public:
  ModelSource(const PowerModel& model, BusyFunction busy)
      : info_(model_source_info(model)), model_(model), busy_(std::move(busy)) {}

  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  ReadResult read(Seconds now) override {
    const BusyTimes busy = busy_(now);
    const BusyTimes step = opened_ ? between(last_busy_, busy) : BusyTimes{};
    const Seconds passed = opened_ ? now - last_time_ : Seconds(0);
    opened_ = true;
    last_time_ = now;
    last_busy_ = busy;

    const auto energy = modelled_energy(model_, passed, step);
    if (!energy) return fail(now, step);
    if (failed_at_ && now - *failed_at_ < kQuiet) return fail(*failed_at_, {});
    ReadResult result;
    result.state = ReadState::ok;
    if (failed_at_) {
      failed_at_.reset();
      result.state = ReadState::restarted;
      result.message = fmt::format("{}: back, as {} rests", info_.name, unknown_);
    } else {
      // Busy times may seem to fall by a rounding.
      energy_ += Joules(std::max(0.0, energy->value));
    }
    result.reading = {now, energy_, std::nullopt, true};
    return result;
  }

 private:
  ReadResult fail(Seconds since, const BusyTimes& step) {
    failed_at_ = since;
    const std::vector<std::string> names = unknown_loads(model_, step);
    if (!names.empty()) {
      unknown_ = fmt::format("{}", fmt::join(names, ", "));
      message_ = fmt::format(
          "{}: no power is known for {}, which runs: energy is missing meanwhile; give {}=<watts "
          "above idle>",
          info_.name, unknown_, names.front());
    }
    ReadResult result;
    result.message = message_;
    return result;
  }

  SourceInfo info_;
  PowerModel model_;
  BusyFunction busy_;
  bool opened_ = false;
  std::optional<Seconds> failed_at_;
  std::string unknown_;  ///< what ran without a constant, last
  std::string message_;
  Seconds last_time_;
  BusyTimes last_busy_;
  Joules energy_;
};

}  // namespace

void check(const PowerModel& model) {
  check_power("idle", model.idle);
  bool any = model.gpu.has_value();
  for (const Phase phase : kPhases) {
    if (!model.delta[phase]) continue;
    check_power(to_string(phase), *model.delta[phase]);
    any = true;
  }
  if (model.gpu) check_power("gpu", *model.gpu);
  if (!any) {
    throw PowerModelError(
        "power model: nothing is given above idle; add build=<watts>, render=<watts> or "
        "busy=<watts>");
  }
  if (model.uncertainty && !(*model.uncertainty >= 0.0 && *model.uncertainty <= 1.0)) {
    throw PowerModelError(fmt::format(
        "power model: the relative uncertainty must be from 0 to 1, not {}", *model.uncertainty));
  }
}

std::string describe(const PowerModel& model) {
  std::vector<std::string> parts;
  for (const Phase phase : kPhases) {
    if (!model.delta[phase]) continue;
    parts.push_back(fmt::format("{} {:.6g} W", to_string(phase), model.delta[phase]->value));
  }
  if (model.gpu) parts.push_back(fmt::format("gpu {:.6g} W", model.gpu->value));
  return fmt::format("idle {:.6g} W; above it: {}", model.idle.value, fmt::join(parts, ", "));
}

std::optional<Joules> modelled_energy(const PowerModel& model, Seconds elapsed,
                                      const BusyTimes& busy) {
  if (!unknown_loads(model, busy).empty()) return std::nullopt;
  Joules energy = model.idle * elapsed;
  for (const Phase phase : kPhases) {
    if (model.delta[phase]) energy += *model.delta[phase] * busy.phases[phase];
  }
  if (model.gpu) energy += *model.gpu * busy.gpu;
  return energy;
}

SourceInfo model_source_info(const PowerModel& model) {
  SourceInfo info;
  info.name = "model:constants";
  info.kind = SourceKind::model;
  info.domain = Domain::system;
  info.includes =
      "Constants times busy time: idle power of the whole machine and what each phase adds; no "
      "sensor, and blind to all else that the machine does.";
  info.place = model.detail;
  const std::string accuracy =
      model.uncertainty ? fmt::format("standard uncertainty {:.3g} %", 100.0 * *model.uncertainty)
                        : fmt::format("uncertainty not given, taken as {:.3g} %",
                                      100.0 * kUnknownModelUncertainty);
  info.provenance = {Origin::modelled,
                     fmt::format("{} ({}; {})", describe(model), model.detail, accuracy)};
  info.is_counter = true;
  info.gain_uncertainty = model.uncertainty.value_or(kUnknownModelUncertainty);
  return info;
}

std::unique_ptr<PowerSource> make_model_source(const PowerModel& model, BusyFunction busy) {
  check(model);
  return std::make_unique<ModelSource>(model, std::move(busy));
}

}  // namespace encore::energy
