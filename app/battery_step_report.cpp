#include "app/battery_report.h"
#include "app/json_text.h"
#include "app/number_text.h"
#include "app/profile_table.h"

#include <fmt/format.h>

#include <cmath>

namespace encore::app {

namespace {

using energy::Seconds;

/// "1 ms", "10 min", "10 h".
std::string duration_text(Seconds time) {
  if (!std::isfinite(time.value)) return "by charge";
  if (time.value >= 3600.0) return fmt::format("{:g} h", time.value / 3600.0);
  if (time.value >= 60.0) return fmt::format("{:g} min", time.value / 60.0);
  if (time.value >= 1.0) return fmt::format("{:g} s", time.value);
  return fmt::format("{:g} ms", time.value * 1e3);
}

std::string remark(const energy::StepRow& row) {
  if (row.left_out) return "left out: too many steps";
  return row.stable ? "" : "unstable at this step";
}

}  // namespace

std::string step_text(const std::vector<energy::StepTable>& tables) {
  std::string text;
  for (const energy::StepTable& study : tables) {
    TextTable table;
    for (const char* title : {"step", "steps", "relative error", "run time"}) {
      table.add_column(title);
    }
    table.add_column("remark", TextTable::Align::left);
    for (const energy::StepRow& row : study.rows) {
      const bool run = !row.left_out;
      table.add_row({duration_text(row.step), run ? with_separators(row.steps) : "",
                     !run        ? ""
                     : row.error ? fmt::format("{:.2e}", *row.error)
                                 : "beyond numbers",
                     run ? fmt::format("{:.3g} ms", milliseconds(row.run_time)) : "", remark(row)});
    }
    text += fmt::format("{}{} ({})\n{}", text.empty() ? "" : "\n", study.method, study.measure,
                        table.text());
  }
  return text;
}

std::string step_json(const std::vector<energy::StepTable>& tables) {
  std::string json = "\"steps\": [";
  const char* table_separator = "\n    ";
  for (const energy::StepTable& study : tables) {
    json += fmt::format("{}{{\"method\": {}, \"error_of\": {}, \"rows\": [", table_separator,
                        json_text(study.method), json_text(study.measure));
    table_separator = ",\n    ";
    const char* separator = "\n      ";
    for (const energy::StepRow& row : study.rows) {
      json += fmt::format(
          "{}{{\"step_s\": {}, \"steps\": {}, \"relative_error\": {}, \"run_time_s\": {}, "
          "\"stable\": {}, \"left_out\": {}}}",
          separator, json_number(row.step.value), row.steps,
          row.error ? json_number(*row.error) : "null", json_number(row.run_time.value), row.stable,
          row.left_out);
      separator = ",\n      ";
    }
    json += "]}";
  }
  return json + "]";
}

}  // namespace encore::app
