#include "app/accuracy/accuracy_rows.h"

#include "app/energy_report.h"
#include "app/json_text.h"
#include "app/profile_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace encore::app {

namespace {

using Cost = std::optional<double> AccuracyRow::*;

void mark(std::vector<AccuracyRow>& rows, Cost cost, bool AccuracyRow::*best) {
  // From the cheapest on, only what errs less than everything before is worth its price.
  std::vector<AccuracyRow*> order;
  for (AccuracyRow& row : rows) {
    row.*best = false;
    if (row.*cost) order.push_back(&row);
  }
  std::stable_sort(order.begin(), order.end(), [cost](const AccuracyRow* a, const AccuracyRow* b) {
    return *(a->*cost) != *(b->*cost) ? *(a->*cost) < *(b->*cost) : a->errors.rmse < b->errors.rmse;
  });
  std::optional<double> least;
  std::optional<double> paid;
  for (AccuracyRow* row : order) {
    const bool same = least && row->errors.rmse == *least && *(row->*cost) == *paid;
    if (least && !(row->errors.rmse < *least) && !same) continue;
    row->*best = true;
    least = row->errors.rmse;
    paid = *(row->*cost);
  }
}

std::string number(const std::optional<double>& value) {
  return value ? energy::csv_number(*value) : std::string();
}

std::string json_or_null(const std::optional<double>& value) {
  return value ? json_number(*value) : "null";
}

/// The preset of a row whose structure has any.
std::string preset_of(const AccuracyRow& row) {
  const auto* bvh = std::get_if<accel::BvhSettings>(&row.spec.structure.settings);
  const bool any = row.spec.structure.kind == accel::StructureKind::bvh_sah && bvh != nullptr;
  return any ? std::string(accel::to_string(bvh->preset)) : std::string();
}

std::string grouping_of(const AccuracyRow& row) {
  return row.spec.device == Device::cpu ? std::string(accel::to_string(row.spec.structure.grouping))
                                        : std::string();
}

/// The structure, and what of preset and grouping is not the usual.
std::string structure_label(const AccuracyRow& row) {
  std::string label(accel::to_string(row.spec.structure.kind));
  const std::string preset = preset_of(row);
  if (!preset.empty() && preset != "balanced") label += " " + preset;
  if (grouping_of(row) == "single") label += ", single rays";
  return label;
}

/// The cells of a row: name and text as files hold it; `text` says that it is no number.
struct Cell {
  const char* name;
  std::string value;
  bool text = false;
};

std::vector<Cell> cells_of(const AccuracyRow& row) {
  const HitErrors& hits = row.errors.hits;
  return {{"scene", row.spec.scene->name, true},
          {"device", std::string(to_string(row.spec.device)), true},
          {"structure", std::string(accel::to_string(row.spec.structure.kind)), true},
          {"preset", preset_of(row), true},
          {"intersection", std::string(accel::to_string(row.spec.structure.intersection)), true},
          {"grouping", grouping_of(row), true},
          {"rays", ray_list(row.spec.rays), true},
          {"samples", std::to_string(row.spec.rays.samples)},
          {"width", std::to_string(row.spec.size.width)},
          {"height", std::to_string(row.spec.size.height)},
          {"rmse", number(row.errors.rmse)},
          {"largest_difference", number(row.errors.largest)},
          {"camera_rays", std::to_string(hits.rays)},
          {"missed", std::to_string(hits.missed)},
          {"invented", std::to_string(hits.invented)},
          {"wrong_triangle", std::to_string(hits.wrong_triangle)},
          {"largest_relative_t", number(hits.largest_t)},
          {"ms_per_frame", number(row.ms)},
          {"ms_per_frame_ci95", number(row.ms_ci95)},
          {"joules_per_frame", number(row.joules)},
          {"joules_per_frame_ci95", number(row.joules_ci95)},
          {"energy_provenance", std::string(energy::to_string(row.origin)), true},
          {"pareto_time", row.best_by_time ? "1" : "0"},
          {"pareto_energy", row.best_by_energy ? "1" : "0"}};
}

}  // namespace

