#include "app/profile_report.h"

#include "app/configuration_cells.h"
#include "app/energy_report.h"
#include "app/json_text.h"
#include "app/number_text.h"
#include "app/profile_table.h"
#include "app/ray_report.h"
#include "app/session_input.h"
#include "energy/session_columns.h"
#include "energy/session_energy_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

namespace encore::app {

namespace {

using energy::Phase;
using energy::SummaryRow;

/// A figure with the given decimals; nothing where it does not apply.
std::string figure(std::optional<double> value, int decimals = 0) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : std::string();
}

std::string percent(std::optional<double> share) {
  return share ? fmt::format("{:.1f}%", 100.0 * *share) : std::string();
}

std::string bytes(std::optional<double> value) {
  return value ? bytes_text(static_cast<std::uint64_t>(*value)) : std::string();
}

/// "depth 18" of a tree, "22x22x22" of a grid.
std::string shape(const SummaryRow& row) {
  if (const auto depth = counter_value(row, "max_depth"))
    return fmt::format("depth {:.0f}", *depth);
  const auto x = counter_value(row, "grid_x");
  if (!x) return {};
  return fmt::format("{:.0f}x{:.0f}x{:.0f}", *x, counter_value(row, "grid_y").value_or(0),
                     counter_value(row, "grid_z").value_or(0));
}

std::string mean_ms(const SummaryRow& row) {
  std::optional<double> half;
  if (row.ci95) half = energy::milliseconds(*row.ci95);
  return with_uncertainty(energy::milliseconds(row.mean), half);
}

/// A row of cells after those of its configuration.
void add_row(TextTable& table, std::vector<std::string> cells, std::vector<std::string> more) {
  cells.insert(cells.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
  table.add_row(std::move(cells));
}

std::string build_table(const std::vector<SummaryRow>& rows) {
  TextTable table;
  ConfigurationCells::add_columns(table);
  const ConfigurationCells configurations(rows);
  for (const char* title :
       {"triangles", "builds", "updates", "ms each ± 95 % CI", "nodes", "leaves", "references",
        "shape", "memory", "allocs", "allocated", "tri-box tests", "SAH cost"}) {
    table.add_column(title);
  }
  for (const SummaryRow& row : rows) {
    if (configuration_value(row.configuration, "test") != "build") continue;
    const auto count = [&](Phase phase) {
      const std::uint64_t n = row.phase_counts[phase];
      return n > 0 ? std::to_string(n) : std::string();
    };
    add_row(
        table, configurations.cells(row.configuration),
        {configuration_value(row.configuration, "triangles"), count(Phase::build),
         count(Phase::update), mean_ms(row), figure(counter_value(row, "nodes")),
         figure(counter_value(row, "leaves")), figure(counter_value(row, "references")), shape(row),
         bytes(counter_value(row, "structure_bytes")), figure(counter_value(row, "allocations")),
         bytes(counter_value(row, "allocated_bytes")),
         figure(counter_value(row, "triangle_box_tests")),
         figure(counter_value(row, "sah_cost"), 1)});
  }
  return table.empty() ? std::string() : "\nBuilds\n" + table.text();
}

std::string frame_table(const std::vector<SummaryRow>& rows) {
  TextTable table;
  ConfigurationCells::add_columns(table);
  const ConfigurationCells configurations(rows);
  for (const char* title :
       {"frames", "ms a frame ± 95 % CI", "frames/s", "animate", "build", "update", "transfer",
        "render", "sent", "builds", "updates", "SAH cost", "Mrays/s", "hits"}) {
    table.add_column(title);
  }
  for (const SummaryRow& row : rows) {
    const std::string test = configuration_value(row.configuration, "test");
    if (test == "build") continue;
    // The number of builds tells nothing where there are none.
    const auto count = [&](Phase phase) {
      return test != "static" ? std::to_string(row.phase_counts[phase]) : std::string();
    };
    add_row(table, configurations.cells(row.configuration),
            {std::to_string(row.phase_counts[Phase::render]), mean_ms(row),
             row.mean.value > 0 ? fmt::format("{:.1f}", 1.0 / row.mean.value) : "",
             percent(row.shares[Phase::animate]), percent(row.shares[Phase::build]),
             percent(row.shares[Phase::update]), percent(row.shares[Phase::transfer]),
             percent(row.shares[Phase::render]), bytes(counter_value(row, "transfer_bytes")),
             count(Phase::build), count(Phase::update), figure(counter_value(row, "sah_cost"), 1),
             figure(counter_value(row, "mrays_per_s"), 3), figure(counter_value(row, "hits"))});
  }
  return table.empty() ? std::string() : "\nFrames\n" + table.text();
}

/// The columns whose content is always text, whatever it looks like.
bool is_text(std::string_view column) {
  for (const std::string_view name :
       {"group", "scene", "device", "structure", "policy", "test", "memory", "preset", "build_on",
        "update_case", "intersection", "grouping", "rays", "source", "energy_provenance", "phase",
        "method", "note"}) {
    if (column == name) return true;
  }
  return false;
}

/// One record as an object: empty is null, numbers are numbers.
std::string json_object(const energy::CsvRecord& header, const energy::CsvRecord& record) {
  std::string json = "{";
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (i > 0) json += ", ";
    json += json_text(header[i]) + ": ";
    if (record[i].empty()) {
      json += "null";
    } else if (!is_text(header[i]) && energy::parse_csv_number(record[i])) {
      json += record[i];
    } else {
      json += json_text(record[i]);
    }
  }
  return json + "}";
}

energy::SessionColumns columns_of(const std::vector<energy::KeyValue>& configuration,
                                  const std::vector<energy::Counter>& counters) {
  energy::SessionColumns columns;
  for (const energy::KeyValue& part : configuration) columns.configuration.push_back(part.key);
  for (const energy::Counter& counter : counters) columns.counters.push_back(counter.name);
  return columns;
}

/// A list of objects, one a line.
std::string json_list(const std::vector<std::string>& objects) {
  std::string json = "[";
  const char* separator = "\n    ";
  for (const std::string& object : objects) {
    json += separator + object;
    separator = ",\n    ";
  }
  return json + (objects.empty() ? "]" : "\n  ]");
}

}  // namespace

