#include "app/doctor.h"

#include "energy/sources/choose_total.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace encore::app {

namespace {

using energy::Seconds;
using energy::TracePoint;
using energy::Watts;

/// Sensors of this pace are read in a burst first: their usual pace of reading is far slower than
/// their updates.
constexpr Seconds kFastest(0.02);
constexpr double kReadingsAPeriod = 5.0;
constexpr int kPeriods = 64;

std::optional<energy::TraceView::Period> period_in_burst(energy::PowerSource& source,
                                                         const energy::Clock& clock,
                                                         const std::atomic<bool>& stop) {
  const Seconds spacing = source.info().update_period / kReadingsAPeriod;
  energy::Trace trace;
  Seconds next = clock.now();
  for (int i = 0; i < kPeriods * static_cast<int>(kReadingsAPeriod) && !stop; ++i) {
    const energy::ReadResult result = source.read(clock.now());
    const bool restarted = result.state == energy::ReadState::restarted;
    if (result.state != energy::ReadState::ok && !restarted) return std::nullopt;
    trace.add(result.reading, restarted);
    next += spacing;
    clock.sleep_until(next, stop);
  }
  return trace.view().observed_period();
}

/// Whether reading it costs no more than the reading.
bool harmless(energy::SourceKind kind) {
  return kind == energy::SourceKind::rapl || kind == energy::SourceKind::perf_energy;
}

/// Opens the sensor; null, and a note or an obstacle, if that fails.
std::unique_ptr<energy::PowerSource> open(const energy::Finding& finding, bool all,
                                          SensorReport& report) {
  if (report.obstacle) return nullptr;
  if (!finding.set_aside.empty() && !all && !harmless(finding.info.kind)) {
    report.notes.emplace_back("not read, since it is set aside; --all reads it");
    return nullptr;
  }
  try {
    auto source = finding.open();
    report.info = source->info();
    return source;
  } catch (const std::exception& error) {
    report.obstacle = energy::Obstacle{error.what(), {}};
    return nullptr;
  }
}

/// A point at which the sensor was seen to change; the first of a stretch shows nothing.
bool is_change(const TracePoint& point) {
  return point.changed && !point.starts_stretch;
}

std::string seconds_text(Seconds time) {
  return fmt::format("{:.3g} s", time.value);
}

void judge(const energy::TraceView& trace, Seconds observed, SensorReport& report) {
  report.changes = static_cast<std::size_t>(
      std::count_if(trace.points().begin(), trace.points().end(), is_change));
  report.mean = mean_power(trace, report.info);
  if (!report.period) {
    report.period = trace.observed_period();
    report.period_is_bound = report.period && report.period->median < report.info.poll_period * 1.5;
  }
  const std::string none = report.info.is_counter && !report.mean ? ": no watts" : "";
  if (report.changes == 0) {
    report.notes.push_back(fmt::format("no change seen in {}{}", seconds_text(observed), none));
  } else if (!report.period || !none.empty()) {
    report.notes.push_back(fmt::format("only {} change{} seen in {}{}; --seconds observes longer",
                                       report.changes, report.changes == 1 ? "" : "s",
                                       seconds_text(observed), none));
  }
}

/// What was said while sampling, by source; the machine's own messages under "".
using Messages = std::map<std::string, std::vector<std::string>>;

void conclude(const energy::TraceView& trace, Messages& messages, Seconds observed,
              SensorReport& report) {
  std::vector<std::string> said = messages[report.info.name];
  if (trace.empty()) {
    report.obstacle = energy::Obstacle{said.empty() ? "gave no reading" : said.front(), {}};
    return;
  }
  judge(trace, observed, report);
  const std::vector<std::string>& machine = messages[""];
  said.insert(said.end(), machine.begin(), machine.end());
  for (const std::string& message : said) {
    // The same trouble again and again is told once.
    const auto& notes = report.notes;
    if (std::find(notes.begin(), notes.end(), message) == notes.end()) {
      report.notes.push_back(message);
    }
  }
}

/// A platform holds its packages: one that shows less is wired to something else.
void check_platform(std::vector<SensorReport>& sensors) {
  Watts packages;
  for (const SensorReport& sensor : sensors) {
    const bool counts = sensor.info.domain == energy::Domain::package && sensor.set_aside.empty();
    if (counts && sensor.mean) packages += *sensor.mean;
  }
  for (SensorReport& sensor : sensors) {
    if (sensor.info.domain != energy::Domain::platform || !sensor.mean) continue;
    if (*sensor.mean >= packages) continue;
    sensor.notes.push_back(
        fmt::format("shows less than the packages ({:.2f} W): not valid", packages.value));
  }
}

void add_total(DoctorReport& report) {
  std::vector<energy::SourceInfo> infos;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < report.sensors.size(); ++i) {
    const SensorReport& sensor = report.sensors[i];
    if (sensor.obstacle || !sensor.set_aside.empty()) continue;
    infos.push_back(sensor.info);
    indices.push_back(i);
  }
  Watts sum;
  bool complete = true;
  for (const std::size_t chosen : energy::choose_total(infos)) {
    report.total.push_back(indices[chosen]);
    const auto& mean = report.sensors[indices[chosen]].mean;
    complete = complete && mean.has_value();
    if (mean) sum += *mean;
  }
  if (complete && !report.total.empty()) report.total_mean = sum;
}

}  // namespace

