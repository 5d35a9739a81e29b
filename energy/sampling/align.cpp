#include "energy/sampling/align.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace encore::energy {

namespace {

constexpr std::size_t kCoarseSteps = 4096;
constexpr std::size_t kFineSteps = 200000;
constexpr Seconds kFinestStep(0.001);
/// Another shift is as good if it leaves less than this many times as much unexplained.
constexpr double kClearlyWorse = 1.5;
/// No real recording is explained better than this, whatever the numbers say.
constexpr double kLeastUnexplained = 0.005;

/// Both loads at one step width. Offsets are whole steps from `base`.
struct Pair {
  LoadSignal reference;
  LoadSignal recording;
  [[nodiscard]] Seconds offset_of(double lag) const {
    return reference.start - recording.start + reference.step * lag;
  }
  [[nodiscard]] double lag_of(Seconds offset) const {
    return (offset - (reference.start - recording.start)) / reference.step;
  }
};
using MakePair = std::function<Pair(Seconds step)>;

/// How the recording, moved by `lag` steps, fits.
struct Fit {
  std::ptrdiff_t lag = 0;
  double correlation = -1.0;  ///< -1 where it cannot be told
  std::size_t count = 0;      ///< steps that both know
  double slope = 0.0;         ///< of the recording over the reference
  double level = 0.0;
  [[nodiscard]] double unexplained() const {
    return correlation > 0 ? 1.0 - correlation * correlation : 1.0;
  }
};

Fit fit_at(const Pair& pair, std::ptrdiff_t lag, std::size_t least_count) {
  const auto n = static_cast<std::ptrdiff_t>(pair.reference.values.size());
  const auto m = static_cast<std::ptrdiff_t>(pair.recording.values.size());
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, -lag);
  const std::ptrdiff_t end = std::min(m, n - lag);
  Fit fit;
  fit.lag = lag;
  if (end - begin < static_cast<std::ptrdiff_t>(least_count)) return fit;
  const double* x = pair.reference.values.data() + lag;
  const double* y = pair.recording.values.data();
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double syy = 0;
  double sxy = 0;
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    if (std::isnan(x[i]) || std::isnan(y[i])) continue;
    ++fit.count;
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    syy += y[i] * y[i];
    sxy += x[i] * y[i];
  }
  if (fit.count < least_count) return fit;
  const double count = static_cast<double>(fit.count);
  const double vx = sxx - sx * sx / count;
  const double vy = syy - sy * sy / count;
  // A flat stretch fits to anything.
  if (vx <= 1e-9 * sxx || vy <= 1e-9 * syy) return fit;
  const double cov = sxy - sx * sy / count;
  fit.correlation = cov / std::sqrt(vx * vy);
  fit.slope = cov / vx;
  fit.level = (sy - fit.slope * sx) / count;
  return fit;
}

std::vector<Fit> fit_all(const Pair& pair, std::ptrdiff_t first, std::ptrdiff_t last,
                         std::size_t least_count) {
  std::vector<Fit> fits;
  for (std::ptrdiff_t lag = first; lag <= last; ++lag) {
    fits.push_back(fit_at(pair, lag, least_count));
  }
  return fits;
}

std::size_t best_of(const std::vector<Fit>& fits) {
  const auto less = [](const Fit& a, const Fit& b) { return a.correlation < b.correlation; };
  return static_cast<std::size_t>(std::max_element(fits.begin(), fits.end(), less) - fits.begin());
}

/// The best fit beyond the slopes of the peak at `best` that is about as good; nothing if none is.
std::optional<Fit> rival_of(const std::vector<Fit>& fits, std::size_t best) {
  const double limit = kClearlyWorse * std::max(kLeastUnexplained, fits[best].unexplained());
  std::size_t left = best;
  std::size_t right = best;
  while (left > 0 && fits[left].unexplained() < limit) --left;
  while (right + 1 < fits.size() && fits[right].unexplained() < limit) ++right;
  std::optional<Fit> rival;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (i >= left && i <= right) continue;
    if (fits[i].unexplained() >= limit) continue;
    if (!rival || fits[i].correlation > rival->correlation) rival = fits[i];
  }
  return rival;
}

/// How many of the steps are independent, by the correlation of neighbouring residuals.
double effective_count(const Pair& pair, const Fit& fit) {
  double product = 0;
  double square = 0;
  std::optional<double> last;
  const auto n = static_cast<std::ptrdiff_t>(pair.reference.values.size());
  const auto m = static_cast<std::ptrdiff_t>(pair.recording.values.size());
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -fit.lag); i < std::min(m, n - fit.lag);
       ++i) {
    const double x = pair.reference.values[static_cast<std::size_t>(i + fit.lag)];
    const double residual =
        pair.recording.values[static_cast<std::size_t>(i)] - fit.level - fit.slope * x;
    if (std::isnan(residual)) {
      last.reset();
      continue;
    }
    square += residual * residual;
    if (last) product += residual * *last;
    last = residual;
  }
  const double rho = square > 0 ? std::clamp(product / square, 0.0, 0.99) : 0.0;
  return std::max(1.0, static_cast<double>(fit.count) * (1 - rho) / (1 + rho));
}

/// The top of the peak between steps, and its standard uncertainty from noise, in steps.
struct Top {
  double lag = 0.0;
  double deviation = 0.0;
};
Top top_of(const Pair& pair, const std::vector<Fit>& fits, std::size_t best) {
  Top top{static_cast<double>(fits[best].lag), 0.5};
  if (best == 0 || best + 1 == fits.size()) return top;
  const double here = fits[best].unexplained();
  const double before = fits[best - 1].unexplained();
  const double after = fits[best + 1].unexplained();
  const double curvature = before - 2 * here + after;
  if (!(curvature > 0)) return top;
  top.lag += std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
  // A shift by one deviation leaves one residual variance more unexplained.
  top.deviation = std::sqrt(2 * here / (effective_count(pair, fits[best]) * curvature));
  return top;
}

