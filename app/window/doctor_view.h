#pragma once

#include "app/doctor.h"
#include "app/window/background_task.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// A sensor as the doctor panel shows it.
struct DoctorRow {
  std::string name;      ///< as PowerMonitor::choose takes it: "rapl:package-0"
  std::string includes;  ///< one sentence
  std::string place;
  std::string state;    ///< "usable", "set aside", "not usable"
  std::string reason;   ///< what is in the way, or why it is set aside; empty if usable
  std::string way_out;  ///< the exact command or setting; may be empty
  bool usable = false;  ///< may be picked
  bool in_total = false;
  std::optional<double> watts;     ///< mean while it was observed
  std::optional<double> period_s;  ///< between changes of its value as seen
  bool period_is_bound = false;    ///< it may well change more often
  double documented_period_s = 0.0;
  std::vector<std::string> notes;
};

/// What the doctor found.
struct DoctorFindings {
  std::string host;  ///< what of the machine matters: "virtual machine, container"
  std::vector<DoctorRow> sensors;
  std::optional<double> total_watts;
  double observed_s = 0.0;
  double sampling_share = 0.0;  ///< of one core
  bool any_usable = false;
  /// If nothing is usable: why, and the ways out.
  std::string advice;
  std::string text;  ///< as `encore doctor` prints it, for copying
};

/// A report as the panel shows it.
DoctorFindings findings_of(const DoctorReport& report);

struct DoctorRequest {
  std::string sensor_root = "/";
  energy::Seconds length{2.0};
  bool all = false;  ///< as Observation::all
};

/// Looks for sensors and observes them, off the UI thread; may be cancelled:
///   task.start([request](TaskControl& c) { return examine_for_window(request, c); });
using DoctorTask = BackgroundTask<DoctorFindings>;
DoctorFindings examine_for_window(const DoctorRequest& request, TaskControl& control);

}  // namespace encore::app
