#include "energy/attribution/attribution.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::energy {

namespace {

/// Chance errors of different sensors have nothing to do with each other. Their gains may: sensors
/// of one make err alike, so these parts add up in full.
Uncertain sum(const Uncertain& a, const Uncertain& b) {
  const auto gain_part = [](const Uncertain& u) {
    const double square = u.half_width * u.half_width - u.statistical * u.statistical;
    return std::sqrt(std::max(0.0, square));
  };
  const double statistical = std::hypot(a.statistical, b.statistical);
  return {a.value + b.value, std::hypot(statistical, gain_part(a) + gain_part(b)), statistical};
}

/// A sum is known only if both parts are.
void accumulate(std::optional<Uncertain>& total, const std::optional<Uncertain>& part) {
  if (total && part) {
    total = sum(*total, *part);
  } else {
    total.reset();
  }
}

/// The method that carries the least: what a sum of two differently found figures rests on.
AttributionMethod weaker(AttributionMethod a, AttributionMethod b) {
  return static_cast<AttributionMethod>(std::max(static_cast<int>(a), static_cast<int>(b)));
}

void accumulate(PhaseEnergy& total, const PhaseEnergy& part) {
  accumulate(total.watts, part.watts);
  accumulate(total.gross, part.gross);
  accumulate(total.net, part.net);
  total.method = weaker(total.method, part.method);
  total.upper_bound_only = total.upper_bound_only && part.upper_bound_only;
  if (total.reason.empty()) total.reason = part.reason;
}

void accumulate(std::optional<IdleBaseline>& total, const std::optional<IdleBaseline>& part) {
  if (!total || !part) {
    total.reset();
    return;
  }
  total->watts = sum(total->watts, part->watts);
  accumulate(total->drift, part->drift);
  total->drifted = total->drifted || part->drifted;
}

}  // namespace

Attribution add(const std::vector<Attribution>& parts) {
  if (parts.empty()) return {};
  Attribution total = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const Attribution& part = parts[i];
    accumulate(total.watts, part.watts);
    accumulate(total.gross, part.gross);
    accumulate(total.net, part.net);
    accumulate(total.per_operation, part.per_operation);
    accumulate(total.idle, part.idle);
    accumulate(total.remainder, part.remainder);
    total.effective_samples = std::min(total.effective_samples, part.effective_samples);
    if (part.condition) {
      total.condition = std::max(total.condition.value_or(0.0), *part.condition);
    }
    for (PhaseEnergy& phase : total.phases) {
      const auto same =
          std::find_if(part.phases.begin(), part.phases.end(),
                       [&](const PhaseEnergy& p) { return p.column == phase.column; });
      accumulate(phase, same != part.phases.end() ? *same : PhaseEnergy{});
    }
    for (const std::string& note : part.notes) {
      const bool known =
          std::find(total.notes.begin(), total.notes.end(), note) != total.notes.end();
      if (!known) total.notes.push_back(note);
    }
  }
  return total;
}

}  // namespace encore::energy
