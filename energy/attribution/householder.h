#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace encore::energy {

/// A dense matrix, column after column.
class DenseMatrix {
 public:
  DenseMatrix() = default;
  DenseMatrix(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), values_(rows * columns, 0.0) {}

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  double& operator()(std::size_t row, std::size_t column) { return values_[column * rows_ + row]; }
  double operator()(std::size_t row, std::size_t column) const {
    return values_[column * rows_ + row];
  }
  std::span<double> column(std::size_t c) { return {values_.data() + c * rows_, rows_}; }
  [[nodiscard]] std::span<const double> column(std::size_t c) const {
    return {values_.data() + c * rows_, rows_};
  }
  /// The columns whose mark is true, in order.
  [[nodiscard]] DenseMatrix select(const std::vector<bool>& keep) const;
  void add_column(std::span<const double> values);

 private:
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<double> values_;
};

/// Euclidean length, safe against overflow.
double norm(std::span<const double> values);

/// What Householder reflections leave of min |A x - b|: min |R x - y|, plus a constant.
struct Triangle {
  DenseMatrix r;          ///< upper triangle, one row and column a column of A
  std::vector<double> y;  ///< the part of b that A can reach
  double rest = 0.0;      ///< length of the part of b that no x reaches
};
/// Orthogonal reduction (no normal equations: the condition is not squared). A may have fewer rows
/// than columns: missing rows count as 0.
Triangle triangularise(DenseMatrix a, std::vector<double> b);

/// x of R x = y. Where a diagonal element is 0, so is x (the column depends on those before it).
std::vector<double> solve_upper(const DenseMatrix& r, std::span<const double> y);
/// The inverse of an upper triangle without a 0 on its diagonal.
DenseMatrix invert_upper(const DenseMatrix& r);

/// The singular values of a matrix, largest first, and the right vector of the smallest one.
struct Spectrum {
  std::vector<double> values;
  std::vector<double> weakest;
  /// Largest over smallest; infinity if the smallest is 0.
  [[nodiscard]] double condition() const;
};
/// By one-sided Jacobi rotations, which find small singular values to high relative accuracy. For
/// few columns.
Spectrum spectrum(DenseMatrix a);

}  // namespace encore::energy
