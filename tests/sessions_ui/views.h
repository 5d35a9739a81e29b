#pragma once

#include "ui/plot/sample_history.h"
#include "ui/view.h"

#include <cmath>
#include <string>
#include <vector>

namespace encore::ui {

// Views filled by hand.

inline constexpr const char* kNoSensor =
    "no power source: no RAPL, no NVML, no battery; way out: enter idle and busy watts";

/// A gauge that answers at 100 Hz and changes at 10 Hz.
inline SampleHistory gauge(double idle, double busy) {
  SampleHistory history;
  for (int i = 0; i < 3000; ++i) {
    const bool working = (i / 300) % 2 == 1;
    const double wave = std::round(2.0 * std::sin(0.1 * (i / 10)));
    history.add(0.01 * i, (working ? busy : idle) + wave, i % 10 == 0);
  }
  return history;
}

inline PowerSeriesView series(const std::string& name, energy::Origin origin,
                              const SampleHistory* history) {
  PowerSeriesView power;
  power.name = name;
  power.includes = "cores, caches and the memory controller";
  power.provenance = {origin, name};
  power.in_total = true;
  power.history = history;
  if (history != nullptr) power.watts = history->latest()->last;
  return power;
}

inline void add_slots(PlotData& plots) {
  using Kind = SlotView::Kind;
  const Kind kinds[] = {Kind::idle, Kind::cpu, Kind::idle, Kind::gpu, Kind::idle, Kind::raster};
  for (int i = 0; i < 10; ++i) {
    plots.slots.push_back({3.0 * i, 3.0 * i + 2.9, kinds[i % 6], "cpu bvh-median refit"});
  }
  plots.annotations.push_back({12.0, "lid opened"});
  plots.now_s = 30.0;
}

/// Without a source the joules say why they are not there.
inline ConfigurationView configuration(const std::string& label, energy::Origin origin,
                                       double scale = 1.0) {
  ConfigurationView one;
  one.label = label;
  one.operations = 100.0;
  one.measured_s = 9.0;
  one.mean_s = 0.09 * scale;
  one.ci95_s = 0.001 * scale;
  const bool joules = origin != energy::Origin::unavailable;
  const energy::Provenance provenance{origin, joules ? "rapl:package-0" : kNoSensor};
  const double seconds[] = {0.03, 0.01, 0.05};
  const char* names[] = {"build", "transfer", "render"};
  for (int i = 0; i < 3; ++i) {
    PhaseFigure phase;
    phase.phase = names[i];
    phase.seconds = seconds[i] * scale;
    phase.joules.provenance = provenance;
    if (joules) phase.joules.value = 30.0 * seconds[i] * scale;
    one.phases.push_back(std::move(phase));
  }
  one.joules.provenance = provenance;
  if (joules) {
    one.joules.value = 2.7 * scale;
    one.joules.half_width = 0.05 * scale;
  }
  for (int i = 1; i <= 40; ++i) {
    one.time_error.push_back({0.25 * i, 0.05 / std::sqrt(i)});
    if (joules) one.joules_error.push_back({0.25 * i, 0.2 / std::sqrt(i)});
  }
  return one;
}

inline SessionView compared_session() {
  SessionView session;
  session.folder = "/sessions/monday";
  session.state = "complete";
  session.facts = {"encore, started at nine", "plan settle", "power: rapl:package-0 (measured)"};
  session.plots.configurations = {configuration("cpu bvh", energy::Origin::measured),
                                  configuration("cpu grid", energy::Origin::unavailable)};
  session.plots.now_s = 30.0;
  session.other_folder = "/sessions/tuesday";
  ChangeView lower;
  lower.label = "cpu bvh";
  lower.a_s = 0.09;
  lower.b_s = 0.081;
  lower.time_percent = -10.0;
  lower.time_low = -12.0;
  lower.time_high = -8.0;
  lower.time_verdict = "lower";
  lower.a_joules = 2.7;
  lower.b_joules = 2.9;
  lower.joules_percent = 7.4;
  lower.joules_low = 5.0;
  lower.joules_high = 9.9;
  lower.joules_verdict = "higher";
  ChangeView noise;
  noise.label = "cpu grid";
  noise.a_s = 0.2;
  noise.b_s = 0.201;
  noise.time_percent = 0.5;
  noise.time_verdict = "unknown";
  session.changes = {lower, noise};
  session.warnings = {"cpu grid: 1000 triangles in A, 1001 in B"};
  return session;
}

inline DoctorView doctor_with_obstacles() {
  DoctorView doctor;
  doctor.machine = "laptop, two cores";
  SensorRow usable;
  usable.name = "battery:BAT0";
  usable.place = "/sys/class/power_supply/BAT0";
  usable.includes = "the whole machine, on battery";
  usable.usable = true;
  usable.period = "250.0 ms";
  usable.watts = 11.25;
  SensorRow closed;
  closed.name = "rapl:package-0";
  closed.place = "/sys/class/powercap/intel-rapl:0";
  closed.includes = "cores, caches and the memory controller";
  closed.obstacle = "energy_uj may only be read by root";
  closed.way_out = "sudo chmod a+r /sys/class/powercap/intel-rapl:0/energy_uj";
  doctor.sensors = {usable, closed};
  doctor.opengl = {"llvmpipe, OpenGL 4.5, software"};
  return doctor;
}

}  // namespace encore::ui
