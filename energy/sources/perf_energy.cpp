#include "energy/sources/perf_energy.h"

#include "energy/sources/energy_counter.h"
#include "energy/sources/host.h"
#include "energy/sources/perf_pmu.h"

#include <fmt/format.h>
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace encore::energy {

namespace {

std::string error_text(int error) {
  return std::strerror(error);
}

/// Closes the counter's file when it goes out of scope.
class PerfFile {
 public:
  PerfFile(const PerfCalls& calls, const PerfEvent& event)
      : calls_(calls), file_(calls.open(event.type, event.config, event.cpu)) {}
  ~PerfFile() {
    if (file_ >= 0) calls_.close(file_);
  }
  PerfFile(const PerfFile&) = delete;
  PerfFile& operator=(const PerfFile&) = delete;

  [[nodiscard]] int error() const { return file_ < 0 ? -file_ : 0; }
  [[nodiscard]] int read(std::uint64_t& value) const { return calls_.read(file_, value); }

 private:
  PerfCalls calls_;
  int file_;
};

Obstacle refusal(const SensorRoot& root, const PerfEvent& event, int error) {
  Obstacle obstacle{fmt::format("perf_event_open for {} on processor {}: {}", event.place,
                                event.cpu, error_text(error)),
                    {}};
  if (error != EACCES && error != EPERM) return obstacle;
  const auto level = root.read("/proc/sys/kernel/perf_event_paranoid").text;
  if (level) obstacle.reason += fmt::format(" (kernel.perf_event_paranoid is {})", *level);
  if (read_host(root).container) {
    obstacle.fix =
        "start the container with --cap-add PERFMON and a seccomp profile that allows "
        "perf_event_open, or measure outside of it";
    return obstacle;
  }
  obstacle.fix =
      "sudo sysctl kernel.perf_event_paranoid=0 (until the next boot; to keep it: echo "
      "'kernel.perf_event_paranoid = 0' | sudo tee /etc/sysctl.d/70-energy.conf), or for this "
      "program alone: sudo setcap cap_perfmon=ep \"$(command -v encore)\"";
  return obstacle;
}

class PerfSource final : public PowerSource {
 public:
  PerfSource(SourceInfo info, const PerfCalls& calls, const PerfEvent& event)
      : info_(std::move(info)),
        file_(calls, event),
        // The kernel widens the counter to 64 bits, so that a fall can only be a reset.
        counter_({Joules(event.scale), std::nullopt,
                  Watts(event.domain == Domain::platform ? 4000.0 : 1000.0), info_.update_period,
                  info_.place}) {
    if (file_.error() != 0) {
      throw SensorError(fmt::format("{}: {}; run encore doctor for the way out", info_.place,
                                    error_text(file_.error())));
    }
  }

  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  ReadResult read(Seconds now) override {
    std::uint64_t value = 0;
    const int error = -file_.read(value);
    if (error == 0) return counter_.update(now, value);
    if (error == ENODATA || error == ENODEV) {
      return counter_.fail(ReadState::lost, error_text(error) +
                                                ": the counter has ended; has the processor been "
                                                "taken offline?");
    }
    return counter_.fail(ReadState::failed, error_text(error));
  }

 private:
  SourceInfo info_;
  PerfFile file_;
  EnergyCounter counter_;
};

Finding finding_of(const SensorRoot& root, const PerfCalls& calls, const PerfEvent& event) {
  Finding finding;
  finding.info = describe_perf_event(event);
  if (!event.problem.empty()) {
    finding.obstacle = Obstacle{event.problem, {}};
  } else if (!calls.open) {
    finding.obstacle = Obstacle{
        fmt::format("{}: perf counters can be read on the machine itself only, not from a copy of "
                    "its tree",
                    event.place),
        "leave --sysfs-root out"};
  } else if (const PerfFile trial(calls, event); trial.error() != 0) {
    finding.obstacle = refusal(root, event, trial.error());
  }
  if (finding.obstacle) {
    finding.info.provenance = {Origin::unavailable, finding.obstacle->reason};
    return finding;
  }
  finding.open = [info = finding.info, calls, event]() -> std::unique_ptr<PowerSource> {
    return std::make_unique<PerfSource>(info, calls, event);
  };
  return finding;
}

Finding nothing_found(const SensorRoot& root) {
  const Host host = read_host(root);
  Finding finding;
  finding.info.name = "perf";
  finding.info.kind = SourceKind::perf_energy;
  finding.info.domain = Domain::package;
  finding.info.place = kPowerPmu;
  std::error_code ignored;
  const bool there = std::filesystem::exists(root.resolve(kPowerPmu), ignored);
  const std::string reason =
      fmt::format("no perf energy counters: {} {}{}", kPowerPmu,
                  there ? "lists no energy event" : "is not there", why_no_counters(host));
  finding.info.provenance = {Origin::unavailable, reason};
  finding.obstacle = Obstacle{reason, way_to_counters(host, "rapl")};
  return finding;
}

}  // namespace

PerfCalls system_perf_calls() {
  PerfCalls calls;
  calls.open = [](std::uint32_t type, std::uint64_t config, int cpu) {
    perf_event_attr wanted{};
    wanted.size = sizeof wanted;
    wanted.type = type;
    wanted.config = config;
    const long file = ::syscall(SYS_perf_event_open, &wanted, -1, cpu, -1, PERF_FLAG_FD_CLOEXEC);
    return file < 0 ? -errno : static_cast<int>(file);
  };
  calls.read = [](int file, std::uint64_t& value) {
    ssize_t got = 0;
    do {
      got = ::read(file, &value, sizeof value);
    } while (got < 0 && errno == EINTR);
    if (got < 0) return -errno;
    return got == static_cast<ssize_t>(sizeof value) ? 0 : -ENODATA;
  };
  calls.close = [](int file) { ::close(file); };
  return calls;
}

std::vector<Finding> find_perf_energy(const SensorRoot& root, const PerfCalls& calls) {
  std::vector<Finding> findings;
  for (const PerfEvent& event : list_perf_events(root)) {
    findings.push_back(finding_of(root, calls, event));
  }
  if (findings.empty()) return {nothing_found(root)};
  for (Finding& part : findings) {
    for (const Finding& whole : findings) {
      if (part.obstacle || whole.obstacle || whole.info.domain != Domain::package) continue;
      if (part.info.unit != whole.info.unit) continue;
      if (holds(whole.info.domain, part.info.domain)) part.set_aside = "part of " + whole.info.name;
    }
  }
  return findings;
}

std::vector<Finding> find_perf_energy(const SensorRoot& root) {
  return find_perf_energy(root, root.is_real() ? system_perf_calls() : PerfCalls{});
}

void set_repeated_aside(std::vector<Finding>& perf, const std::vector<Finding>& powercap) {
  for (Finding& finding : perf) {
    if (finding.obstacle || finding.info.kind != SourceKind::perf_energy) continue;
    for (const Finding& other : powercap) {
      const bool same = other.info.kind == SourceKind::rapl &&
                        other.info.domain == finding.info.domain &&
                        other.info.unit == finding.info.unit;
      if (other.obstacle || !same) continue;
      finding.set_aside = "the same counter as " + other.info.name;
      break;
    }
  }
}

}  // namespace encore::energy
