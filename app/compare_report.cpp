#include "app/compare_report.h"

#include "app/json_text.h"
#include "app/profile_table.h"
#include "app/session_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::app {

namespace {

using Align = TextTable::Align;

double percent(double ratio) {
  return 100.0 * (ratio - 1.0);
}

/// What a change of a figure is called, lower and higher.
struct Words {
  const char* lower;
  const char* higher;
};
constexpr Words kTimeWords{"faster", "slower"};
constexpr Words kEnergyWords{"less energy", "more energy"};

std::string verdict_text(const FigureChange& change, const Words& words) {
  switch (change.verdict) {
    case Verdict::lower:
      return words.lower;
    case Verdict::higher:
      return change.regression ? std::string(words.higher) + " (REGRESSION)" : words.higher;
    case Verdict::noise:
      return "no difference beyond noise";
    case Verdict::unknown:
      return "no interval";
  }
  return {};
}

std::string table_of(const Comparison& comparison) {
  TextTable table;
  table.add_column("configuration", Align::left);
  for (const char* title : {"A ms", "B ms", "time B against A (95 %)"}) table.add_column(title);
  table.add_column("verdict", Align::left);
  for (const char* title :
       {"A W", "B W", "power B against A", "A J", "B J", "energy B against A"}) {
    table.add_column(title);
  }
  table.add_column("verdict", Align::left);
  for (const ConfigurationChange& row : comparison.matched) {
    std::string name = configuration_name(row.configuration);
    if (row.runs_a * row.runs_b > 1)
      name += fmt::format(" ({} and {} runs)", row.runs_a, row.runs_b);
    std::vector<std::string> cells{std::move(name), fmt::format("{:.4g}", row.seconds.a * 1e3),
                                   fmt::format("{:.4g}", row.seconds.b * 1e3),
                                   change_text(row.seconds), verdict_text(row.seconds, kTimeWords)};
    for (const auto* change : {&row.watts, &row.joules}) {
      cells.push_back(*change ? fmt::format("{:.4g}", (*change)->a) : "");
      cells.push_back(*change ? fmt::format("{:.4g}", (*change)->b) : "");
      cells.push_back(*change ? change_text(**change) : "");
    }
    cells.push_back(row.joules ? verdict_text(*row.joules, kEnergyWords) : "");
    table.add_row(std::move(cells));
  }
  return table.text();
}

std::string unmatched(const std::vector<std::vector<energy::KeyValue>>& configurations,
                      const char* where) {
  std::string text;
  for (const auto& configuration : configurations) {
    text += fmt::format("only in {}: {}\n", where, configuration_name(configuration));
  }
  return text;
}

/// How many verdicts there are.
std::size_t count_verdicts(const Comparison& comparison) {
  std::size_t count = 0;
  for (const ConfigurationChange& row : comparison.matched) {
    count += row.seconds.verdict != Verdict::unknown ? 1 : 0;
    count += row.joules && row.joules->verdict != Verdict::unknown ? 1 : 0;
  }
  return count;
}

std::string notes_of(const Comparison& comparison) {
  std::string text = "\nNegative: B takes less. ";
  const RunSpread& spread = comparison.time_spread;
  if (spread.degrees_of_freedom > 0) {
    text += fmt::format(
        "Repeats of one configuration differ by {:.2g} % in time; the intervals allow for it.\n",
        100.0 * spread.deviation);
  } else {
    text +=
        "Intervals come from within one run each: a second run may differ by more (heat, clock, "
        "memory layout); 'encore profile --repeats 5' measures by how much.\n";
  }
  text += fmt::format("Of {} verdicts, one in twenty differs by chance alone.\n",
                      count_verdicts(comparison));
  const auto has_energy = [](const ConfigurationChange& row) { return row.joules.has_value(); };
  if (std::any_of(comparison.matched.begin(), comparison.matched.end(), has_energy)) {
    text += comparison.same_sensor
                ? "Both used the same power source, so its gain error cancels in the percentages.\n"
                : "The power sources differ; the intervals hold the gain error of both.\n";
  }
  return text;
}

std::string regression_text(const CompareReport& report) {
  if (!report.tolerance) return {};
  const std::size_t count = report.comparison.regressions();
  if (count == 0) {
    return fmt::format("No configuration is surely worse by more than {:.4g} %.\n",
                       100.0 * *report.tolerance);
  }
  return fmt::format("REGRESSION: {} of {} configurations are worse by more than {:.4g} %.\n",
                     count, report.comparison.matched.size(), 100.0 * *report.tolerance);
}

std::string header_line(const char* name, const std::string& folder,
                        const energy::SessionInfo& info) {
  return fmt::format("{}: {} ({}, {}, energy {})\n", name, folder, info.program, info.started_utc,
                     to_string(info.sensor.origin));
}

std::string json_configuration(const std::vector<energy::KeyValue>& configuration) {
  std::string json = "{";
  for (const energy::KeyValue& part : configuration) {
    if (json.size() > 1) json += ", ";
    json += json_text(part.key) + ": " + json_text(part.value);
  }
  return json + "}";
}

std::string json_change(const std::optional<FigureChange>& change) {
  if (!change) return "null";
  const auto bound = [](std::optional<double> value) {
    return value ? json_number(*value) : std::string("null");
  };
  return fmt::format(
      "{{\"a\": {}, \"b\": {}, \"ratio\": {}, \"ratio_low\": {}, \"ratio_high\": {}, \"verdict\": "
      "{}, \"regression\": {}}}",
      json_number(change->a), json_number(change->b), json_number(change->ratio),
      bound(change->low), bound(change->high), json_text(to_string(change->verdict)),
      change->regression);
}

template <class Items, class ToJson>
std::string json_list(const Items& items, const ToJson& to_json) {
  std::string json = "[";
  const char* separator = "\n    ";
  for (const auto& item : items) {
    json += separator + to_json(item);
    separator = ",\n    ";
  }
  return json + (items.empty() ? "]" : "\n  ]");
}

std::string json_session(const std::string& folder, const energy::SessionInfo& info) {
  return fmt::format(
      "{{\"session\": {}, \"program\": {}, \"started_utc\": {}, \"state\": {}, "
      "\"energy\": {{\"provenance\": {}, \"source\": {}}}}}",
      json_text(folder), json_text(info.program), json_text(info.started_utc),
      json_text(to_string(info.state)), json_text(to_string(info.sensor.origin)),
      json_text(sensor_name(info)));
}

}  // namespace

