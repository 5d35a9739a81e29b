#include "app/energy_rows.h"

#include "app/session_input.h"
#include "energy/csv.h"

#include <string_view>

namespace encore::app {

namespace {

using energy::Attribution;
using energy::Joules;
using energy::PhaseRow;
using energy::Seconds;
using energy::SummaryRow;
using energy::Uncertain;
using energy::Watts;

/// Puts a figure and its half-width, divided by `count`, into two places.
template <class Unit>
void set(const std::optional<Uncertain>& figure, double count, std::optional<Unit>& value,
         std::optional<Unit>& half_width) {
  if (!figure || !(count > 0)) return;
  value = Unit(figure->value / count);
  half_width = Unit(figure->half_width / count);
}

void set_counter(SummaryRow& row, std::string_view name, double value) {
  for (energy::Counter& counter : row.counters) {
    if (counter.name != name) continue;
    counter.value = value;
    counter.unavailable = false;
  }
}

/// Of the picture; 0 if there is none.
double pixels_of(const std::vector<energy::KeyValue>& configuration) {
  const auto side = [&](std::string_view key) {
    return energy::parse_csv_number(configuration_value(configuration, key)).value_or(0.0);
  };
  return side("width") * side("height");
}

}  // namespace

void add_energy(const Attribution& total, SummaryRow& row) {
  set(total.watts, 1.0, row.watts, row.watts_ci95);
  set(total.per_operation, 1.0, row.joules, row.joules_ci95);
  if (total.watts) row.watts_ci95_without_gain = Watts(total.watts->statistical);
  if (total.per_operation) {
    row.joules_ci95_without_gain = Joules(total.per_operation->statistical);
  }
  set(total.net, total.operations, row.net_joules, row.net_joules_ci95);
  if (total.idle) {
    row.idle_watts = Watts(total.idle->watts.value);
    row.idle_watts_ci95 = Watts(total.idle->watts.half_width);
  }
  if (!row.joules) return;
  const double rays = counter_value(row, "rays_per_operation").value_or(0.0);
  if (rays > 0) {
    set_counter(row, "joules_per_mray", row.joules->value / rays * 1e6);
  }
  if (const double pixels = pixels_of(row.configuration); pixels > 0) {
    set_counter(row, "joules_per_pixel", row.joules->value / pixels);
  }
  set_counter(row, "energy_delay_js", row.joules->value * row.mean.value);
}

std::vector<PhaseRow> phase_rows(const Attribution& attribution, const std::string& source,
                                 energy::Origin origin,
                                 const std::vector<energy::KeyValue>& configuration) {
  std::vector<PhaseRow> rows;
  const double operations = attribution.operations;
  const auto start = [&](std::string phase) -> PhaseRow& {
    PhaseRow row;
    row.configuration = configuration;
    row.source = source;
    row.phase = std::move(phase);
    row.operations = operations;
    rows.push_back(std::move(row));
    return rows.back();
  };
  for (const energy::PhaseEnergy& phase : attribution.phases) {
    PhaseRow& row = start(phase.column);
    row.method = std::string(energy::to_string(phase.method));
    row.seconds = phase.busy;
    set(phase.watts, 1.0, row.watts, row.watts_ci95);
    set(phase.gross, operations, row.joules, row.joules_ci95);
    set(phase.net, operations, row.net_joules, row.net_joules_ci95);
    row.note = phase.reason;
  }
  if (attribution.idle) {
    PhaseRow& row = start("idle");
    row.seconds = attribution.idle->length;
    row.operations.reset();
    set(std::optional(attribution.idle->watts), 1.0, row.watts, row.watts_ci95);
    if (attribution.idle->drifted) row.note = "the idle power drifted";
  }
  if (attribution.remainder) {
    PhaseRow& row = start("remainder");
    set(attribution.remainder, operations, row.joules, row.joules_ci95);
  }
  PhaseRow& all = start("all");
  all.seconds = attribution.length;
  set(attribution.watts, 1.0, all.watts, all.watts_ci95);
  set(attribution.gross, operations, all.joules, all.joules_ci95);
  set(attribution.net, operations, all.net_joules, all.net_joules_ci95);
  for (PhaseRow& row : rows) {
    const bool known = row.watts || row.joules;
    row.origin = known ? origin : energy::Origin::unavailable;
  }
  return rows;
}

}  // namespace encore::app
