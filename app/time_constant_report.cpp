#include "app/time_constant_report.h"

#include "app/json_text.h"
#include "app/profile_table.h"
#include "energy/csv.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace encore::app {

namespace {

using energy::TimeConstantRow;
using energy::TimeConstantTable;

/// "1 ms", "10 h", "1e6 s".
std::string short_time(double seconds) {
  if (seconds < 1.0) return fmt::format("{:g} ms", seconds * 1e3);
  if (seconds >= 1e5) return fmt::format("{:.0e} s", seconds);
  const double hours = seconds / 3600.0;
  if (hours >= 1.0 && hours == std::floor(hours)) return fmt::format("{:g} h", hours);
  const double minutes = seconds / 60.0;
  if (minutes >= 1.0 && minutes == std::floor(minutes)) return fmt::format("{:g} min", minutes);
  return fmt::format("{:g} s", seconds);
}

std::string cell(const TimeConstantRow& row) {
  if (!row.refused.empty()) {
    const bool is_short = row.high && std::isinf(row.high->value);
    const bool is_coarse = row.low && row.low->value == 0.0;
    return is_short == is_coarse ? "no" : is_short ? "short" : "coarse";
  }
  const std::string error = row.error ? fmt::format("{:.0e}", *row.error) : "beyond";
  return row.stable ? error : error + "!";
}

std::string number_or_null(const std::optional<double>& value) {
  return value ? json_number(*value) : "null";
}

std::optional<double> value_of(const std::optional<energy::Seconds>& time) {
  return time && std::isfinite(time->value) ? std::optional(time->value) : std::nullopt;
}

std::string remark(const TimeConstantRow& row) {
  return row.stable ? row.refused : "unstable at this step";
}

constexpr double kLeastError = 1e-17;
constexpr double kMostError = 100.0;

LogPlot error_plot(std::string title, std::string x_title) {
  LogPlot plot;
  plot.title = std::move(title);
  plot.x_title = std::move(x_title);
  plot.y_title = "relative error (100: that or more)";
  plot.least_y = kLeastError;
  plot.most_y = kMostError;
  return plot;
}

/// Nothing where the numbers ran over: far beyond the plot.
template <class Row>
double plotted_error(const Row& row) {
  return row.error.value_or(INFINITY);
}

}  // namespace

std::string time_constant_text(const std::vector<TimeConstantTable>& tables) {
  std::string text;
  for (const TimeConstantTable& study : tables) {
    TextTable table;
    table.add_column("time constant");
    std::vector<std::vector<std::string>> lines;
    double run_time = 0.0;
    double tau = -1.0;
    std::size_t columns = 0;
    for (const TimeConstantRow& row : study.rows) {
      if (row.tau.value != tau) {
        tau = row.tau.value;
        lines.push_back({short_time(tau)});
      }
      lines.back().push_back(cell(row));
      if (lines.size() == 1) {
        table.add_column(short_time(row.step.value));
        ++columns;
      }
      run_time += row.run_time.value;
    }
    for (auto& line : lines) {
      line.resize(columns + 1);
      table.add_row(std::move(line));
    }
    text += fmt::format("{}{}: relative error by step ({}), {:.3g} ms in all\n{}",
                        text.empty() ? "" : "\n", study.method, study.measure, run_time * 1e3,
                        table.text());
  }
  return text +
         "!: unstable at this step; beyond: beyond numbers; short, coarse: the record is too short "
         "or too\ncoarse to tell the time constant; no: neither side of it is known\n";
}

