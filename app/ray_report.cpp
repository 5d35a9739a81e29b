#include "app/ray_report.h"

#include "app/configuration_cells.h"
#include "app/energy_report.h"
#include "app/profile_table.h"
#include "app/session_input.h"
#include "scene/ray_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace encore::app {

namespace {

std::string counter_name(std::size_t kind, std::string_view unit) {
  return fmt::format("{}_{}", scene::to_string(static_cast<scene::RayKind>(kind)), unit);
}

std::optional<double> figure(const energy::SummaryRow& row, std::size_t kind,
                             std::string_view unit) {
  return counter_value(row, counter_name(kind, unit));
}

bool beyond_the_first(const energy::SummaryRow& row) {
  for (std::size_t kind = 1; kind < scene::kRayKinds; ++kind) {
    if (figure(row, kind, "rays").value_or(0.0) > 0.0) return true;
  }
  return false;
}

std::string text(std::optional<double> value, double factor, int decimals) {
  return value ? fmt::format("{:.{}f}", *value * factor, decimals) : std::string();
}

}  // namespace

void add_ray_energy(const std::vector<energy::PhaseRow>& phases, energy::SummaryRow& row) {
  const auto render = std::find_if(phases.begin(), phases.end(), [](const energy::PhaseRow& one) {
    return one.phase == energy::to_string(energy::Phase::render);
  });
  if (render == phases.end() || !render->joules) return;
  double all_ms = 0.0;
  for (std::size_t kind = 0; kind < scene::kRayKinds; ++kind) {
    all_ms += figure(row, kind, "ms").value_or(0.0);
  }
  if (!(all_ms > 0.0)) return;
  for (std::size_t kind = 0; kind < scene::kRayKinds; ++kind) {
    const std::optional<double> ms = figure(row, kind, "ms");
    if (!ms) continue;
    for (energy::Counter& counter : row.counters) {
      if (counter.name != counter_name(kind, "joules")) continue;
      counter.value = render->joules->value * *ms / all_ms;
      counter.unavailable = false;
    }
  }
}

std::string ray_table(const std::vector<energy::SummaryRow>& rows) {
  TextTable table;
  ConfigurationCells::add_columns(table);
  table.add_column("rays", TextTable::Align::left);
  for (const char* title : {"a frame", "ms", "share", "Mrays/s", "energy"}) table.add_column(title);
  const ConfigurationCells configurations(rows);
  for (const energy::SummaryRow& row : rows) {
    if (!beyond_the_first(row)) continue;
    double all_ms = 0.0;
    for (std::size_t kind = 0; kind < scene::kRayKinds; ++kind) {
      all_ms += figure(row, kind, "ms").value_or(0.0);
    }
    for (std::size_t kind = 0; kind < scene::kRayKinds; ++kind) {
      const double rays = figure(row, kind, "rays").value_or(0.0);
      if (!(rays > 0.0)) continue;
      const std::optional<double> ms = figure(row, kind, "ms");
      const std::optional<double> joules = figure(row, kind, "joules");
      auto cells = configurations.cells(row.configuration);
      for (std::string cell :
           {std::string(scene::to_string(static_cast<scene::RayKind>(kind))),
            fmt::format("{:.0f}", rays), text(ms, 1.0, 3),
            ms && all_ms > 0.0 ? fmt::format("{:.1f}%", 100.0 * *ms / all_ms) : std::string(),
            ms && *ms > 0.0 ? fmt::format("{:.3f}", rays / *ms / 1e3) : std::string(),
            joules ? joules_text(*joules, std::nullopt) : std::string()}) {
        cells.push_back(std::move(cell));
      }
      table.add_row(std::move(cells));
    }
  }
  if (table.empty()) return {};
  return "\nRays, by kind (a kind's time includes shading what it hit; energy: render's, shared by "
         "time)\n" +
         table.text();
}

}  // namespace encore::app
