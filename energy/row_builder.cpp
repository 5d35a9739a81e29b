#include "energy/row_builder.h"

#include <cmath>

namespace encore::energy {

namespace {

/// A shorter row would tell more of the sensor's beat than of the power.
constexpr double kLeastPeriods = 2.0;

/// The origin of a sum: the least certain of its parts.
Origin origin_of(const Sampler& sampler, const std::vector<std::size_t>& total) {
  Origin worst = Origin::measured;
  for (const std::size_t source : total) {
    worst = std::max(worst, sampler.info(source).provenance.origin);
  }
  return worst;
}

}  // namespace

void RowBuilder::start(Seconds expected) {
  if (context_.sampler != nullptr) context_.sampler->read_now(expected / kLeastPeriods);
  start_ = end_ = context_.clock.now();
}

std::optional<Joules> RowBuilder::total_energy(Seconds from, Seconds to) const {
  Joules sum;
  for (const std::size_t source : context_.total) {
    const auto energy = context_.sampler->trace(source).view(from, to).energy_between(from, to);
    if (!energy) return std::nullopt;
    sum += *energy;
  }
  return sum;
}

void RowBuilder::add(std::span<const PhaseSpan> spans, const PhaseProbe& edges,
                     PerPhase<std::uint64_t>& counts) {
  ++operations_;
  for (const PhaseSpan& span : spans) {
    ++counts[span.phase];
    seconds_[span.phase] = seconds_[span.phase].value_or(Seconds(0)) + (span.end - span.start);
    end_ = span.end;
    std::optional<Joules> energy;
    if (edges.reads_edges(span.phase, context_.total)) energy = total_energy(span.start, span.end);
    if (energy) joules_[span.phase] = joules_[span.phase].value_or(Joules(0)) + *energy;
    unknown_[span.phase] = unknown_[span.phase] || !energy;
  }
}

void RowBuilder::add_energy(FrameRow& row) const {
  if (context_.sampler == nullptr || context_.total.empty()) return;
  const Seconds length = end_ - start_;
  double variance = 0.0;
  std::size_t slow = 0;
  for (const std::size_t source : context_.total) {
    if (context_.sampler->info(source).update_period * kLeastPeriods > length) ++slow;
  }
  if (slow > 0) return;
  context_.sampler->read_now(length / kLeastPeriods);
  const auto energy = total_energy(start_, end_);
  if (!energy) return;

  // Both edges of the row fall anywhere within an update: the error is triangular.
  for (const std::size_t source : context_.total) {
    const auto part =
        context_.sampler->trace(source).view(start_, end_).energy_between(start_, end_);
    const double edge = (*part / length).value * context_.sampler->info(source).update_period.value;
    variance += edge * edge / 6.0;
  }
  const auto count = static_cast<double>(operations_);
  row.operation_joules = *energy / count;
  row.operation_joules_ci95 = Joules(1.96 * std::sqrt(variance) / count);
  row.origin = origin_of(*context_.sampler, context_.total);

  std::size_t kinds = 0;
  for (const Phase phase : kPhases) kinds += seconds_[phase] ? 1 : 0;
  for (const Phase phase : kPhases) {
    if (!seconds_[phase]) continue;
    if (joules_[phase] && !unknown_[phase]) {
      row.joules[phase] = *joules_[phase] / count;
    } else if (kinds == 1) {
      row.joules[phase] = *energy / length * *seconds_[phase] / count;
    }
  }
}

FrameRow RowBuilder::take(const Workload& workload) {
  FrameRow row;
  row.time = start_ - context_.session_start;
  row.configuration = workload.configuration();
  row.operations = operations_;
  for (const Phase phase : kPhases) {
    if (seconds_[phase]) row.phases[phase] = *seconds_[phase] / static_cast<double>(operations_);
  }
  add_energy(row);
  operations_ = 0;
  seconds_ = {};
  joules_ = {};
  unknown_ = {};
  return row;
}

}  // namespace encore::energy
