#include "app/energy_report.h"

#include "app/configuration_cells.h"
#include "app/profile_table.h"
#include "app/session_input.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace encore::app {

namespace {

using energy::PhaseRow;
using energy::SummaryRow;
using Align = TextTable::Align;

constexpr std::string_view kMissing = "unavailable";

template <class Unit>
std::optional<double> plain(const std::optional<Unit>& quantity) {
  if (!quantity) return std::nullopt;
  return quantity->value;
}

/// Gross energy of something that cannot be told apart is missing; what has none stays blank.
std::string energy(const std::optional<energy::Joules>& value,
                   const std::optional<energy::Joules>& half) {
  return value ? joules_text(value->value, plain(half)) : std::string(kMissing);
}
std::string power(const std::optional<energy::Watts>& value,
                  const std::optional<energy::Watts>& half) {
  return value ? with_uncertainty(value->value, plain(half)) : std::string(kMissing);
}
std::string derived(const std::optional<double>& joules) {
  return joules ? joules_text(*joules, std::nullopt) : std::string();
}

std::string configuration_table(const ProfileReport& report) {
  TextTable table;
  ConfigurationCells::add_columns(table);
  for (const char* title : {"watts ± 95 % CI", "idle watts", "an operation", "net of idle",
                            "a Mray", "a pixel", "energy x delay (Js)", "°C", "throttled"}) {
    table.add_column(title);
  }
  const ConfigurationCells configurations(report.rows);
  for (const SummaryRow& row : report.rows) {
    auto cells = configurations.cells(row.configuration);
    const auto delay = counter_value(row, "energy_delay_js");
    for (std::string cell :
         {power(row.watts, row.watts_ci95),
          row.idle_watts ? power(row.idle_watts, row.idle_watts_ci95) : std::string(),
          energy(row.joules, row.joules_ci95),
          row.idle_watts ? energy(row.net_joules, row.net_joules_ci95) : std::string(),
          derived(counter_value(row, "joules_per_mray")),
          derived(counter_value(row, "joules_per_pixel")),
          delay ? fmt::format("{:.3g}", *delay) : std::string(),
          row.temperature_c ? fmt::format("{:.0f}", *row.temperature_c) : std::string(),
          row.throttle_events.value_or(0) > 0 ? fmt::format("{:.0f}", *row.throttle_events)
                                              : std::string()}) {
      cells.push_back(std::move(cell));
    }
    table.add_row(std::move(cells));
  }
  return table.empty() ? std::string() : "\nEnergy\n" + table.text();
}

std::string phase_table(const ProfileReport& report) {
  TextTable table;
  ConfigurationCells::add_columns(table);
  table.add_column("phase", Align::left);
  for (const char* title : {"watts ± 95 % CI", "an operation", "net of idle"}) {
    table.add_column(title);
  }
  table.add_column("told by", Align::left);
  const ConfigurationCells configurations(report.rows);
  for (const PhaseRow& row : report.phases) {
    if (row.phase == "all" || row.phase == "idle") continue;
    // Where one phase is the whole, nothing is left.
    if (row.phase == "remainder" && (!row.joules || row.joules->value == 0.0)) continue;
    auto cells = configurations.cells(row.configuration);
    const bool remainder = row.phase == "remainder";
    for (std::string cell :
         {row.phase, remainder ? std::string() : power(row.watts, row.watts_ci95),
          energy(row.joules, row.joules_ci95),
          row.net_joules ? energy(row.net_joules, row.net_joules_ci95) : std::string(),
          remainder ? std::string("what is left") : row.method}) {
      cells.push_back(std::move(cell));
    }
    table.add_row(std::move(cells));
  }
  return table.empty() ? std::string() : "\nEnergy by phase\n" + table.text();
}

/// Sentences, each once, with the configurations that they hold for counted.
std::string notes_text(const ProfileReport& report) {
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;
  const auto add = [&](const std::string& sentence, const std::string& name) {
    for (auto& [known, names] : notes) {
      if (known != sentence) continue;
      names.push_back(name);
      return;
    }
    notes.push_back({sentence, {name}});
  };
  for (const ProfileReport::Notes& of : report.notes) {
    for (const std::string& sentence : of.sentences) add(sentence, of.name);
  }
  for (const PhaseRow& row : report.phases) {
    if (row.note.empty()) continue;
    add(row.phase + ": " + row.note, configuration_name(row.configuration));
  }
  std::string text;
  for (const auto& [sentence, names] : notes) {
    text += fmt::format("- {} ({}{})\n", sentence, names.front(),
                        names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "");
  }
  return text.empty() ? text : "\nNotes\n" + text;
}

}  // namespace

std::string joules_text(double joules, std::optional<double> half_width) {
  constexpr std::pair<double, std::string_view> kUnits[] = {
      {1e3, "kJ"}, {1.0, "J"}, {1e-3, "mJ"}, {1e-6, "µJ"}};
  double scale = 1e-9;
  std::string_view unit = "nJ";
  for (const auto& [size, name] : kUnits) {
    if (std::abs(joules) < size) continue;
    scale = size;
    unit = name;
    break;
  }
  if (!half_width) return fmt::format("{:.4g} {}", joules / scale, unit);
  return with_uncertainty(joules / scale, *half_width / scale) + " " + std::string(unit);
}

std::string energy_text(const ProfileReport& report) {
  if (!report.sampling) return {};
  return configuration_table(report) + phase_table(report) + notes_text(report) +
         fmt::format("\nReading the sensors took {:.3f} % of one core.\n",
                     100.0 * report.sampling->share());
}

}  // namespace encore::app