std::string too_short() {
  return "the recording and the session do not overlap enough to be aligned; record the whole run";
}

AlignmentResult refused(std::string reason) {
  return {std::nullopt, std::move(reason)};
}

/// The lags that the settings leave, in whole steps.
std::pair<std::ptrdiff_t, std::ptrdiff_t> lag_range(const Pair& pair,
                                                    const AlignmentSettings& settings) {
  auto first = 1 - static_cast<std::ptrdiff_t>(pair.recording.values.size());
  auto last = static_cast<std::ptrdiff_t>(pair.reference.values.size()) - 1;
  if (settings.near) {
    const auto bound = [&](Seconds offset) {
      return static_cast<std::ptrdiff_t>(std::clamp(std::round(pair.lag_of(offset)), -1e15, 1e15));
    };
    first = std::max(first, bound(*settings.near - settings.range));
    last = std::min(last, bound(*settings.near + settings.range));
  }
  return {first, last};
}

std::size_t least_count_of(const Pair& pair, const AlignmentSettings& settings) {
  constexpr std::size_t kLeast = 8;
  const std::size_t shorter = std::min(pair.reference.values.size(), pair.recording.values.size());
  const double share = settings.least_overlap * static_cast<double>(shorter);
  return std::max(kLeast, static_cast<std::size_t>(share));
}

/// `fine`: the finest step that makes sense; `length`: of the longer of the two; `sampling`: the
/// wider of their sample distances.
AlignmentResult align_pairs(const MakePair& make, Seconds fine, Seconds length, Seconds sampling,
                            const AlignmentSettings& settings) {
  const Seconds coarse = std::max(fine, length / static_cast<double>(kCoarseSteps));
  Pair pair = make(coarse);
  std::size_t least_count = least_count_of(pair, settings);
  const auto [first, last] = lag_range(pair, settings);
  std::vector<Fit> fits = fit_all(pair, first, last, least_count);
  const bool overlaps = std::any_of(fits.begin(), fits.end(),
                                    [&](const Fit& fit) { return fit.count >= least_count; });
  if (!overlaps) return refused(too_short());
  std::size_t best = best_of(fits);
  const auto rival = rival_of(fits, best);
  const Fit coarse_best = fits[best];

  if (coarse > fine) {
    const double centre = static_cast<double>(coarse_best.lag) * (coarse / fine);
    const double reach = 2 * std::ceil(coarse / fine);
    pair = make(fine);
    least_count = std::min(
        least_count_of(pair, settings),
        static_cast<std::size_t>(static_cast<double>(coarse_best.count) * 0.9 * (coarse / fine)));
    fits = fit_all(pair, static_cast<std::ptrdiff_t>(std::floor(centre - reach)),
                   static_cast<std::ptrdiff_t>(std::ceil(centre + reach)), least_count);
    best = best_of(fits);
  }

  const Fit& found = fits[best];
  if (!(found.correlation >= settings.least_correlation)) {
    return refused(fmt::format(
        "the recording shows no steps of load like the session's (best correlation {:.2f}, {:.2f} "
        "is needed); is it of this run?",
        std::max(0.0, found.correlation), settings.least_correlation));
  }
  if (rival) {
    return refused(fmt::format(
        "a shift by {:+.3f} s fits about as well as the best one (correlation {:.3f} and {:.3f}): "
        "the load repeats itself; give the offset roughly, or pause for irregular times",
        (pair.offset_of(0) + coarse * static_cast<double>(rival->lag) -
         pair.offset_of(static_cast<double>(found.lag)))
            .value,
        rival->correlation, coarse_best.correlation));
  }
  const Top top = top_of(pair, fits, best);
  const double noise = top.deviation * fine.value;
  // Where within a sample an edge fell cannot be seen.
  const double edge = sampling.value / std::sqrt(12.0);
  Alignment alignment;
  alignment.offset = pair.offset_of(top.lag);
  alignment.uncertainty = Seconds(std::hypot(noise, edge));
  alignment.correlation = found.correlation;
  alignment.overlap = fine * static_cast<double>(found.count);
  return {alignment, {}};
}

Seconds length_of(const TraceView& trace) {
  return trace.points().back().time - trace.points().front().time;
}

Seconds finest_step(Seconds sampling, Seconds length) {
  return std::max({sampling / 2, kFinestStep, length / static_cast<double>(kFineSteps)});
}

}  // namespace

AlignmentResult align(const TraceView& reference, const TraceView& recording,
                      const AlignmentSettings& settings) {
  if (reference.points().size() < 2 || recording.points().size() < 2) return refused(too_short());
  const Seconds sampling = std::max(spacing_of(reference), spacing_of(recording));
  const Seconds length = std::max(length_of(reference), length_of(recording));
  const MakePair make = [&](Seconds step) {
    return Pair{load_of(reference, step), load_of(recording, step)};
  };
  return align_pairs(make, finest_step(sampling, length), length, sampling, settings);
}

AlignmentResult align(std::span<const PhaseSpan> busy, Seconds from, Seconds to,
                      const TraceView& recording, const AlignmentSettings& settings) {
  if (recording.points().size() < 2 || !(to > from)) return refused(too_short());
  const Seconds sampling = spacing_of(recording);
  const Seconds length = std::max(to - from, length_of(recording));
  const MakePair make = [&](Seconds step) {
    return Pair{load_of(busy, from, to, step), load_of(recording, step)};
  };
  return align_pairs(make, finest_step(sampling, length), length, sampling, settings);
}

}  // namespace encore::energy
