#include "energy/attribution/activity.h"

#include "energy/sampling/low_pass.h"

#include <algorithm>

namespace encore::energy {

std::vector<double> busy_between(const Activity& activity, std::span<const double> edges) {
  std::vector<double> sums;
  if (edges.size() < 2) return sums;
  sums.reserve(edges.size() - 1);
  std::size_t next = 0;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    double sum = 0.0;
    while (next < activity.size() && activity[next].end.value <= edges[i - 1]) ++next;
    for (std::size_t p = next; p < activity.size() && activity[p].start.value < edges[i]; ++p) {
      const double from = std::max(activity[p].start.value, edges[i - 1]);
      const double to = std::min(activity[p].end.value, edges[i]);
      sum += std::max(0.0, to - from) * activity[p].share;
    }
    sums.push_back(sum);
  }
  return sums;
}

std::vector<double> smoothed_share(const Activity& activity, double tau,
                                   std::span<const double> times) {
  std::vector<double> shares;
  shares.reserve(times.size());
  double shown = 0.0;
  double now = activity.empty() ? 0.0 : activity.front().start.value;
  const auto advance = [&](double to, double share) {
    if (to <= now) return;
    shown = low_pass_step(shown, share, to - now, tau);
    now = to;
  };
  std::size_t next = 0;
  for (const double time : times) {
    for (; next < activity.size() && activity[next].end.value <= time; ++next) {
      advance(activity[next].start.value, 0.0);
      advance(activity[next].end.value, activity[next].share);
    }
    if (next < activity.size() && activity[next].start.value < time) {
      advance(activity[next].start.value, 0.0);
      advance(time, activity[next].share);
    } else if (!activity.empty()) {
      advance(time, 0.0);
    }
    shares.push_back(shown);
  }
  return shares;
}

Activity concurrent(const Activity& a, const Activity& b) {
  Activity both;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const Seconds start = std::max(a[i].start, b[j].start);
    const Seconds end = std::min(a[i].end, b[j].end);
    const double share = a[i].share + b[j].share - 1.0;
    // Not a sliver that rounding made of two whole shares.
    if (end > start && share > 1e-9) both.push_back({start, end, share});
    (a[i].end < b[j].end ? i : j) += 1;
  }
  return both;
}

}  // namespace encore::energy
