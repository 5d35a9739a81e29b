#include "energy/attribution/coloured_fit.h"

#include "energy/attribution/nnls.h"
#include "energy/student_t.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace encore::energy {

namespace {

/// The guesses that are tried first.
std::vector<Shade> still_grid(Colour colour, std::size_t rows) {
  std::vector<Shade> shades;
  if (colour == Colour::autoregressive) {
    for (const double left : {0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.85, 0.92, 0.97}) {
      shades.push_back({.share = left});
    }
    return shades;
  }
  shades.push_back({});
  // Steps of the ratio's root: from what can just be told from 0 in so many rows.
  const double least = 2.0 / static_cast<double>(rows);
  for (double root = least; root < 64.0; root *= 2.0) {
    shades.push_back({.share = root * root / (1.0 + root * root)});
  }
  shades.push_back({.share = 1.0});
  return shades;
}

/// Guesses with power that changes slowly; together as likely as the `still` ones without, before
/// anything is seen.
std::vector<Shade> swinging_grid(const std::vector<double>& shares,
                                 const std::vector<double>& swings, std::size_t still) {
  std::vector<Shade> shades;
  for (const double share : shares) {
    for (const double memory : {4.0, 16.0, 64.0}) {
      for (const double swing : swings) {
        shades.push_back({.share = share, .swing = swing, .memory = memory});
      }
    }
  }
  for (Shade& shade : shades) {
    shade.prior = static_cast<double>(still) / static_cast<double>(shades.size());
  }
  return shades;
}

/// Ordinary least squares on whitened rows.
struct Solved {
  std::vector<double> x;
  DenseMatrix inverse;  ///< of the triangle
  double residual_squares = 0.0;
  double restricted = 0.0;  ///< log likelihood with the coefficients integrated out
  double profile = 0.0;     ///< log likelihood at the best coefficients
};

std::optional<Solved> solve(const White& white) {
  const std::size_t n = white.values.size();
  const std::size_t k = white.columns.columns();
  if (n <= k) return std::nullopt;
  const Triangle triangle = triangularise(white.columns, white.values);
  Solved solved;
  double log_columns = 0.0;
  for (std::size_t c = 0; c < k; ++c) {
    const double left = std::fabs(triangle.r(c, c));
    if (!(left > 1e-10 * norm(triangle.r.column(c)))) return std::nullopt;
    log_columns += std::log(left);
  }
  solved.x = solve_upper(triangle.r, triangle.y);
  solved.inverse = invert_upper(triangle.r);
  // Below rounding, no residual is better than another.
  const double rest = std::max(triangle.rest, 1e-13 * norm(white.values));
  solved.residual_squares = rest * rest;
  const double log_rest = std::log(std::max(solved.residual_squares, 1e-300));
  solved.profile = -0.5 * (white.log_determinant + static_cast<double>(n) * log_rest);
  solved.restricted =
      -0.5 * (white.log_determinant + static_cast<double>(n - k) * log_rest) - log_columns;
  return solved;
}

/// The long-run sum of products of a series with itself, and by how much its use of neighbours
/// widens the critical value.
struct LongRun {
  double sum = 0.0;
  double widening = 1.0;
};

/// The correlation of neighbours in a series about 0.
double neighbours(std::span<const double> z) {
  double zero = 0.0;
  double one = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    zero += z[i] * z[i];
    if (i > 0) one += z[i] * z[i - 1];
  }
  return zero > 0.0 ? one / zero : 0.0;
}

LongRun long_run(std::vector<double> z) {
  // What is left of slow changes is taken out first (Andrews and Monahan 1992): the lags below
  // would cut it off.
  const double slow = std::clamp(neighbours(z), 0.0, 0.95);
  for (std::size_t i = z.size(); i-- > 1;) z[i] -= slow * z[i - 1];
  const std::size_t n = z.size();
  const double rho = std::clamp(neighbours(z), -0.9, 0.9);
  const double alpha = 4 * rho * rho / std::pow((1 - rho) * (1 + rho), 2);
  const auto lags =
      std::min(n / 4, static_cast<std::size_t>(1.1447 * std::cbrt(alpha * static_cast<double>(n))));
  LongRun result;
  for (std::size_t lag = 0; lag <= lags; ++lag) {
    double product = 0.0;
    for (std::size_t i = lag; i < n; ++i) product += z[i] * z[i - lag];
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    result.sum += (lag == 0 ? 1.0 : 2.0 * weight) * product;
  }
  result.sum /= (1.0 - slow) * (1.0 - slow);
  if (lags > 0) {
    const double b = static_cast<double>(lags + 1) / static_cast<double>(n);
    result.widening = (1.9600 + 2.9694 * b + 0.4160 * b * b - 0.5324 * b * b * b) / 1.9600;
  }
  return result;
}

