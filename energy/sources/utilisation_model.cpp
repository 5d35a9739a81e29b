#include "energy/sources/utilisation_model.h"

#include "energy/sources/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>

namespace encore::energy {

namespace {

constexpr std::string_view kProcStat = "/proc/stat";
constexpr std::string_view kCgroupStat = "/sys/fs/cgroup/cpu.stat";
constexpr std::string_view kCgroupMax = "/sys/fs/cgroup/cpu.max";

/// The number behind "usage_usec " in a cgroup's cpu.stat.
std::optional<std::uint64_t> parse_usage(std::string_view text) {
  constexpr std::string_view kKey = "usage_usec ";
  std::size_t at = text.starts_with(kKey) ? 0 : text.find("\nusage_usec ");
  if (at == std::string_view::npos) return std::nullopt;
  if (at > 0) ++at;
  const std::string_view rest = text.substr(at + kKey.size());
  return parse_unsigned(rest.substr(0, rest.find('\n')));
}

/// Processors that "quota period" of cpu.max allows; nothing for "max".
std::optional<double> parse_quota(std::string_view text) {
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return std::nullopt;
  const auto quota = parse_unsigned(text.substr(0, space));
  const auto period = parse_unsigned(text.substr(space + 1));
  if (!quota || !period || *quota == 0 || *period == 0) return std::nullopt;
  return static_cast<double>(*quota) / static_cast<double>(*period);
}

/// Load since the reading before, and how the next one is to be compared.
class LoadReader {
 public:
  LoadReader(SensorRoot root, LoadScope scope) : root_(std::move(root)), scope_(scope) {}

  struct Load {
    std::optional<double> busy;  ///< share since the last answer; empty: too little time passed
    std::string error;           ///< why there is nothing at all
    bool restarted = false;      ///< no share, since the counters began anew
  };
  Load since_last(Seconds now) { return scope_ == LoadScope::machine ? machine() : container(now); }

 private:
  Load machine() {
    const auto ticks = read_ticks();
    if (!ticks) return {std::nullopt, last_error_, false};
    Load load;
    if (last_ticks_) {
      const auto u = utilisation_between(*last_ticks_, *ticks);
      const bool same = ticks->busy == last_ticks_->busy &&
                        ticks->waiting == last_ticks_->waiting &&
                        ticks->stolen == last_ticks_->stolen;
      if (u) load.busy = u->busy;
      load.restarted = !u && !same;
    }
    last_ticks_ = ticks;
    return load;
  }

  Load container(Seconds now) {
    const auto ticks = read_ticks();
    if (!ticks) return {std::nullopt, last_error_, false};
    const FileText text = root_.read(kCgroupStat);
    const auto usage = text.text ? parse_usage(*text.text) : std::nullopt;
    if (!usage) {
      return {std::nullopt,
              fmt::format("{}: {}", kCgroupStat,
                          text.text ? "holds no usage_usec" : std::strerror(text.error)),
              false};
    }
    double processors = ticks->processors;
    if (const FileText max = root_.read(kCgroupMax); max.text) {
      processors = std::min(processors, parse_quota(*max.text).value_or(processors));
    }
    Load load;
    if (last_usage_ && now > last_time_) {
      load.restarted = *usage < *last_usage_;
      const double seconds = static_cast<double>(*usage - *last_usage_) * 1e-6;
      if (!load.restarted) {
        load.busy = std::min(1.0, seconds / ((now - last_time_).value * processors));
      }
    }
    last_usage_ = usage;
    last_time_ = now;
    return load;
  }

  std::optional<ProcessorTicks> read_ticks() {
    const FileText text = root_.read(kProcStat);
    auto ticks = text.text ? parse_proc_stat(*text.text) : std::nullopt;
    if (!ticks) {
      last_error_ = fmt::format("{}: {}", kProcStat,
                                text.text ? "holds no line 'cpu'" : std::strerror(text.error));
    }
    return ticks;
  }

  SensorRoot root_;
  LoadScope scope_;
  std::optional<ProcessorTicks> last_ticks_;
  std::optional<std::uint64_t> last_usage_;
  Seconds last_time_;
  std::string last_error_;
};

class UtilisationSource final : public PowerSource {
 public:
  UtilisationSource(const UtilisationModel& model, const SensorRoot& root, LoadScope scope)
      : info_(utilisation_source_info(model, scope)), model_(model), load_(root, scope) {}

  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  ReadResult read(Seconds now) override {
    const LoadReader::Load load = load_.since_last(now);
    ReadResult result;
    if (!load.error.empty()) {
      result.message = fmt::format("{}: {}; no estimate", info_.name, load.error);
      failed_ = true;
      return result;
    }
    result.state = ReadState::ok;
    result.reading.changed = true;
    if (!last_time_ || failed_ || load.restarted) {
      if (last_time_) {
        result.state = ReadState::restarted;
        result.message = fmt::format("{}: the load of the time before is unknown", info_.name);
      }
      last_time_ = now;
    } else if (load.busy) {
      const Watts power = model_.idle + (model_.max - model_.idle) * *load.busy;
      energy_ += power * (now - *last_time_);
      result.reading.power = power;
      last_time_ = now;
    } else {
      // No tick has passed: the counter stands still until one does.
      result.reading.changed = false;
    }
    failed_ = false;
    result.reading.time = now;
    result.reading.energy = energy_;
    return result;
  }

