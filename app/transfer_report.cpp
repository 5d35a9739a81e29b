#include "app/configuration_cells.h"
#include "app/energy_report.h"
#include "app/number_text.h"
#include "app/profile_report.h"
#include "app/session_input.h"
#include "app/transfer_derivation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

std::string milliseconds(std::optional<double> value, std::optional<double> half) {
  if (!value) return {};
  return half ? with_uncertainty(*value, half) : fmt::format("{:.4g}", *value);
}

/// Each reason once, with the configurations that it holds for counted.
std::string missing_text(const std::vector<TransferFigures>& transfers) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const TransferFigures& figures : transfers) {
    if (figures.note.empty()) continue;
    const auto known = std::find_if(reasons.begin(), reasons.end(), [&](const auto& reason) {
      return reason.first == figures.note;
    });
    const std::string name = configuration_name(figures.configuration);
    if (known != reasons.end()) {
      known->second.push_back(name);
    } else {
      reasons.push_back({figures.note, {name}});
    }
  }
  std::string text;
  for (const auto& [reason, names] : reasons) {
    text += fmt::format("- not derived: {} ({}{})\n", reason, names.front(),
                        names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "");
  }
  return text;
}

}  // namespace

std::string transfer_text(const std::vector<TransferFigures>& transfers,
                          const std::vector<energy::SummaryRow>& rows) {
  if (transfers.empty()) return {};
  TextTable table;
  ConfigurationCells::add_columns(table);
  for (const char* title :
       {"sent", "ms", "ms derived ± 95 % CI", "energy ± 95 % CI", "energy derived ± 95 % CI"}) {
    table.add_column(title);
  }
  const bool any_energy = std::any_of(
      transfers.begin(), transfers.end(),
      [](const TransferFigures& figures) { return figures.joules || figures.derived_joules; });
  const auto energy = [&](std::optional<double> joules, std::optional<double> half) {
    if (joules) return joules_text(*joules, half);
    return std::string(any_energy ? "unavailable" : "");
  };
  const ConfigurationCells configurations(rows);
  for (const TransferFigures& figures : transfers) {
    auto cells = configurations.cells(figures.configuration);
    for (std::string cell :
         {figures.bytes ? bytes_text(static_cast<std::uint64_t>(*figures.bytes)) : std::string(),
          milliseconds(figures.ms, {}), milliseconds(figures.derived_ms, figures.derived_ms_ci95),
          energy(figures.joules, figures.joules_ci95),
          energy(figures.derived_joules, figures.derived_joules_ci95)}) {
      cells.push_back(std::move(cell));
    }
    table.add_row(std::move(cells));
  }
  return "\nTransfer, as told apart and derived (frame - build - render)\n" + table.text() +
         missing_text(transfers);
}

}  // namespace encore::app