std::string with_uncertainty(double value, std::optional<double> half_width) {
  // Two digits of the half-width, or four of the value if it has none.
  const auto decimals_for = [](double number, int digits) {
    if (!(number > 0)) return 3;
    return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(number))), 0, 9);
  };
  if (!half_width) return fmt::format("{:.{}f} ± ?", value, decimals_for(value, 4));
  const int decimals = decimals_for(*half_width, 2);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, *half_width, decimals);
}

std::string report_text(const ProfileReport& report) {
  std::string text =
      fmt::format("Energy: {} ({})\nSession: {}{}\n", energy::to_string(report.sensor.origin),
                  report.sensor.detail, report.folder.string(),
                  report.state == energy::SessionState::complete
                      ? std::string()
                      : fmt::format(" ({})", energy::to_string(report.state)));
  if (report.gpu) text += fmt::format("GPU: {}\n", report.gpu->name);
  if (report.rows.empty()) return text + "\nNothing was measured.\n";
  if (const std::string rays = common_rays(report.rows); !rays.empty()) {
    text += fmt::format("Pictures: {}\n", rays);
  }
  return text + build_table(report.rows) + frame_table(report.rows) + ray_table(report.rows) +
         transfer_text(report.transfers, report.rows) + energy_text(report) +
         left_out_text(report.left_out);
}

std::string report_json(const ProfileReport& report) {
  std::string json = fmt::format(
      "{{\n  \"session\": {},\n  \"state\": {},\n  \"gpu\": {},\n  \"energy\": {{\"provenance\": "
      "{}, "
      "\"detail\": {}}},\n  \"sampling_share_of_a_core\": {},\n  \"results\": ",
      json_text(report.folder.string()), json_text(energy::to_string(report.state)),
      report.gpu ? fmt::format("{{\"name\": {}, \"version\": {}}}", json_text(report.gpu->name),
                               json_text(report.gpu->version))
                 : "null",
      json_text(energy::to_string(report.sensor.origin)), json_text(report.sensor.detail),
      report.sampling ? energy::csv_number(report.sampling->share()) : "null");
  std::vector<std::string> results;
  for (const SummaryRow& row : report.rows) {
    const auto columns = columns_of(row.configuration, row.counters);
    results.push_back(json_object(energy::summary_header(columns), energy::to_record(row)));
  }
  std::vector<std::string> phases;
  for (const energy::PhaseRow& row : report.phases) {
    const auto columns = columns_of(row.configuration, {});
    phases.push_back(json_object(energy::phase_header(columns), energy::to_record(row)));
  }
  std::vector<std::string> transfers;
  for (const TransferFigures& figures : report.transfers) {
    const auto columns = columns_of(figures.configuration, {});
    transfers.push_back(json_object(transfer_header(columns.configuration), to_record(figures)));
  }
  json += json_list(results) + ",\n  \"phases\": " + json_list(phases) +
          ",\n  \"transfers\": " + json_list(transfers) +
          ",\n  \"left_out\": " + left_out_json(report.left_out);
  return json + "\n}\n";
}

}  // namespace encore::app
