#include "energy/session.h"

#include "energy/statistics.h"

namespace encore::energy {

namespace {

std::optional<Seconds> as_seconds(std::optional<double> value) {
  if (!value) return std::nullopt;
  return Seconds(*value);
}

}  // namespace

Seconds FrameRow::total() const {
  Seconds sum;
  for (const std::optional<Seconds>& phase : phases) sum += phase.value_or(Seconds(0));
  return sum;
}

std::string_view to_string(SessionState state) {
  switch (state) {
    case SessionState::running:
      return "running";
    case SessionState::complete:
      return "complete";
    case SessionState::interrupted:
      return "interrupted";
    case SessionState::failed:
      return "failed";
  }
  return "";
}

std::optional<SessionState> parse_session_state(std::string_view word) {
  for (const SessionState state : {SessionState::running, SessionState::complete,
                                   SessionState::interrupted, SessionState::failed}) {
    if (word == to_string(state)) return state;
  }
  return std::nullopt;
}

FrameRow merge(const FrameRow& a, const FrameRow& b) {
  const auto of_a = static_cast<double>(a.operations);
  const auto of_b = static_cast<double>(b.operations);
  FrameRow row = b;
  row.time = a.time;
  row.operations = a.operations + b.operations;
  for (const Phase phase : kPhases) {
    if (!a.phases[phase] && !b.phases[phase]) continue;
    row.phases[phase] = (a.phases[phase].value_or(Seconds(0)) * of_a +
                         b.phases[phase].value_or(Seconds(0)) * of_b) /
                        (of_a + of_b);
  }
  // Energies are in the file, and attribution works on traces: no need to keep them here.
  row.joules = {};
  row.operation_joules.reset();
  row.operation_joules_ci95.reset();
  row.origin = Origin::unavailable;
  return row;
}

SummaryRow summarise(const std::vector<FrameRow>& rows, const PerPhase<std::uint64_t>& counts) {
  SummaryRow summary;
  summary.configuration = rows.back().configuration;
  summary.phase_counts = counts;

  // Add up what each phase took, row by row weighted with its operations.
  std::vector<double> times;
  std::vector<double> weights;
  PerPhase<double> phase_seconds{};
  for (const FrameRow& row : rows) {
    const auto weight = static_cast<double>(row.operations);
    summary.operations += row.operations;
    summary.seconds += row.total() * weight;
    for (const Phase phase : kPhases) {
      phase_seconds[phase] += row.phases[phase].value_or(Seconds(0)).value * weight;
    }
    times.push_back(row.total().value);
    weights.push_back(weight);
  }

  const Estimate estimate = estimate_mean(times, weights);
  summary.mean = Seconds(estimate.mean);
  summary.ci95 = as_seconds(estimate.ci95_half_width);
  summary.effective_rows = estimate.effective_samples;
  summary.median = as_seconds(median(times));
  summary.percentile95 = as_seconds(percentile(times, 0.95));
  for (const Phase phase : kPhases) {
    if (counts[phase] > 0 && summary.seconds.value > 0) {
      summary.shares[phase] = phase_seconds[phase] / summary.seconds.value;
    }
  }
  return summary;
}

}  // namespace encore::energy
