#include "app/doctor.h"
#include "app/json_text.h"
#include "app/profile_table.h"

#include <fmt/format.h>

#include <cmath>

namespace encore::app {

namespace {

using energy::Seconds;

std::string time_text(Seconds time) {
  if (time < Seconds(1.0)) return fmt::format("{:.3g} ms", energy::milliseconds(time));
  return fmt::format("{:.3g} s", time.value);
}

std::string power_text(energy::Watts power) {
  // A load below the last digit is still no 0.
  return power.value != 0.0 && std::abs(power.value) < 0.005 ? fmt::format("{:.2g} W", power.value)
                                                             : fmt::format("{:.2f} W", power.value);
}

std::string state_of(const SensorReport& sensor) {
  if (sensor.obstacle) return "not usable";
  return sensor.set_aside.empty() ? "usable" : "set aside";
}

std::string period_text(const SensorReport& sensor) {
  if (!sensor.period) return {};
  return (sensor.period_is_bound ? "≤ " : "") + time_text(sensor.period->median);
}

std::string table_of(const DoctorReport& report) {
  TextTable table;
  table.add_column("sensor", TextTable::Align::left);
  table.add_column("state", TextTable::Align::left);
  table.add_column("domain", TextTable::Align::left);
  table.add_column("update period");
  table.add_column("mean power");
  for (const SensorReport& sensor : report.sensors) {
    const bool there = !sensor.obstacle || !sensor.info.unit.empty();
    table.add_row({sensor.info.name, state_of(sensor),
                   there ? std::string(energy::to_string(sensor.info.domain)) : std::string(),
                   period_text(sensor), sensor.mean ? power_text(*sensor.mean) : std::string()});
  }
  return table.text();
}

void add_line(std::string& text, std::string_view name, std::string_view value) {
  if (!value.empty()) text += fmt::format("  {:<14} {}\n", name, value);
}

std::string details_of(const SensorReport& sensor) {
  std::string text = sensor.info.name + '\n';
  add_line(text, "includes", sensor.info.includes);
  add_line(text, "place", sensor.info.place);
  if (sensor.obstacle) {
    add_line(text, "in the way", sensor.obstacle->reason);
    add_line(text, "way out", sensor.obstacle->fix);
    return text;
  }
  std::string period = fmt::format("{} as documented", time_text(sensor.info.update_period));
  if (sensor.period) {
    period += fmt::format("; seen: median {}, longest {}", period_text(sensor),
                          time_text(sensor.period->longest));
    if (sensor.period_is_bound) {
      period += fmt::format(" (read every {})", time_text(sensor.info.poll_period));
    }
  }
  add_line(text, "update period", period);
  add_line(text, "set aside", sensor.set_aside);
  for (const std::string& note : sensor.notes) add_line(text, "note", note);
  return text;
}

std::string total_text(const DoctorReport& report) {
  if (report.total.empty()) {
    return report.any_usable() ? "nothing: all usable sensors are set aside; name one with --source"
                               : "nothing: no sensor can be used, so that times can be measured "
                                 "but no energy; a model (--model) gives estimates, marked as such";
  }
  std::string text;
  for (const std::size_t i : report.total) {
    text += (text.empty() ? "" : " + ") + report.sensors[i].info.name;
  }
  return text + (report.total_mean ? ": " + power_text(*report.total_mean)
                                   : ": watts not known yet, see the notes");
}

std::string machine_text(const energy::Host& host) {
  std::string text = "the processor does not say whether it is virtual";
  if (host.virtual_machine) {
    text = *host.virtual_machine ? "virtual: what sensors show may be another machine's, too"
                                 : "no hypervisor";
  }
  return host.container ? text + "; inside a container" : text;
}

std::string optional_json(const std::optional<energy::Watts>& power) {
  return power ? json_number(power->value) : "null";
}

std::string json_list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + json_text(word);
  return '[' + text + ']';
}

std::string sensor_json(const SensorReport& sensor) {
  const energy::SourceInfo& info = sensor.info;
  std::string text = fmt::format(
      "{{\"name\": {}, \"kind\": {}, \"usable\": {}, \"domain\": {}, \"unit\": {}, \"includes\": "
      "{},\n   \"place\": {}, \"provenance\": {}, \"is_counter\": {}, \"update_period_s\": {}, "
      "\"poll_period_s\": {},\n",
      json_text(info.name), json_text(energy::to_string(info.kind)), !sensor.obstacle,
      json_text(energy::to_string(info.domain)), json_text(info.unit), json_text(info.includes),
      json_text(info.place), json_text(energy::to_string(info.provenance.origin)), info.is_counter,
      json_number(info.update_period.value), json_number(info.poll_period.value));
  text += fmt::format(
      "   \"observed_period_s\": {}, \"observed_longest_s\": {}, \"period_is_bound\": {}, "
      "\"changes\": {}, \"mean_w\": {},\n",
      sensor.period ? json_number(sensor.period->median.value) : "null",
      sensor.period ? json_number(sensor.period->longest.value) : "null", sensor.period_is_bound,
      sensor.changes, optional_json(sensor.mean));
  return text + fmt::format("   \"set_aside\": {}, \"notes\": {}, \"reason\": {}, \"fix\": {}}}",
                            json_text(sensor.set_aside), json_list(sensor.notes),
                            json_text(sensor.obstacle ? sensor.obstacle->reason : ""),
                            json_text(sensor.obstacle ? sensor.obstacle->fix : ""));
}

}  // namespace

std::string doctor_text(const DoctorReport& report) {
  std::string text = table_of(report) + '\n';
  for (const SensorReport& sensor : report.sensors) text += details_of(sensor) + '\n';
  text += fmt::format("{:<16} {}\n", "total", total_text(report));
  text += fmt::format("{:<16} {}\n", "machine", machine_text(report.host));
  if (report.readings > 0) {
    text += fmt::format("{:<16} {:.2f} % of one core ({} readings in {})\n", "cost of reading",
                        100.0 * report.cost.share(), report.readings, time_text(report.observed));
  }
  if (report.opengl) text += '\n' + opengl_text(*report.opengl);
  return text;
}

std::string doctor_json(const DoctorReport& report) {
  std::string sensors;
  for (const SensorReport& sensor : report.sensors) {
    sensors += (sensors.empty() ? "\n  " : ",\n  ") + sensor_json(sensor);
  }
  std::vector<std::string> total;
  for (const std::size_t i : report.total) total.push_back(report.sensors[i].info.name);
  const auto& vm = report.host.virtual_machine;
  return fmt::format(
      "{{\"usable\": {}, \"virtual_machine\": {}, \"container\": {}, \"observed_s\": {},\n"
      " \"total\": {{\"sources\": {}, \"mean_w\": {}}},\n"
      " \"sampling\": {{\"share_of_core\": {}, \"readings\": {}}},\n \"opengl\": {},\n"
      " \"sensors\": [{}\n]}}\n",
      report.any_usable(), vm ? (*vm ? "true" : "false") : "null", report.host.container,
      json_number(report.observed.value), json_list(total), optional_json(report.total_mean),
      report.readings > 0 ? json_number(report.cost.share()) : "null", report.readings,
      report.opengl ? opengl_json(*report.opengl) : "null", sensors);
}

}  // namespace encore::app
