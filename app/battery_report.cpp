#include "app/battery_report.h"

#include "app/json_text.h"
#include "app/number_text.h"
#include "app/profile_table.h"
#include "app/session_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace encore::app {

namespace {

using energy::BatteryForecast;
using Align = TextTable::Align;

/// The parts of a configuration that the table shows, in its order.
constexpr std::string_view kShown[] = {"scene", "test", "structure", "policy"};

std::string watts_text(const energy::BatteryLoad& load) {
  const std::string mean = fmt::format("{:.4g} W", load.watts.value);
  return load.half_width ? fmt::format("{} ± {:.2g} W", mean, load.half_width->value) : mean;
}

std::string minutes_text(std::optional<energy::Seconds> time) {
  if (!time) return "no end";
  const double minutes = time->value / 60.0;
  return minutes < 1e6 ? fmt::format("{:.{}f}", minutes, minutes < 10.0 ? 3 : 1)
                       : fmt::format("{:.3g}", minutes);
}

std::string interval_text(const BatteryForecast& f, const energy::BatteryLoad& load) {
  if (!load.half_width || !f.time) return {};
  return fmt::format("{} to {}", minutes_text(f.earliest), minutes_text(f.latest));
}

std::string count_text(double count) {
  // Beyond this a double skips whole numbers.
  constexpr double kMost = 9e15;
  if (!(count < kMost)) return fmt::format("{:.3g}", count);
  return with_separators(static_cast<std::uint64_t>(count));
}

std::string operations_text(const BatteryForecast& f, const BatteryCase& load) {
  if (!load.each) return {};
  const auto left = energy::frames_left(f, load.load, *load.each);
  if (!left) return {};
  const std::string count = fmt::format("{} {}s", count_text(left->value), load.operation);
  if (!left->low) return count;
  return fmt::format("{} ({} to {})", count, count_text(*left->low),
                     left->high ? count_text(*left->high) : "no end");
}

std::string describe(const energy::Battery& b) {
  return fmt::format(
      "Battery: {} ({}): {:.4g} V, {:.4g} Ah, {:.4g} Wh, {}S{}P, cut-off {:.4g} V, charged to "
      "{:.3g} %\n",
      b.name, b.source, b.nominal_volts, b.coulombs / 3600.0, b.full.value / 3600.0, b.series,
      b.parallel, b.cutoff_volts, 100.0 * b.soc);
}

/// Where the loads come from; cases of the same origin are named once.
std::string provenance_text(const std::vector<BatteryCase>& cases) {
  std::vector<energy::Provenance> told;
  std::string text;
  for (const BatteryCase& load : cases) {
    if (std::find(told.begin(), told.end(), load.origin) != told.end()) continue;
    told.push_back(load.origin);
    text +=
        fmt::format("Load: {} ({})\n", energy::to_string(load.origin.origin), load.origin.detail);
  }
  return text;
}

std::string json_optional(std::optional<double> value) {
  return value ? json_number(*value) : "null";
}

std::string json_minutes(std::optional<energy::Seconds> time) {
  return time ? json_number(time->value / 60.0) : "null";
}

std::string json_battery(const energy::Battery& b) {
  return fmt::format(
      "{{\"name\": {}, \"source\": {}, \"nominal_v\": {}, \"capacity_ah\": {}, \"capacity_wh\": "
      "{}, \"series\": {}, \"parallel\": {}, \"cutoff_v\": {}, \"soc\": {}}}",
      json_text(b.name), json_text(b.source), json_number(b.nominal_volts),
      json_number(b.coulombs / 3600.0), json_number(b.full.value / 3600.0), b.series, b.parallel,
      json_number(b.cutoff_volts), json_number(b.soc));
}

std::string json_forecast(const BatteryForecast& f, const BatteryCase& load) {
  std::string configuration;
  for (const energy::KeyValue& part : load.configuration) {
    configuration += json_text(part.key) + ": " + json_text(part.value) + ", ";
  }
  const auto left = load.each ? energy::frames_left(f, load.load, *load.each) : std::nullopt;
  const auto part = [&](auto member) { return left ? (*left).*member : std::nullopt; };
  return fmt::format(
      "{{{}\"watts\": {}, \"watts_ci95\": {}, \"load_provenance\": {}, \"model\": {}, "
      "\"minutes_left\": {}, \"minutes_low\": {}, \"minutes_high\": {}, \"ends_by\": {}, "
      "\"joules_delivered\": {}, \"operation\": {}, \"joules_each\": {}, \"operations_left\": {}, "
      "\"operations_low\": {}, \"operations_high\": {}, \"note\": {}}}",
      configuration, json_number(load.load.watts.value),
      load.load.half_width ? json_number(load.load.half_width->value) : "null",
      json_text(energy::to_string(load.origin.origin)), json_text(energy::to_string(f.model)),
      json_minutes(f.time), json_minutes(f.earliest), json_minutes(f.latest),
      json_text(energy::to_string(f.reason)),
      f.delivered ? json_number(f.delivered->value) : "null", json_text(load.operation),
      load.each ? json_number(load.each->value) : "null", left ? json_number(left->value) : "null",
      json_optional(part(&energy::Remaining::low)), json_optional(part(&energy::Remaining::high)),
      json_text(f.note));
}

}  // namespace

