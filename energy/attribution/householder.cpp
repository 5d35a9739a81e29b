#include "energy/attribution/householder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace encore::energy {

namespace {

double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// values -= v * (2 v.values / v.v), all from row `first` on.
void reflect(std::span<const double> v, double v_squared, std::span<double> values) {
  const double factor = 2.0 * dot(v, values) / v_squared;
  for (std::size_t i = 0; i < v.size(); ++i) values[i] -= factor * v[i];
}

/// Makes two columns orthogonal; turns `right` the same way. False if they already were.
bool rotate(DenseMatrix& a, DenseMatrix& right, std::size_t p, std::size_t q) {
  const double pp = dot(a.column(p), a.column(p));
  const double qq = dot(a.column(q), a.column(q));
  const double pq = dot(a.column(p), a.column(q));
  if (std::fabs(pq) <= 1e-15 * std::sqrt(pp * qq)) return false;
  const double zeta = (qq - pp) / (2.0 * pq);
  const double tangent = std::copysign(1.0, zeta) / (std::fabs(zeta) + std::hypot(1.0, zeta));
  const double cosine = 1.0 / std::hypot(1.0, tangent);
  const double sine = cosine * tangent;
  for (DenseMatrix* matrix : {&a, &right}) {
    const auto x = matrix->column(p);
    const auto y = matrix->column(q);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double old = x[i];
      x[i] = cosine * old - sine * y[i];
      y[i] = sine * old + cosine * y[i];
    }
  }
  return true;
}

}  // namespace

DenseMatrix DenseMatrix::select(const std::vector<bool>& keep) const {
  DenseMatrix result(rows_, 0);
  for (std::size_t c = 0; c < columns_; ++c) {
    if (keep[c]) result.add_column(column(c));
  }
  return result;
}

void DenseMatrix::add_column(std::span<const double> values) {
  if (columns_ == 0) rows_ = values.size();
  values_.insert(values_.end(), values.begin(), values.end());
  ++columns_;
}

double norm(std::span<const double> values) {
  const double plain = std::sqrt(dot(values, values));
  if (plain > 1e-140 && plain < 1e140) return plain;
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::fabs(v));
  if (largest == 0.0 || !std::isfinite(largest)) return largest;
  double sum = 0.0;
  for (const double v : values) sum += (v / largest) * (v / largest);
  return largest * std::sqrt(sum);
}

Triangle triangularise(DenseMatrix a, std::vector<double> b) {
  const std::size_t n = a.columns();
  if (a.rows() < n) {
    DenseMatrix padded(n, n);
    for (std::size_t c = 0; c < n; ++c) {
      std::copy(a.column(c).begin(), a.column(c).end(), padded.column(c).begin());
    }
    a = std::move(padded);
    b.resize(n, 0.0);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto below = a.column(k).subspan(k);
    const double length = norm(below);
    if (length == 0.0) continue;
    const double diagonal = -std::copysign(length, below[0]);
    std::vector<double> v(below.begin(), below.end());
    v[0] -= diagonal;
    // Scaled, so that its square neither overflows nor vanishes.
    for (double& element : v) element /= length;
    const double v_squared = dot(v, v);
    for (std::size_t c = k + 1; c < n; ++c) reflect(v, v_squared, a.column(c).subspan(k));
    reflect(v, v_squared, std::span(b).subspan(k));
    std::fill(below.begin(), below.end(), 0.0);
    below[0] = diagonal;
  }
  Triangle triangle{DenseMatrix(n, n), {b.begin(), b.begin() + static_cast<std::ptrdiff_t>(n)}};
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t r = 0; r <= c; ++r) triangle.r(r, c) = a(r, c);
  }
  triangle.rest = norm(std::span(b).subspan(n));
  return triangle;
}

std::vector<double> solve_upper(const DenseMatrix& r, std::span<const double> y) {
  const std::size_t n = r.columns();
  std::vector<double> x(n, 0.0);
  for (std::size_t i = n; i-- > 0;) {
    double sum = y[i];
    for (std::size_t c = i + 1; c < n; ++c) sum -= r(i, c) * x[c];
    x[i] = r(i, i) == 0.0 ? 0.0 : sum / r(i, i);
  }
  return x;
}

DenseMatrix invert_upper(const DenseMatrix& r) {
  const std::size_t n = r.columns();
  DenseMatrix inverse(n, n);
  for (std::size_t c = 0; c < n; ++c) {
    std::vector<double> unit(n, 0.0);
    unit[c] = 1.0;
    const std::vector<double> x = solve_upper(r, unit);
    std::copy(x.begin(), x.end(), inverse.column(c).begin());
  }
  return inverse;
}

double Spectrum::condition() const {
  if (values.empty()) return 1.0;
  if (values.back() == 0.0) return std::numeric_limits<double>::infinity();
  return values.front() / values.back();
}

Spectrum spectrum(DenseMatrix a) {
  const std::size_t n = a.columns();
  // The triangle has the same singular values, and its columns are short.
  a = triangularise(std::move(a), std::vector<double>(a.rows(), 0.0)).r;
  DenseMatrix right(n, n);
  for (std::size_t i = 0; i < n; ++i) right(i, i) = 1.0;
  constexpr int kMostSweeps = 60;
  bool turned = true;
  for (int sweep = 0; sweep < kMostSweeps && turned; ++sweep) {
    turned = false;
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) turned = rotate(a, right, p, q) || turned;
    }
  }
  Spectrum result;
  std::size_t weakest = 0;
  for (std::size_t c = 0; c < n; ++c) {
    result.values.push_back(norm(a.column(c)));
    if (result.values[c] < result.values[weakest]) weakest = c;
  }
  if (n > 0) result.weakest.assign(right.column(weakest).begin(), right.column(weakest).end());
  std::sort(result.values.begin(), result.values.end(), std::greater<>());
  return result;
}

}  // namespace encore::energy