std::string change_text(const FigureChange& change) {
  // One digit more than the interval's first, so that small differences stay visible.
  int decimals = 1;
  if (change.low && change.high) {
    const double width = percent(*change.high) - percent(*change.low);
    if (width > 0.0)
      decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 3);
  }
  const std::string value = fmt::format("{:+.{}f} %", percent(change.ratio), decimals);
  if (!change.low || !change.high) return value + " (?)";
  return fmt::format("{} ({:+.{}f} to {:+.{}f})", value, percent(*change.low), decimals,
                     percent(*change.high), decimals);
}

std::string compare_text(const CompareReport& report) {
  const Comparison& comparison = report.comparison;
  std::string text = header_line("A", report.folder_a, report.info_a) +
                     header_line("B", report.folder_b, report.info_b) + "\n" + table_of(comparison);
  if (!comparison.only_a.empty() || !comparison.only_b.empty()) {
    text += "\n" + unmatched(comparison.only_a, "A") + unmatched(comparison.only_b, "B");
  }
  return text + notes_of(comparison) + regression_text(report);
}

std::string compare_json(const CompareReport& report) {
  const Comparison& comparison = report.comparison;
  const auto row_json = [](const ConfigurationChange& row) {
    return fmt::format(
        "{{\"configuration\": {}, \"runs_a\": {}, \"runs_b\": {}, \"seconds_per_operation\": {}, "
        "\"watts\": {}, \"joules_per_operation\": {}}}",
        json_configuration(row.configuration), row.runs_a, row.runs_b, json_change(row.seconds),
        json_change(row.watts), json_change(row.joules));
  };
  return fmt::format(
      "{{\n  \"a\": {},\n  \"b\": {},\n  \"same_sensor\": {},\n  \"tolerance\": {},\n  "
      "\"regressions\": {},\n  \"run_to_run\": {},\n  \"warnings\": {},\n  \"configurations\": "
      "{},\n  \"only_in_a\": {},\n  \"only_in_b\": {}\n}}\n",
      json_session(report.folder_a, report.info_a), json_session(report.folder_b, report.info_b),
      comparison.same_sensor, report.tolerance ? json_number(*report.tolerance) : "null",
      comparison.regressions(),
      comparison.time_spread.degrees_of_freedom > 0 ? json_number(comparison.time_spread.deviation)
                                                    : "null",
      json_list(comparison.warnings, [](const std::string& text) { return json_text(text); }),
      json_list(comparison.matched, row_json), json_list(comparison.only_a, json_configuration),
      json_list(comparison.only_b, json_configuration));
}

}  // namespace encore::app