std::string time_constant_json(const std::vector<TimeConstantTable>& tables) {
  std::string json = "\"time_constants\": [";
  const char* table_separator = "\n    ";
  for (const TimeConstantTable& study : tables) {
    json += fmt::format("{}{{\"method\": {}, \"error_of\": {}, \"rows\": [", table_separator,
                        json_text(study.method), json_text(study.measure));
    table_separator = ",\n    ";
    const char* separator = "\n      ";
    for (const TimeConstantRow& row : study.rows) {
      json += fmt::format(
          "{}{{\"tau_s\": {}, \"step_s\": {}, \"steps\": {}, \"relative_error\": {}, "
          "\"run_time_s\": {}, \"stable\": {}, \"fitted_tau_s\": {}, \"tau_low_s\": {}, "
          "\"tau_high_s\": {}, \"reason\": {}}}",
          separator, json_number(row.tau.value), json_number(row.step.value), row.steps,
          number_or_null(row.error), json_number(row.run_time.value), row.stable,
          number_or_null(value_of(row.fitted)), number_or_null(value_of(row.low)),
          number_or_null(value_of(row.high)), json_text(row.refused));
      separator = ",\n      ";
    }
    json += "]}";
  }
  return json + "]";
}

void write_step_csv(const std::filesystem::path& file, const StepStudy& study) {
  using energy::csv_number;
  energy::CsvWriter out(
      file, {"method", "error_of", "tau_s", "step_s", "steps", "relative_error", "run_time_s",
             "stable", "fitted_tau_s", "tau_low_s", "tau_high_s", "remark"});
  for (const energy::StepTable& table : study.battery) {
    for (const energy::StepRow& row : table.rows) {
      const bool by_charge = !std::isfinite(row.step.value);
      out.write({table.method, table.measure, "", csv_number(row.step.value),
                 row.left_out ? "" : std::to_string(row.steps), csv_number(row.error),
                 row.left_out ? "" : csv_number(row.run_time.value), row.stable ? "true" : "false",
                 "", "", "",
                 row.left_out  ? "left out: too many steps"
                 : by_charge   ? "steps by charge"
                 : !row.stable ? "unstable at this step"
                               : ""});
    }
  }
  for (const TimeConstantTable& table : study.time_constants) {
    for (const TimeConstantRow& row : table.rows) {
      out.write({table.method, table.measure, csv_number(row.tau.value), csv_number(row.step.value),
                 std::to_string(row.steps), csv_number(row.error), csv_number(row.run_time.value),
                 row.stable ? "true" : "false", csv_number(value_of(row.fitted)),
                 csv_number(value_of(row.low)), csv_number(value_of(row.high)), remark(row)});
    }
  }
}

std::vector<LogPlot> step_plots(const StepStudy& study) {
  LogPlot by_step = error_plot("Battery models: error against step size", "step (s)");
  LogPlot by_time = error_plot("Battery models: error against run time", "run time (s)");
  for (const energy::StepTable& table : study.battery) {
    PlotSeries steps{table.method, {}};
    PlotSeries times{table.method, {}};
    for (const energy::StepRow& row : table.rows) {
      if (row.left_out) continue;
      steps.points.push_back({row.step.value, plotted_error(row), {}});
      times.points.push_back({row.run_time.value, plotted_error(row), {}});
    }
    by_step.series.push_back(std::move(steps));
    by_time.series.push_back(std::move(times));
  }
  LogPlot ratios = error_plot("Gauge filter and thermal drift: time constants 1 ms to 1e6 s",
                              "step / time constant");
  LogPlot tau_time =
      error_plot("Gauge filter and thermal drift: error against run time", "run time (s)");
  for (const TimeConstantTable& table : study.time_constants) {
    PlotSeries points{table.method, {}, false};
    PlotSeries times{table.method, {}, false};
    for (const TimeConstantRow& row : table.rows) {
      if (!row.refused.empty()) continue;
      points.points.push_back({row.step / row.tau, plotted_error(row), {}});
      times.points.push_back({row.run_time.value, plotted_error(row), {}});
    }
    ratios.series.push_back(std::move(points));
    tau_time.series.push_back(std::move(times));
  }
  return {by_step, by_time, ratios, tau_time};
}

}  // namespace encore::app