/// Half-widths of the 95 % intervals for one guess.
std::vector<double> half_widths(const White& white, const Solved& solved) {
  const std::size_t n = white.values.size();
  const std::size_t k = white.columns.columns();
  const auto dof = static_cast<double>(n - k);
  DenseMatrix q(n, k);  // the columns, made orthonormal
  for (std::size_t c = 0; c < k; ++c) {
    for (std::size_t j = 0; j <= c; ++j) {
      const double factor = solved.inverse(j, c);
      for (std::size_t i = 0; i < n; ++i) q(i, c) += white.columns(i, j) * factor;
    }
  }
  std::vector<double> residuals = white.values;
  for (std::size_t c = 0; c < k; ++c) {
    for (std::size_t i = 0; i < n; ++i) residuals[i] -= white.columns(i, c) * solved.x[c];
  }
  for (std::size_t i = 0; i < n; ++i) {
    double leverage = 0.0;
    for (std::size_t c = 0; c < k; ++c) leverage += q(i, c) * q(i, c);
    // A row that bends the fit towards itself shows less of its error.
    residuals[i] /= std::sqrt(std::max(1.0 - leverage, 1e-3));
  }
  std::vector<double> widths;
  for (std::size_t c = 0; c < k; ++c) {
    std::vector<double> pull(n, 0.0);  // of each row on the coefficient
    for (std::size_t j = c; j < k; ++j) {
      for (std::size_t i = 0; i < n; ++i) pull[i] += q(i, j) * solved.inverse(c, j);
    }
    double squares = 0.0;
    double fourths = 0.0;
    for (double& p : pull) {
      squares += p * p;
      fourths += p * p * p * p;
    }
    for (std::size_t i = 0; i < n; ++i) pull[i] *= residuals[i];
    const LongRun run = long_run(pull);
    const double implied =
        student_t_quantile(0.975, dof) * std::sqrt(solved.residual_squares / dof * squares);
    const double rests_on = std::clamp(squares * squares / fourths, 1.0, dof);
    const double seen =
        student_t_quantile(0.975, rests_on) * run.widening * std::sqrt(std::max(run.sum, 0.0));
    widths.push_back(std::max(implied, seen));
  }
  return widths;
}

/// Durbin and Watson's ratio, stretch by stretch about each one's mean.
double durbin_watson(const FitRows& rows, Colour colour, const std::vector<double>& x) {
  double differences = 0.0;
  double squares = 0.0;
  std::vector<double> errors;  // of one stretch
  const auto close = [&] {
    const bool centre = colour == Colour::edges_and_walk && !errors.empty();
    const double mean = centre ? std::accumulate(errors.begin(), errors.end(), 0.0) /
                                     static_cast<double>(errors.size())
                               : 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      squares += (errors[i] - mean) * (errors[i] - mean);
      if (i > 0) differences += (errors[i] - errors[i - 1]) * (errors[i] - errors[i - 1]);
    }
    errors.clear();
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double error = rows.values[i];
    for (std::size_t c = 0; c < x.size(); ++c) error -= rows.columns(i, c) * x[c];
    if (rows.starts[i]) close();
    if (colour == Colour::edges_and_walk) {
      if (errors.empty()) errors.push_back(0.0);
      error += errors.back();
    }
    errors.push_back(error);
  }
  close();
  return squares > 0.0 ? differences / squares : 2.0;
}

/// One guess and its fit.
struct Tried {
  Shade shade;
  Solved solved;
};

void try_out(const FitRows& rows, Colour colour, const std::vector<Shade>& shades,
             std::vector<Tried>& tried) {
  for (const Shade& shade : shades) {
    if (auto solved = solve(whiten(rows, colour, shade))) {
      tried.push_back({shade, std::move(*solved)});
    }
  }
}

bool less_likely(const Tried& a, const Tried& b) {
  return a.solved.restricted < b.solved.restricted;
}
const Tried& likeliest(const std::vector<Tried>& tried) {
  return *std::max_element(tried.begin(), tried.end(), less_likely);
}

/// The fits of all guesses that may matter. Power that changes slowly is only looked into where a
/// few probes say that it explains more.
std::vector<Tried> try_all(const FitRows& rows, Colour colour) {
  std::vector<Tried> tried;
  const std::vector<Shade> still = still_grid(colour, rows.size());
  try_out(rows, colour, still, tried);
  if (colour != Colour::edges_and_walk || tried.empty()) return tried;
  const Tried& best = likeliest(tried);
  std::vector<Tried> probes;
  try_out(rows, colour, swinging_grid({best.shade.share}, {0.03, 1.0}, still.size()), probes);
  constexpr double kWorthwhile = 2.0;  // in log likelihood
  if (!probes.empty() &&
      likeliest(probes).solved.restricted > best.solved.restricted + kWorthwhile) {
    try_out(rows, colour,
            swinging_grid({0.0, 0.01, 0.1, 0.5, 1.0}, {0.01, 0.1, 1.0, 10.0, 100.0}, still.size()),
            tried);
  }
  return tried;
}

}  // namespace

std::optional<FirstGuess> guess(const FitRows& rows, Colour colour) {
  std::vector<Tried> tried;
  try_out(rows, colour, still_grid(colour, rows.size()), tried);
  if (tried.empty()) return std::nullopt;
  const auto best = std::max_element(
      tried.begin(), tried.end(),
      [](const Tried& a, const Tried& b) { return a.solved.profile < b.solved.profile; });
  return FirstGuess{best->solved.x, best->solved.profile};
}

