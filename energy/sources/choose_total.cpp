#include "energy/sources/choose_total.h"

#include <algorithm>

namespace encore::energy {

namespace {

using Sources = std::vector<SourceInfo>;
using Choice = std::vector<std::size_t>;

/// Whether all that b sees is seen by a.
bool sees_all_of(const SourceInfo& a, const SourceInfo& b) {
  if (!holds(a.domain, b.domain)) return false;
  // Cores and integrated GPUs of another socket are not in this package. All other outer domains
  // are numbered differently from what they hold, if at all: they count as holding it.
  const bool sockets = a.domain == Domain::package && !a.unit.empty() && !b.unit.empty();
  return !sockets || a.unit == b.unit;
}

bool overlap(const SourceInfo& a, const SourceInfo& b) {
  return (a.domain == b.domain && a.unit == b.unit) || sees_all_of(a, b) || sees_all_of(b, a);
}

/// Adds a source unless something that was chosen before it counts the same joules.
void add(const Sources& sources, std::size_t index, Choice& chosen) {
  for (const std::size_t other : chosen) {
    if (overlap(sources[other], sources[index])) return;
  }
  chosen.push_back(index);
}

template <class Wanted>
Choice add_all(const Sources& sources, const Choice& candidates, const Wanted& wanted) {
  Choice chosen;
  for (const std::size_t index : candidates) {
    if (wanted(sources[index])) add(sources, index, chosen);
  }
  return chosen;
}

/// The best of these sources, in the order of choose_total's contract.
Choice choose_among(const Sources& sources, const Choice& candidates) {
  Choice parts = add_all(sources, candidates, [](const SourceInfo& s) {
    return s.is_counter &&
           (s.domain == Domain::package || s.domain == Domain::memory || s.domain == Domain::gpu);
  });
  // Without a processor, memory or GPU alone are no total of anything.
  const bool has_package = std::any_of(parts.begin(), parts.end(), [&](std::size_t i) {
    return sources[i].domain == Domain::package;
  });
  if (has_package) return parts;

  Choice meters = add_all(sources, candidates, [](const SourceInfo& s) {
    return s.kind == SourceKind::meter || s.kind == SourceKind::replay;
  });
  // Two meters may hang one behind the other.
  if (!meters.empty()) return {meters.front()};

  Choice batteries = add_all(sources, candidates,
                             [](const SourceInfo& s) { return s.kind == SourceKind::battery; });
  if (!batteries.empty()) return batteries;
  return add_all(sources, candidates, [](const SourceInfo&) { return true; });
}

}  // namespace

std::vector<std::size_t> choose_total(const std::vector<SourceInfo>& sources) {
  Choice real;
  Choice invented;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const SourceKind kind = sources[i].kind;
    const bool is_real = kind != SourceKind::model && kind != SourceKind::simulated;
    (is_real ? real : invented).push_back(i);
  }
  Choice chosen = choose_among(sources, real.empty() ? invented : real);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace encore::energy