bool DoctorReport::any_usable() const {
  return std::any_of(sensors.begin(), sensors.end(),
                     [](const SensorReport& sensor) { return !sensor.obstacle; });
}

std::optional<Watts> mean_power(const energy::TraceView& trace, const energy::SourceInfo& info) {
  const auto& points = trace.points();
  const TracePoint* first = nullptr;
  Seconds longest;
  std::optional<Watts> mean;
  for (const TracePoint& point : points) {
    if (point.starts_stretch) first = nullptr;
    if (info.is_counter && !is_change(point)) continue;
    if (first == nullptr) {
      first = &point;
      continue;
    }
    const Seconds length = point.time - first->time;
    if (info.is_counter && length < info.update_period * 2.0) continue;
    if (length <= longest) continue;
    longest = length;
    mean = (point.energy - first->energy) / length;
  }
  return mean;
}

DoctorReport examine(const energy::Host& host, const std::vector<energy::Finding>& findings,
                     const Observation& observation, const energy::Clock& clock,
                     const std::atomic<bool>& stop) {
  DoctorReport report;
  report.host = host;
  std::vector<std::unique_ptr<energy::PowerSource>> sources;
  std::vector<std::size_t> observed;
  for (const energy::Finding& finding : findings) {
    SensorReport sensor;
    sensor.info = finding.info;
    sensor.obstacle = finding.obstacle;
    sensor.set_aside = finding.set_aside;
    if (auto source = open(finding, observation.all, sensor)) {
      if (sensor.info.update_period <= kFastest) {
        sensor.period = period_in_burst(*source, clock, stop);
      }
      observed.push_back(report.sensors.size());
      sources.push_back(std::move(source));
    }
    report.sensors.push_back(std::move(sensor));
  }

  Messages messages;
  energy::SamplerSink sink;
  sink.on_reading = [&](const auto&, const auto&) { ++report.readings; };
  sink.on_event = [&](const auto& event) { messages[event.source].push_back(event.message); };
  energy::Sampler sampler(std::move(sources), clock, sink, observation.boot);
  const Seconds start = clock.now();
  const Seconds end = start + observation.length;
  while (!stop && sampler.source_count() > 0 && clock.now() < end) {
    clock.sleep_until(std::min(sampler.poll(), end), stop);
  }
  sampler.read_now();
  report.observed = clock.now() - start;
  report.cost = sampler.cost();
  for (std::size_t i = 0; i < observed.size(); ++i) {
    conclude(sampler.trace(i).view(), messages, report.observed, report.sensors[observed[i]]);
  }
  check_platform(report.sensors);
  add_total(report);
  return report;
}

}  // namespace encore::app
