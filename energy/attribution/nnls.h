#pragma once

#include "energy/attribution/householder.h"

#include <span>
#include <vector>

namespace encore::energy {

/// A least-squares fit some of whose coefficients may not be negative.
struct NnlsFit {
  std::vector<double> x;
  std::vector<bool> at_bound;  ///< the coefficient was stopped at 0 (never true for a free one)
  double residual_norm = 0.0;
  bool converged = true;  ///< false: stopped after a number of steps that never occurs
};

/// min |A x - b| with x_j >= 0 for every column that is not `free` (empty: none is). The active set
/// method of Lawson and Hanson (1974), on the triangle that Householder reflections leave of the
/// column-scaled A: columns of very different size are told apart to working precision. For few
/// columns and many rows. Weights: multiply rows of A and b by their square roots beforehand.
/// Columns that depend on each other give one of the solutions.
NnlsFit solve_nnls(const DenseMatrix& a, std::span<const double> b,
                   const std::vector<bool>& free = {});

}  // namespace encore::energy
