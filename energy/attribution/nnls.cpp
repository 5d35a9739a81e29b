#include "energy/attribution/nnls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace encore::energy {

namespace {

/// Least squares over the marked columns alone; 0 elsewhere.
std::vector<double> solve_marked(const Triangle& t, const std::vector<bool>& marked) {
  const Triangle part = triangularise(t.r.select(marked), t.y);
  DenseMatrix r = part.r;
  // A column that the ones before it explain to rounding has no coefficient of its own.
  for (std::size_t i = 0; i < r.columns(); ++i) {
    if (std::fabs(r(i, i)) <= 64 * std::numeric_limits<double>::epsilon() * norm(r.column(i))) {
      r(i, i) = 0.0;
    }
  }
  const std::vector<double> found = solve_upper(r, part.y);
  std::vector<double> x(marked.size(), 0.0);
  std::size_t next = 0;
  for (std::size_t c = 0; c < marked.size(); ++c) {
    if (marked[c]) x[c] = found[next++];
  }
  return x;
}

/// How the squared residual would fall (half its slope) if each coefficient grew.
std::vector<double> slopes(const Triangle& t, const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::vector<double> off = t.y;
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t r = 0; r <= c; ++r) off[r] -= t.r(r, c) * x[c];
  }
  std::vector<double> slope(n, 0.0);
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t r = 0; r <= c; ++r) slope[c] += t.r(r, c) * off[r];
  }
  return slope;
}

/// Walks from x towards `wanted` until a bounded coefficient meets 0, and takes that one (and those
/// with it) out of the passive set.
void step_to_bound(std::vector<double>& x, const std::vector<double>& wanted,
                   const std::vector<bool>& is_free, std::vector<bool>& passive) {
  const auto falls = [&](std::size_t c) { return passive[c] && !is_free[c] && wanted[c] <= 0.0; };
  const auto room = [&](std::size_t c) { return x[c] > 0.0 ? x[c] / (x[c] - wanted[c]) : 0.0; };
  double part = 1.0;
  for (std::size_t c = 0; c < x.size(); ++c) {
    if (falls(c)) part = std::min(part, room(c));
  }
  for (std::size_t c = 0; c < x.size(); ++c) {
    const bool blocks = falls(c) && room(c) <= part;
    x[c] = blocks ? 0.0 : x[c] + part * (wanted[c] - x[c]);
    if (blocks) passive[c] = false;
  }
}

class ActiveSet {
 public:
  ActiveSet(const Triangle& t, const std::vector<bool>& is_free)
      : t_(t), free_(is_free), passive_(is_free), x_(solve_marked(t, is_free)) {}

  void run(NnlsFit& fit) {
    const std::size_t n = x_.size();
    const double tolerance = 1e-14 * (norm(t_.y) + std::numeric_limits<double>::min());
    std::vector<bool> barred(n, false);
    std::size_t steps = 0;
    while (true) {
      if (++steps > 20 * (n + 1)) {
        fit.converged = false;
        break;
      }
      const std::vector<double> slope = slopes(t_, x_);
      std::size_t best = n;
      for (std::size_t c = 0; c < n; ++c) {
        if (passive_[c] || barred[c] || slope[c] <= tolerance) continue;
        if (best == n || slope[c] > slope[best]) best = c;
      }
      if (best == n) break;
      if (enter(best)) {
        barred.assign(n, false);
      } else {
        barred[best] = true;
      }
    }
    fit.x = x_;
    fit.at_bound.resize(n);
    for (std::size_t c = 0; c < n; ++c) fit.at_bound[c] = !passive_[c];
  }

 private:
  /// Lets a coefficient leave 0. False if rounding alone made it look worth while.
  bool enter(std::size_t column) {
    passive_[column] = true;
    std::vector<double> wanted = solve_marked(t_, passive_);
    if (wanted[column] <= 0.0) {
      passive_[column] = false;
      return false;
    }
    const auto feasible = [&] {
      for (std::size_t c = 0; c < x_.size(); ++c) {
        if (passive_[c] && !free_[c] && wanted[c] <= 0.0) return false;
      }
      return true;
    };
    while (!feasible()) {
      step_to_bound(x_, wanted, free_, passive_);
      wanted = solve_marked(t_, passive_);
    }
    x_ = wanted;
    return true;
  }

  const Triangle& t_;
  const std::vector<bool>& free_;
  std::vector<bool> passive_;
  std::vector<double> x_;
};

}  // namespace

NnlsFit solve_nnls(const DenseMatrix& a, std::span<const double> b, const std::vector<bool>& free) {
  const std::size_t n = a.columns();
  std::vector<bool> is_free = free;
  is_free.resize(n, false);
  // Columns of length 1: a phase of microseconds counts like hours of idle.
  DenseMatrix scaled = a;
  std::vector<double> scale(n, 1.0);
  for (std::size_t c = 0; c < n; ++c) {
    const double length = norm(a.column(c));
    if (length > 0.0) scale[c] = length;
    for (double& v : scaled.column(c)) v /= scale[c];
  }
  const Triangle triangle = triangularise(std::move(scaled), {b.begin(), b.end()});
  NnlsFit fit;
  ActiveSet(triangle, is_free).run(fit);

  std::vector<double> off = triangle.y;
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t r = 0; r <= c; ++r) off[r] -= triangle.r(r, c) * fit.x[c];
  }
  fit.residual_norm = std::hypot(norm(off), triangle.rest);
  for (std::size_t c = 0; c < n; ++c) fit.x[c] /= scale[c];
  return fit;
}

}  // namespace encore::energy
