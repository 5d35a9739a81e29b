#pragma once

#include "app/doctor_opengl.h"
#include "energy/sampling/sampler.h"
#include "energy/sampling/trace.h"
#include "energy/sources/discovery.h"
#include "energy/sources/host.h"

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What the doctor found out about one sensor.
struct SensorReport {
  energy::SourceInfo info;
  std::optional<energy::Obstacle> obstacle;  ///< empty: usable
  std::string set_aside;                     ///< as in Finding
  /// Times between changes of the sensor's value as seen; nothing if too few were seen.
  std::optional<energy::TraceView::Period> period;
  /// The sensor was read about as seldom as it was seen to change: it may well change more often.
  bool period_is_bound = false;
  std::size_t changes = 0;            ///< of its value while it was observed
  std::optional<energy::Watts> mean;  ///< while it was observed; never a 0 for "not seen"
  std::vector<std::string> notes;     ///< why there is no period or no mean, and what went wrong
};

/// What `encore doctor` tells.
struct DoctorReport {
  energy::Host host;
  std::vector<SensorReport> sensors;
  std::vector<std::size_t> total;           ///< the sensors that would be added
  std::optional<energy::Watts> total_mean;  ///< only if each of them has a mean
  energy::Seconds observed;
  energy::SamplerCost cost;
  std::size_t readings = 0;
  std::optional<OpenGlReport> opengl;  ///< empty: not looked for

  [[nodiscard]] bool any_usable() const;
};

struct Observation {
  energy::Seconds length{2.0};
  /// Read sensors, too, that are set aside because reading them has a price (it wakes a GPU).
  bool all = false;
  std::function<energy::Seconds()> boot = energy::boot_time;  ///< as for Sampler
};

/// Opens what can be used, reads it for as long as asked, or until `stop`, and judges it. Sensors
/// that turn out not to answer are not usable, whatever was found before.
DoctorReport examine(const energy::Host& host, const std::vector<energy::Finding>& findings,
                     const Observation& observation, const energy::Clock& clock,
                     const std::atomic<bool>& stop);

/// The mean over the longest stretch without a gap. A gauge needs two points; a counter two changes
/// that lie two update periods apart at least, and the mean is taken from the first to the last.
std::optional<energy::Watts> mean_power(const energy::TraceView& trace,
                                        const energy::SourceInfo& info);

/// For people: a table, then each sensor with what it includes, its place and what is in its way;
/// then the OpenGL devices.
std::string doctor_text(const DoctorReport& report);
std::string doctor_json(const DoctorReport& report);

}  // namespace encore::app