 private:
  SourceInfo info_;
  UtilisationModel model_;
  LoadReader load_;
  std::optional<Seconds> last_time_;
  bool failed_ = false;
  Joules energy_;
};

}  // namespace

void check(const UtilisationModel& model) {
  if (!(model.idle.value >= 0.0 && model.max.value <= kLargestModelPower &&
        model.idle < model.max)) {
    throw PowerModelError(
        fmt::format("power model: idle must be below max, both from 0 to {} W; not idle={}, max={}",
                    kLargestModelPower, model.idle.value, model.max.value));
  }
}

std::optional<ProcessorTicks> parse_proc_stat(std::string_view text) {
  ProcessorTicks ticks;
  bool found = false;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("cpu")) continue;
    if (line.size() > 3 && line[3] != ' ') {
      ++ticks.processors;
      continue;
    }
    std::istringstream fields(line.substr(3));
    // user nice system idle iowait irq softirq steal; old kernels stop earlier. Guests are in user.
    std::array<std::uint64_t, 8> n{};
    std::size_t count = 0;
    while (count < n.size() && fields >> n.at(count)) ++count;
    if (count < 4) return std::nullopt;
    ticks.busy = n[0] + n[1] + n[2] + n[5] + n[6];
    ticks.waiting = n[3] + n[4];
    ticks.stolen = n[7];
    found = true;
  }
  if (!found) return std::nullopt;
  ticks.processors = std::max(ticks.processors, 1U);
  return ticks;
}

std::optional<Utilisation> utilisation_between(const ProcessorTicks& from,
                                               const ProcessorTicks& to) {
  if (to.busy < from.busy || to.stolen < from.stolen) return std::nullopt;
  const auto busy = static_cast<double>(to.busy - from.busy);
  const auto stolen = static_cast<double>(to.stolen - from.stolen);
  // The kernel's idle and iowait may fall by a few ticks when a processor wakes.
  const double waiting =
      to.waiting > from.waiting ? static_cast<double>(to.waiting - from.waiting) : 0.0;
  const double all = busy + stolen + waiting;
  if (all <= 0.0) return std::nullopt;
  return Utilisation{busy / all, stolen / all};
}

LoadScope load_scope(const SensorRoot& root) {
  const bool inside = root.read("/.dockerenv").text || root.read("/run/.containerenv").text;
  const FileText stat = root.read(kCgroupStat);
  return inside && stat.text && parse_usage(*stat.text) ? LoadScope::container : LoadScope::machine;
}

SourceInfo utilisation_source_info(const UtilisationModel& model, LoadScope scope) {
  const bool container = scope == LoadScope::container;
  SourceInfo info;
  info.name = "model:utilisation";
  info.kind = SourceKind::model;
  info.domain = Domain::system;
  info.includes =
      container ? "Estimate from the container's processor load; blind to GPU, memory and disks, "
                  "and to everything outside the container."
                : "Estimate from the machine's processor load; blind to GPU, memory and disks.";
  info.place = container ? kCgroupStat : kProcStat;
  info.provenance = {
      Origin::modelled,
      fmt::format("ESTIMATED from utilisation ({}): idle {:.6g} W, max {:.6g} W; {}; {}",
                  info.place, model.idle.value, model.max.value, model.detail,
                  model.uncertainty == UtilisationModel{}.uncertainty
                      ? std::string("±30-50 %")
                      : fmt::format("±{:.3g} %", 100.0 * model.uncertainty))};
  info.is_counter = true;
  // Ticks are 10 ms a processor: shorter steps are mostly rounding.
  info.update_period = Seconds(0.01);
  info.poll_period = Seconds(0.5);
  info.gain_uncertainty = model.uncertainty;
  return info;
}

std::unique_ptr<PowerSource> make_utilisation_source(const UtilisationModel& model,
                                                     const SensorRoot& root, LoadScope scope) {
  check(model);
  return std::make_unique<UtilisationSource>(model, root, scope);
}

}  // namespace encore::energy
