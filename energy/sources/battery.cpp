#include "energy/sources/battery.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

namespace encore::energy {

namespace {

constexpr std::string_view kFolder = "/sys/class/power_supply";
/// The driver asks the pack once a second; reading a little more than twice as often neither
/// misses an update nor beats with it.
constexpr Seconds kPoll{0.3};
/// Gauges renew their number every few seconds.
constexpr Seconds kUpdate{4.0};
constexpr Seconds kLongestGap{30.0};
/// A slope is believed for this many times the interval that it was taken from.
constexpr double kSlopeHolds = 3.0;

std::string plugged_in_message(const std::string& charger) {
  return fmt::format(
      "{} was plugged in: on mains the battery does not see what the machine uses; "
      "unplug it and measure again",
      charger);
}

/// Whether there is any way to a power; a rate that is unknown right now may yet come.
std::optional<Obstacle> obstacle_of_pack(const SupplySnapshot& pack) {
  if (pack.rate() || pack.stored()) return std::nullopt;
  const bool may_come = pack.micro("power_now") == 0.0 || pack.micro("current_now") == 0.0;
  if (may_come) return std::nullopt;
  return Obstacle{fmt::format("{}/{}: the gauge knows neither its discharge rate nor what is left",
                              kFolder, pack.name),
                  "if the charger was just unplugged, wait some seconds and look again"};
}

std::optional<Obstacle> obstacle_of(const Supplies& supplies) {
  std::string states;
  bool discharging = false;
  for (const SupplySnapshot& pack : supplies.packs) {
    states += fmt::format("{}{} is {}", states.empty() ? "" : ", ", pack.name, pack.text("status"));
    discharging = discharging || pack.discharging();
  }
  const std::string fix = "unplug the charger, or use a source that works on mains (RAPL, NVML)";
  if (supplies.plugged) {
    return Obstacle{fmt::format("on mains ({} is online, {}): the battery does not see what the "
                                "machine uses",
                                *supplies.plugged, states),
                    fix};
  }
  if (!discharging) {
    return Obstacle{fmt::format("{}: {}, none is discharging", kFolder, states), fix};
  }
  for (const SupplySnapshot& pack : supplies.packs) {
    auto obstacle = pack.discharging() ? obstacle_of_pack(pack) : std::nullopt;
    if (obstacle) return obstacle;
  }
  return std::nullopt;
}

}  // namespace

bool BatteryCheck::agrees(double gain) const {
  const double allowed = 3.0 * uncertainty.value + gain * integral.value;
  return std::abs(difference().value) <= allowed;
}

PackPower::Value PackPower::next(Seconds now, const SupplySnapshot& pack) {
  Value value;
  // The slope is followed all the time, so that it is there when the gauge has nothing to say.
  const auto charge = pack.charge_now();
  const auto stored = pack.stored();
  std::optional<Watts> by_slope;
  if (charge) {
    by_slope = slope(now, *charge);
    const auto voltage = pack.micro("voltage_now");
    if (by_slope) by_slope = voltage ? std::optional(*by_slope * *voltage) : std::nullopt;
  } else if (stored) {
    by_slope = slope(now, stored->value);
  }
  value.power = pack.rate();
  if (!value.power) value.power = by_slope;
  if (!value.power) {
    value.why = fmt::format(
        "{}/{}: the gauge gives no discharge rate and {}; it may come within some seconds", kFolder,
        pack.name,
        charge || stored ? "what it says is left has not fallen twice yet"
                         : "does not say what is left either");
  }
  return value;
}

std::optional<Watts> PackPower::slope(Seconds now, double left) {
  if (last_left_ && left > *last_left_) interrupt();
  if (last_left_ && left < *last_left_) {
    // The first fall has no beginning: nobody saw when the value before appeared.
    if (change_ && now > change_->time) {
      interval_ = now - change_->time;
      rate_ = (change_->left - left) / interval_.value;
    }
    change_ = Change{now, left};
  }
  last_left_ = left;
  if (!rate_ || now - change_->time > interval_ * kSlopeHolds) return std::nullopt;
  return Watts(*rate_);
}

void PackPower::interrupt() {
  last_left_.reset();
  change_.reset();
  rate_.reset();
}

BatterySource::BatterySource(SourceInfo info, std::vector<std::string> packs, SensorFiles files)
    : info_(std::move(info)),
      packs_(std::move(packs)),
      files_(std::move(files)),
      integral_(kLongestGap) {}

std::optional<std::string> BatterySource::plugged() {
  // Chargers may appear while running (USB-C); a supply's type is asked once, as asking a wireless
  // device costs radio.
  for (const std::string& name : files_.list(kFolder)) {
    if (not_mains_.contains(name)) continue;
    if (!mains_.contains(name)) {
      const bool mains = is_mains(files_, name);
      (mains ? mains_ : not_mains_).insert(name);
      if (!mains) continue;
    }
    if (is_online(files_, name)) return name;
  }
  return std::nullopt;
}

void BatterySource::follow(const SupplySnapshot& pack) {
  const auto stored = pack.stored();
  Drawn& drawn = drawn_[pack.name];
  if (stored && drawn.last && *stored < *drawn.last) {
    const Joules fall = *drawn.last - *stored;
    drawn.step = drawn.step ? std::min(*drawn.step, fall) : fall;
    drawn.sum += fall;
    ++drawn.falls;
  } else if (stored && drawn.last && *stored > *drawn.last) {
    drawn.sum += *drawn.last - *stored;
  }
  drawn.last = stored;
}

BatterySource::Look BatterySource::look(Seconds now) {
  Look look;
  for (const std::string& name : packs_) {
    SupplySnapshot pack = read_supply(files_, name);
    const std::string place = fmt::format("{}/{}", kFolder, name);
    const bool gone = pack.error == ENOENT || pack.error == ENODEV;
    if (gone || (pack.error == 0 && !pack.is_system_battery())) {
      look.taken_out = place + ": the pack was taken out; measure again";
      return look;
    }
    if (pack.error != 0) {
      look.missing = files_.describe(place + "/uevent", pack.error);
      continue;
    }
    look.charging = look.charging || pack.text("status") == "Charging";
    look.states +=
        fmt::format("{}{} is {}", look.states.empty() ? "" : ", ", name, pack.text("status"));
    if (!pack.discharging()) {
      powers_[name].interrupt();
      continue;
    }
    const PackPower::Value value = powers_[name].next(now, pack);
    if (!value.power) look.missing = value.why;
    look.sum += value.power.value_or(Watts(0));
    look.discharging.push_back(std::move(pack));
  }
  return look;
}

ReadResult BatterySource::read(Seconds now) {
  if (const auto charger = plugged()) return integral_.lost(plugged_in_message(*charger));
  const Look seen = look(now);
  if (!seen.taken_out.empty()) return integral_.lost(seen.taken_out);
  // A sum without one of its packs would be too low.
  if (!seen.missing.empty()) return integral_.failed(seen.missing);
  if (seen.discharging.empty() && seen.charging) {
    return integral_.lost(plugged_in_message("a charger (" + seen.states + ")"));
  }
  if (seen.discharging.empty()) {
    return integral_.failed(fmt::format("{}: {}; none is discharging", kFolder, seen.states));
  }
  const Joules before = integral_.energy();
  ReadResult result = integral_.add(now, seen.sum);
  const std::scoped_lock lock(mutex_);
  if (result.state == ReadState::restarted || stretches_ == 0) {
    for (auto& [name, drawn] : drawn_) drawn.last.reset();
    ++stretches_;
  }
  integrated_ += integral_.energy() - before;
  for (const SupplySnapshot& pack : seen.discharging) follow(pack);
  return result;
}

std::optional<BatteryCheck> BatterySource::check() const {
  const std::scoped_lock lock(mutex_);
  BatteryCheck check;
  check.integral = integrated_;
  double squares = 0.0;
  int falls = 0;
  for (const auto& [name, drawn] : drawn_) {
    check.drawn += drawn.sum;
    falls += drawn.falls;
    if (!drawn.step) continue;
    check.step = std::max(check.step, *drawn.step);
    squares += drawn.step->value * drawn.step->value;
  }
  if (falls < 2) return std::nullopt;
  check.uncertainty = Joules(std::sqrt(squares * stretches_ / 6.0));
  return check;
}

std::vector<Finding> find_batteries(const SensorFiles& files) {
  const Supplies supplies = read_supplies(files);
  Finding finding;
  SourceInfo& info = finding.info;
  info.kind = SourceKind::battery;
  info.domain = Domain::system;
  info.is_counter = false;
  info.update_period = kUpdate;
  info.poll_period = kPoll;
  if (supplies.packs.empty()) {
    info.name = "battery";
    info.place = kFolder;
    std::string why = fmt::format("no battery of this machine below {}", kFolder);
    for (const std::string& other : supplies.others) why += "; " + other;
    info.provenance.detail = why;
    finding.obstacle = Obstacle{why, ""};
    return {finding};
  }

  std::vector<std::string> names;
  for (const SupplySnapshot& pack : supplies.packs) names.push_back(pack.name);
  const std::string joined = fmt::format("{}", fmt::join(names, "+"));
  info.name = "battery:" + joined;
  info.place = fmt::format("{}/{}", kFolder, joined);
  info.includes =
      "everything that runs from the battery, screen and losses of the voltage converters "
      "included; "
      "not what the battery itself turns into heat";
  info.provenance = {Origin::measured, "fuel gauge of " + joined};
  finding.obstacle = obstacle_of(supplies);
  if (finding.obstacle) {
    info.provenance = {Origin::unavailable, finding.obstacle->reason};
    return {finding};
  }
  finding.open = [info, names, files]() -> std::unique_ptr<PowerSource> {
    for (const std::string& name : names) {
      const SupplySnapshot pack = read_supply(files, name);
      if (pack.error == 0 && pack.is_system_battery()) continue;
      throw SensorError(
          fmt::format("{}/{}: the pack is gone; look for sources again", kFolder, name));
    }
    return std::make_unique<BatterySource>(info, names, files);
  };
  return {finding};
}

std::vector<Finding> find_batteries(const SensorRoot& root) {
  return find_batteries(SensorFiles(root));
}

}  // namespace encore::energy