void mark_pareto_fronts(std::vector<AccuracyRow>& rows) {
  mark(rows, &AccuracyRow::ms, &AccuracyRow::best_by_time);
  mark(rows, &AccuracyRow::joules, &AccuracyRow::best_by_energy);
}

std::string accuracy_label(const AccuracyRow& row) {
  return fmt::format("{}, {}, {}, {} sample{}", structure_label(row), to_string(row.spec.device),
                     accel::to_string(row.spec.structure.intersection), row.spec.rays.samples,
                     row.spec.rays.samples == 1 ? "" : "s");
}

std::string accuracy_table(const std::vector<AccuracyRow>& rows) {
  TextTable table;
  for (const char* title : {"device", "structure", "intersection"}) {
    table.add_column(title, TextTable::Align::left);
  }
  for (const char* title : {"samples", "RMSE", "missed", "invented", "wrong", "largest t error",
                            "ms a frame", "energy a frame", "Pareto"}) {
    table.add_column(title);
  }
  for (const AccuracyRow& row : rows) {
    const HitErrors& hits = row.errors.hits;
    std::string front = row.best_by_time ? "ms" : "";
    if (row.best_by_energy) front += front.empty() ? "J" : ", J";
    table.add_row({std::string(to_string(row.spec.device)), structure_label(row),
                   std::string(accel::to_string(row.spec.structure.intersection)),
                   std::to_string(row.spec.rays.samples), fmt::format("{:.3e}", row.errors.rmse),
                   std::to_string(hits.missed), std::to_string(hits.invented),
                   std::to_string(hits.wrong_triangle),
                   hits.largest_t ? fmt::format("{:.1e}", *hits.largest_t) : "",
                   row.ms ? fmt::format("{:.3f}", *row.ms) : "",
                   row.joules ? joules_text(*row.joules, row.joules_ci95) : "", front});
  }
  return table.text();
}

energy::CsvRecord accuracy_header() {
  energy::CsvRecord header;
  AccuracyRow none;
  none.spec.scene = std::make_shared<scene::Scene>();
  for (const Cell& cell : cells_of(none)) header.emplace_back(cell.name);
  return header;
}

energy::CsvRecord to_record(const AccuracyRow& row) {
  energy::CsvRecord record;
  for (Cell& cell : cells_of(row)) record.push_back(std::move(cell.value));
  return record;
}

std::string accuracy_csv(const std::vector<AccuracyRow>& rows) {
  std::string text;
  const auto add = [&text](const energy::CsvRecord& record) {
    for (std::size_t i = 0; i < record.size(); ++i) {
      text += (i > 0 ? "," : "") + energy::csv_field(record[i]);
    }
    text += '\n';
  };
  add(accuracy_header());
  for (const AccuracyRow& row : rows) add(to_record(row));
  return text;
}

void write_accuracy_csv(const std::filesystem::path& folder, const std::vector<AccuracyRow>& rows) {
  energy::CsvWriter writer(folder / "accuracy.csv", accuracy_header());
  for (const AccuracyRow& row : rows) writer.write(to_record(row));
}

std::string accuracy_json(const std::vector<AccuracyRow>& rows,
                          const std::optional<double>& reference_error) {
  std::string json =
      fmt::format("{{\n  \"reference_rmse\": {},\n  \"results\": [", json_or_null(reference_error));
  const char* separator = "\n    ";
  for (const AccuracyRow& row : rows) {
    json += separator;
    const char* comma = "{";
    for (const Cell& cell : cells_of(row)) {
      const std::string value =
          cell.text ? json_text(cell.value) : (cell.value.empty() ? "null" : cell.value);
      json += fmt::format("{}{}: {}", comma, json_text(cell.name), value);
      comma = ", ";
    }
    json += "}";
    separator = ",\n    ";
  }
  return json + (rows.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

}  // namespace encore::app