std::vector<BatteryCase> session_cases(const energy::Session& session, std::size_t& without_watts) {
  std::vector<BatteryCase> cases;
  without_watts = 0;
  for (const energy::SummaryRow& row : session.summaries) {
    if (!row.watts) {
      ++without_watts;
      continue;
    }
    BatteryCase load;
    load.configuration = row.configuration;
    load.load = {*row.watts, row.watts_ci95};
    load.each = row.joules;
    if (configuration_value(load.configuration, "test") == "build") load.operation = "build";
    const std::string seen_by = row.source.empty() ? session.info.sensor.detail : row.source;
    load.origin = {row.origin, fmt::format("{}; what it does not see draws on top", seen_by)};
    cases.push_back(std::move(load));
  }
  return cases;
}

std::string battery_text(const BatteryReport& report) {
  TextTable table;
  for (const std::string_view key : kShown) table.add_column(std::string(key), Align::left);
  table.add_column("load");
  table.add_column("model", Align::left);
  for (const char* title :
       {"minutes left", "for the load's 95 % CI", "joules delivered", "left at this load"}) {
    table.add_column(title);
  }
  table.add_column("ends by", Align::left);
  std::vector<std::string> notes;
  for (const BatteryCase& load : report.cases) {
    for (const energy::BatteryModel model : report.models) {
      const BatteryForecast f = energy::forecast(report.battery, load.load, model);
      std::vector<std::string> cells;
      for (const std::string_view key : kShown)
        cells.push_back(configuration_value(load.configuration, key));
      cells.insert(cells.end(),
                   {watts_text(load.load), std::string(energy::to_string(model)),
                    minutes_text(f.time), interval_text(f, load.load),
                    f.delivered ? fmt::format("{:.5g}", f.delivered->value) : std::string(),
                    operations_text(f, load), std::string(energy::to_string(f.reason))});
      table.add_row(std::move(cells));
      if (f.note.empty()) continue;
      const std::string note = fmt::format("{}: {}", energy::to_string(model), f.note);
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    }
  }
  std::string text = describe(report.battery) + provenance_text(report.cases);
  if (!table.empty()) text += "\n" + table.text();
  for (const std::string& note : notes) text += note + "\n";
  return text;
}

std::string battery_json(const BatteryReport& report) {
  std::string json =
      fmt::format("\"battery\": {},\n  \"forecasts\": [", json_battery(report.battery));
  const char* separator = "\n    ";
  for (const BatteryCase& load : report.cases) {
    for (const energy::BatteryModel model : report.models) {
      const BatteryForecast f = energy::forecast(report.battery, load.load, model);
      json += separator + json_forecast(f, load);
      separator = ",\n    ";
    }
  }
  return json + "]";
}

}  // namespace encore::app
