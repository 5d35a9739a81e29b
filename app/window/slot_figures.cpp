#include "app/window/slot_figures.h"

#include "app/energy_rows.h"
#include "app/session_input.h"
#include "app/workloads.h"
#include "energy/attribution/attribution.h"

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

using energy::Attribution;
using energy::Phase;

/// Why there can be no energy, before any sensor is asked; empty if there may be.
std::string reason_without(const SlotEvidence& evidence) {
  if (!evidence.power) return "the power sources are still being opened";
  if (!evidence.power->sampler || evidence.power->total.empty()) {
    return evidence.power->provenance.detail;
  }
  if (!evidence.measured.empty()) return {};
  if (evidence.overlapped) {
    return "both devices worked at once, so their joules cannot be told apart; measure mode lets "
           "them take turns";
  }
  return "it was measured before these power sources were picked; measure it again";
}

std::string first_reason(const LiveFigures& figures) {
  return figures.notes.empty() ? "the sensor has told too little so far" : figures.notes.front();
}

}  // namespace

namespace {

/// What the rays of a kind came to: "<kind>_rays" and "<kind>_ms"; "<kind>_joules" only has its
/// place.
void set_ray_counter(const Slot& slot, double render_s, energy::Counter& counter) {
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    const std::string kind(scene::to_string(static_cast<scene::RayKind>(i)));
    const Slot::Kind& rays = slot.kinds[i];
    const bool traced = rays.rays.value_or(0.0) > 0.0;
    if (counter.name == kind + "_rays") counter.value = rays.rays;
    if (counter.name == kind + "_ms") {
      counter.unavailable = traced && !rays.share;
      if (traced && rays.share) counter.value = *rays.share * render_s * 1e3;
    }
    if (counter.name == kind + "_joules") counter.unavailable = traced;
  }
}

}  // namespace

std::vector<energy::Counter> summary_counters(const Slot& slot, const energy::SummaryRow& summary) {
  std::vector<energy::Counter> counters;
  const double share = summary.shares[Phase::render].value_or(0.0);
  const double render = summary.mean.value * share;
  const bool picture = !configuration_value(slot.configuration, "width").empty();
  for (std::string& name : counter_columns()) {
    const auto given = std::find_if(slot.counters.begin(), slot.counters.end(),
                                    [&](const energy::Counter& one) { return one.name == name; });
    energy::Counter counter{std::move(name), std::nullopt};
    if (given != slot.counters.end()) counter = *given;
    if (counter.name == "rays_per_operation") counter.value = slot.rays;
    if (counter.name == "mrays_per_s" && slot.rays && render > 0) {
      counter.value = *slot.rays / render / 1e6;
    }
    // Known once the energy is (add_energy).
    if (counter.name == "joules_per_mray") counter.unavailable = slot.rays.has_value();
    if (counter.name == "joules_per_pixel") counter.unavailable = picture;
    if (counter.name == "energy_delay_js") counter.unavailable = true;
    set_ray_counter(slot, render, counter);
    counters.push_back(std::move(counter));
  }
  return counters;
}

void attribute_sources(const std::vector<energy::SessionSource>& sources,
                       const std::vector<energy::TraceView>& traces,
                       const energy::BusyTimeline& busy,
                       const std::vector<energy::Window>& measured,
                       const std::vector<energy::Window>& idle,
                       const energy::Provenance& provenance, LiveFigures& figures) {
  std::vector<Attribution> parts;
  std::string names;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    energy::AttributionInput input;
    input.source = &sources[i].info;
    input.trace = traces[i];
    input.busy = &busy;
    input.measured = measured;
    input.idle = idle;
    Attribution attribution = energy::attribute(input);
    for (energy::PhaseRow& row :
         phase_rows(attribution, sources[i].info.name, sources[i].info.provenance.origin,
                    figures.configuration)) {
      figures.source_phases.push_back(std::move(row));
    }
    if (!sources[i].in_total) continue;
    names += (names.empty() ? "" : " + ") + sources[i].info.name;
    parts.push_back(std::move(attribution));
  }
  if (parts.empty()) return;
  const Attribution total = energy::add(parts);
  add_energy(total, figures.summary);
  figures.summary.source = names;
  if (figures.summary.watts) figures.summary.origin = provenance.origin;
  figures.phases = phase_rows(total, "total", provenance.origin, figures.configuration);
  figures.notes.insert(figures.notes.end(), total.notes.begin(), total.notes.end());
  figures.energy = provenance;
  if (!figures.summary.joules) {
    figures.energy = {energy::Origin::unavailable, first_reason(figures)};
  }
}

LiveFigures figures_of(const SlotEvidence& evidence, energy::Seconds now) {
  LiveFigures figures;
  figures.configuration = evidence.slot.configuration;
  figures.name = configuration_name(figures.configuration);
  figures.slots = evidence.slots;
  figures.summary = energy::summarise(evidence.rows, evidence.counts);
  figures.summary.configuration = figures.configuration;
  figures.summary.counters = summary_counters(evidence.slot, figures.summary);
  figures.mrays_per_s = counter_value(figures.summary, "mrays_per_s");
  figures.energy = {energy::Origin::unavailable, reason_without(evidence)};
  if (!figures.energy.detail.empty()) return figures;

  const PowerSet& power = *evidence.power;
  energy::Seconds from = evidence.measured.front().from;
  if (!evidence.idle.empty()) from = std::min(from, evidence.idle.front().from);
  std::vector<energy::TraceView> traces;
  for (std::size_t i = 0; i < power.sources.size(); ++i) {
    traces.push_back(power.sampler->trace(i).view(from, now));
  }
  attribute_sources(power.sources, traces, evidence.busy, evidence.measured, evidence.idle,
                    power.provenance, figures);
  if (evidence.overlapped) {
    figures.notes.emplace_back(
        "slots in which both devices worked at once are left out of the energy");
  }
  return figures;
}

}  // namespace encore::app
