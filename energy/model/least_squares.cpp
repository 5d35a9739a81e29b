#include "energy/model/least_squares.h"

#include <algorithm>
#include <cmath>

namespace encore::energy {

namespace {

using Column = std::vector<double>;

constexpr int kMostSweeps = 60;
constexpr double kOrthogonal = 1e-15;
constexpr double kDependent = 1e-12;

double dot(const Column& a, const Column& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void rotate(Column& a, Column& b, double cosine, double sine) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double left = a[i];
    a[i] = cosine * left - sine * b[i];
    b[i] = sine * left + cosine * b[i];
  }
}

/// Turns the columns of `matrix` orthogonal by rotations, which `rotations` (the identity before)
/// collects: matrix_before x rotations = matrix_after, both stored by columns.
void orthogonalise(std::vector<Column>& matrix, std::vector<Column>& rotations) {
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool done = true;
    for (std::size_t p = 0; p + 1 < matrix.size(); ++p) {
      for (std::size_t q = p + 1; q < matrix.size(); ++q) {
        const double pp = dot(matrix[p], matrix[p]);
        const double qq = dot(matrix[q], matrix[q]);
        const double pq = dot(matrix[p], matrix[q]);
        if (std::fabs(pq) <= kOrthogonal * std::sqrt(pp * qq)) continue;
        done = false;
        const double zeta = (qq - pp) / (2.0 * pq);
        const double tangent = std::copysign(1.0, zeta) / (std::fabs(zeta) + std::hypot(1.0, zeta));
        const double cosine = 1.0 / std::hypot(1.0, tangent);
        rotate(matrix[p], matrix[q], cosine, cosine * tangent);
        rotate(rotations[p], rotations[q], cosine, cosine * tangent);
      }
    }
    if (done) return;
  }
}

/// The columns of the system, each divided by its length, which `lengths` gets; false if one is 0.
bool scaled_columns(std::span<const std::vector<double>> rows, std::vector<Column>& columns,
                    std::vector<double>& lengths) {
  const std::size_t count = rows.front().size();
  columns.assign(count, Column(rows.size()));
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < rows.size(); ++i) columns[k][i] = rows[i][k];
    lengths.push_back(std::sqrt(dot(columns[k], columns[k])));
    if (!(lengths[k] > 0.0)) return false;
    for (double& entry : columns[k]) entry /= lengths[k];
  }
  return true;
}

}  // namespace

std::optional<double> LeastSquares::residual_deviation() const {
  if (degrees_of_freedom == 0) return std::nullopt;
  double squares = 0.0;
  for (const double residual : residuals) squares += residual * residual;
  return std::sqrt(squares / static_cast<double>(degrees_of_freedom));
}

std::optional<LeastSquares> solve_least_squares(std::span<const std::vector<double>> rows,
                                                std::span<const double> given) {
  if (rows.empty() || rows.front().empty() || rows.size() < rows.front().size()) {
    return std::nullopt;
  }
  const std::size_t count = rows.front().size();
  std::vector<Column> matrix;
  std::vector<double> lengths;
  if (!scaled_columns(rows, matrix, lengths)) return std::nullopt;
  std::vector<Column> rotations(count, Column(count, 0.0));
  for (std::size_t k = 0; k < count; ++k) rotations[k][k] = 1.0;
  orthogonalise(matrix, rotations);

  // The lengths of the orthogonal columns are the singular values.
  std::vector<double> singular;
  for (const Column& column : matrix) singular.push_back(std::sqrt(dot(column, column)));
  const auto [least, most] = std::minmax_element(singular.begin(), singular.end());
  if (!(*least > kDependent * *most)) return std::nullopt;

  LeastSquares solution;
  solution.condition = *most / *least;
  solution.degrees_of_freedom = rows.size() - count;
  solution.sensitivity.assign(count, std::vector<double>(rows.size(), 0.0));
  solution.coefficients.assign(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double pull = 0.0;
      for (std::size_t s = 0; s < count; ++s) {
        pull += rotations[s][k] * matrix[s][i] / (singular[s] * singular[s]);
      }
      solution.sensitivity[k][i] = pull / lengths[k];
      solution.coefficients[k] += solution.sensitivity[k][i] * given[i];
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double fitted = 0.0;
    for (std::size_t k = 0; k < count; ++k) fitted += rows[i][k] * solution.coefficients[k];
    solution.residuals.push_back(given[i] - fitted);
  }
  return solution;
}

}  // namespace encore::energy
