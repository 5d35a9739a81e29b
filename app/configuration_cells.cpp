#include "app/configuration_cells.h"

#include "app/session_input.h"

#include <algorithm>
#include <string_view>

namespace encore::app {

namespace {

/// Whether any configuration says something else than `usual` here; an empty value says nothing.
bool differs(const std::vector<energy::SummaryRow>& rows, std::string_view key,
             std::string_view usual) {
  return std::any_of(rows.begin(), rows.end(), [&](const energy::SummaryRow& row) {
    const std::string value = configuration_value(row.configuration, key);
    return !value.empty() && value != usual;
  });
}

}  // namespace

ConfigurationCells::ConfigurationCells(const std::vector<energy::SummaryRow>& rows)
    : groups_(differs(rows, "group", "")),
      devices_(differs(rows, "device", "cpu")),
      memory_(differs(rows, "memory", "pool")),
      cases_(differs(rows, "update_case", "real")),
      intersections_(differs(rows, "intersection", "precise")),
      rays_(differs(rows, "rays", "none")),
      samples_(differs(rows, "samples", "1")),
      repeats_(differs(rows, "repeat", "1")) {}

void ConfigurationCells::add_columns(TextTable& table) {
  for (const char* title : {"group", "scene", "device", "test", "structure", "policy", "case",
                            "memory", "intersection", "rays", "samples", "size", "repeat"}) {
    table.add_column(title, TextTable::Align::left);
  }
}

std::vector<std::string> ConfigurationCells::cells(
    const std::vector<energy::KeyValue>& configuration) const {
  const auto value = [&](std::string_view key, bool shown = true) {
    return shown ? configuration_value(configuration, key) : std::string();
  };
  const std::string width = value("width");
  return {value("group", groups_),
          value("scene"),
          value("device", devices_),
          value("test"),
          value("structure"),
          value("policy"),
          value("update_case", cases_),
          value("memory", memory_),
          value("intersection", intersections_),
          value("rays", rays_),
          value("samples", samples_),
          width.empty() ? std::string() : width + "x" + value("height"),
          value("repeat", repeats_)};
}

}  // namespace encore::app
