#include "app/configuration_cells.h"

#include "app/session_input.h"

#include <fmt/format.h>

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

/// What the first configuration says that says anything here.
std::string first_value(const std::vector<energy::SummaryRow>& rows, std::string_view key) {
  for (const energy::SummaryRow& row : rows) {
    std::string value = configuration_value(row.configuration, key);
    if (!value.empty()) return value;
  }
  return {};
}

/// Whether two configurations say different things here; an empty value says nothing.
bool varies(const std::vector<energy::SummaryRow>& rows, std::string_view key) {
  const std::string first = first_value(rows, key);
  return !first.empty() && differs(rows, key, first);
}

}  // namespace

std::string common_rays(const std::vector<energy::SummaryRow>& rows) {
  std::string text;
  const auto add = [&](std::string_view key, std::string_view usual) {
    const std::string value = first_value(rows, key);
    if (value.empty() || value == usual || varies(rows, key)) return;
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", key, value);
  };
  add("rays", "none");
  add("depth", "");
  add("samples", "1");
  add("intersection", "precise");
  return text;
}

ConfigurationCells::ConfigurationCells(const std::vector<energy::SummaryRow>& rows)
    : groups_(differs(rows, "group", "")),
      devices_(differs(rows, "device", "cpu")),
      memory_(differs(rows, "memory", "pool")),
      presets_(differs(rows, "preset", "balanced")),
      groupings_(differs(rows, "grouping", "packets")),
      places_(varies(rows, "build_on")),
      cases_(differs(rows, "update_case", "real")),
      intersections_(varies(rows, "intersection")),
      rays_(varies(rows, "rays")),
      samples_(varies(rows, "samples")),
      repeats_(differs(rows, "repeat", "1")) {}

void ConfigurationCells::add_columns(TextTable& table) {
  for (const char* title :
       {"group", "scene", "device", "test", "structure", "policy", "case", "memory", "preset",
        "built on", "intersection", "grouping", "rays", "samples", "size", "repeat"}) {
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
          value("preset", presets_),
          value("build_on", places_),
          value("intersection", intersections_),
          value("grouping", groupings_),
          value("rays", rays_),
          value("samples", samples_),
          width.empty() ? std::string() : width + "x" + value("height"),
          value("repeat", repeats_)};
}

}  // namespace encore::app
