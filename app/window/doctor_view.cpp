#include "app/window/doctor_view.h"

#include "energy/sources/discover.h"

#include <algorithm>
#include <chrono>

namespace encore::app {

namespace {

std::string host_text(const energy::Host& host) {
  std::string text = "whether the machine is virtual is not known";
  if (host.virtual_machine) {
    text = *host.virtual_machine
               ? "virtual machine: what sensors show may be another machine's, too"
               : "no hypervisor";
  }
  if (host.container) text += "; inside a container";
  if (host.sgx) text += "; the processor blurs its energy counters (SGX)";
  return text;
}

DoctorRow row_of(const SensorReport& sensor) {
  DoctorRow row;
  row.name = sensor.info.name;
  row.includes = sensor.info.includes;
  row.place = sensor.info.place;
  row.usable = !sensor.obstacle;
  row.state = sensor.set_aside.empty() ? "usable" : "set aside";
  row.reason = sensor.set_aside;
  if (sensor.obstacle) {
    row.state = "not usable";
    row.reason = sensor.obstacle->reason;
    row.way_out = sensor.obstacle->fix;
  }
  if (sensor.mean) row.watts = sensor.mean->value;
  if (sensor.period) row.period_s = sensor.period->median.value;
  row.period_is_bound = sensor.period_is_bound;
  row.documented_period_s = sensor.info.update_period.value;
  row.notes = sensor.notes;
  return row;
}

/// A clock that tells how far an observation has got.
class ProgressClock final : public energy::Clock {
 public:
  ProgressClock(TaskControl& control, energy::Seconds length)
      : control_(control), start_(clock_.now()), length_(length) {}
  [[nodiscard]] energy::Seconds now() const override {
    const energy::Seconds now = clock_.now();
    constexpr double kAlmost = 0.99;  // what comes behind it is quick
    const double share = (now - start_) / length_;
    control_.progress = std::clamp(share, control_.progress.load(), kAlmost);
    return now;
  }
  void sleep_until(energy::Seconds time, const std::atomic<bool>& stop) const override {
    clock_.sleep_until(time, stop);
  }

 private:
  energy::SteadyClock clock_;
  TaskControl& control_;
  energy::Seconds start_;
  energy::Seconds length_;
};

}  // namespace

DoctorFindings findings_of(const DoctorReport& report) {
  DoctorFindings findings;
  findings.host = host_text(report.host);
  for (const SensorReport& sensor : report.sensors) findings.sensors.push_back(row_of(sensor));
  for (const std::size_t i : report.total) findings.sensors[i].in_total = true;
  if (report.total_mean) findings.total_watts = report.total_mean->value;
  findings.observed_s = report.observed.value;
  findings.sampling_share = report.cost.share();
  findings.any_usable = report.any_usable();
  findings.text = doctor_text(report);
  if (findings.any_usable) return findings;
  findings.advice =
      "no power sensor can be read, so times are measured but no energy; do what stands beside a "
      "sensor, or enter idle and busy watts for modelled energy";
  return findings;
}

DoctorFindings examine_for_window(const DoctorRequest& request, TaskControl& control) {
  const energy::SensorRoot root(request.sensor_root);
  const ProgressClock clock(control, request.length);
  Observation observation;
  observation.length = request.length;
  observation.all = request.all;
  return findings_of(
      examine(energy::read_host(root), energy::discover(root), observation, clock, control.stop));
}

}  // namespace encore::app