std::optional<ColouredFit> fit_coloured(const FitRows& rows, Colour colour) {
  const std::size_t k = rows.columns.columns();
  const std::vector<Tried> tried = try_all(rows, colour);
  if (tried.empty()) return std::nullopt;
  const double best = likeliest(tried).solved.restricted;
  const auto weight_of = [&](const Tried& t) {
    constexpr double kLeast = 0.01;  // of the likeliest: less changes nothing
    const double weight = std::exp(t.solved.restricted - best);
    return weight < kLeast ? 0.0 : weight * t.shade.prior;
  };
  double weights = 0.0;
  for (const Tried& t : tried) weights += weight_of(t);

  ColouredFit fit;
  fit.x.assign(k, 0.0);
  fit.half_widths.assign(k, 0.0);
  for (const Tried& t : tried) {
    for (std::size_t c = 0; c < k; ++c) fit.x[c] += weight_of(t) / weights * t.solved.x[c];
  }
  for (const Tried& t : tried) {
    const double weight = weight_of(t) / weights;
    if (weight == 0.0) continue;
    const auto widths = half_widths(whiten(rows, colour, t.shade), t.solved);
    for (std::size_t c = 0; c < k; ++c) {
      const double off = 1.96 * (t.solved.x[c] - fit.x[c]);
      fit.half_widths[c] += weight * (widths[c] * widths[c] + off * off);
    }
  }
  for (double& width : fit.half_widths) width = std::sqrt(width);
  fit.durbin_watson = durbin_watson(rows, colour, tried.front().solved.x);
  return fit;
}

std::vector<bool> stopped_at_zero(const FitRows& rows, Colour colour,
                                  const std::vector<bool>& free) {
  const std::vector<Tried> tried = try_all(rows, colour);
  if (tried.empty()) return std::vector<bool>(rows.columns.columns(), false);
  const White white = whiten(rows, colour, likeliest(tried).shade);
  return solve_nnls(white.columns, white.values, free).at_bound;
}

namespace {

/// Variances of edges from the fitted power there.
void weigh_edges(FitRows& rows, const std::vector<double>& fitted, double energy_step) {
  const std::size_t n = rows.size();
  std::vector<double> power(n, 0.0);
  double energy = 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    energy += std::fabs(fitted[i]);
    length += rows.lengths[i];
    power[i] = fitted[i] / rows.lengths[i];
  }
  // Not too unequal: the fit is a first guess, and not all errors grow with the power.
  const double least = std::max(0.25 * energy / length, 1e-12);
  for (double& p : power) p = std::max(p, least);
  const auto variance = [&](double watts, double jitter) {
    return watts * watts * jitter * jitter + energy_step * energy_step;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const bool follows = !rows.starts[i];
    const double before = follows ? rows.jitter[i - 1] : rows.jitter[i];
    const double watts_before = follows ? 0.5 * (power[i - 1] + power[i]) : power[i];
    const bool followed = i + 1 < n && !rows.starts[i + 1];
    const double watts_after = followed ? 0.5 * (power[i + 1] + power[i]) : power[i];
    rows.edges_before[i] = variance(watts_before, before);
    rows.edges_after[i] = variance(watts_after, rows.jitter[i]);
  }
}

/// Variances of rows from how large the residuals are while each column is busy.
void weigh_noise(FitRows& rows, const std::vector<double>& residuals) {
  const std::size_t n = rows.size();
  DenseMatrix parts = rows.columns;
  std::vector<double> squares(n);
  for (std::size_t i = 0; i < n; ++i) squares[i] = residuals[i] * residuals[i];
  const std::size_t k = parts.columns();
  if (!rows.edges_before.empty()) {
    // Timing errors are not of the column's own.
    std::vector<double> edges(n);
    for (std::size_t i = 0; i < n; ++i) edges[i] = rows.edges_before[i] + rows.edges_after[i];
    parts.add_column(edges);
  }
  const std::vector<double> found = solve_nnls(parts, squares).x;
  std::vector<double> noise(n, 0.0);
  double mean = 0.0;
  for (std::size_t c = 0; c < k; ++c) {
    for (std::size_t i = 0; i < n; ++i) noise[i] += rows.columns(i, c) * found[c];
  }
  for (const double v : noise) mean += v / static_cast<double>(n);
  if (!(mean > 0.0)) return;
  for (std::size_t i = 0; i < n; ++i) rows.noise[i] = std::max(noise[i] / mean, 0.02);
}

}  // namespace

void weigh(FitRows& rows, const std::vector<double>& x, double energy_step) {
  const std::size_t n = rows.size();
  std::vector<double> fitted(n, 0.0);
  std::vector<double> residuals = rows.values;
  for (std::size_t c = 0; c < x.size(); ++c) {
    for (std::size_t i = 0; i < n; ++i) fitted[i] += rows.columns(i, c) * x[c];
  }
  for (std::size_t i = 0; i < n; ++i) residuals[i] -= fitted[i];
  if (!rows.edges_before.empty()) weigh_edges(rows, fitted, energy_step);
  weigh_noise(rows, residuals);
}

}  // namespace encore::energy
