#include "energy/attribution/identifiability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace encore::energy {

namespace {

/// So many updates together show a steady loop as what it is; fewer where there are few rows: a
/// judgement needs some sums a column.
constexpr std::size_t kUpdatesTogether = 10;
constexpr std::size_t kLeastTogether = 5;
constexpr std::size_t kSumsEach = 4;

/// Sums of rows that follow each other. What is left at the end of a stretch joins the last sum of
/// it.
DenseMatrix mixes(const FitRows& rows, std::size_t together) {
  std::vector<std::size_t> group_of(rows.size());
  std::size_t groups = 0;
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin + 1;
    while (end < rows.size() && !rows.starts[end]) ++end;
    const std::size_t here = std::max<std::size_t>(1, (end - begin) / together);
    for (std::size_t i = begin; i < end; ++i) {
      group_of[i] = groups + std::min(here - 1, (i - begin) / together);
    }
    groups += here;
    begin = end;
  }
  DenseMatrix sums(groups, rows.columns.columns());
  for (std::size_t c = 0; c < rows.columns.columns(); ++c) {
    for (std::size_t i = 0; i < rows.size(); ++i) sums(group_of[i], c) += rows.columns(i, c);
  }
  return sums;
}

std::vector<double> lengths_of(const DenseMatrix& matrix) {
  std::vector<double> lengths;
  for (std::size_t c = 0; c < matrix.columns(); ++c) {
    const double length = norm(matrix.column(c));
    lengths.push_back(length > 0.0 ? length : 1.0);
  }
  return lengths;
}

void scale_columns(DenseMatrix& matrix, const std::vector<double>& lengths) {
  for (std::size_t c = 0; c < matrix.columns(); ++c) {
    for (double& v : matrix.column(c)) v /= lengths[c];
  }
}

/// How long the weakest mix would be of the timing of updates alone, squared: places that are
/// uniform in a range have a twelfth of its square as variance.
double timing_variance(const FitRows& rows, std::size_t together,
                       const std::vector<double>& lengths, const std::vector<double>& weakest) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double row = 0.0;
    for (std::size_t c = 0; c < weakest.size(); ++c) {
      row += rows.timing(i, c) / lengths[c] * weakest[c];
    }
    sum += row * row / 12.0;
  }
  // Of a counter's edges, only the two at the ends of each sum are left.
  const bool is_counter = !rows.edges_after.empty();
  return is_counter ? sum * 2.0 / static_cast<double>(together) : sum;
}

/// 1 / (the part of each unit column that the others do not explain, squared).
std::vector<double> inflations(const DenseMatrix& scaled) {
  std::vector<double> result;
  for (std::size_t c = 0; c < scaled.columns(); ++c) {
    std::vector<bool> others(scaled.columns(), true);
    others[c] = false;
    const auto column = scaled.column(c);
    const double rest = triangularise(scaled.select(others), {column.begin(), column.end()}).rest;
    result.push_back(rest > 0.0 ? 1.0 / (rest * rest) : std::numeric_limits<double>::infinity());
  }
  return result;
}

double inflation_of_pair(const DenseMatrix& scaled, std::size_t a, std::size_t b) {
  const auto x = scaled.column(a);
  const auto y = scaled.column(b);
  // 1 - cos^2 by the difference: exact for columns that are nearly alike.
  double apart = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) apart += (x[i] - y[i]) * (x[i] - y[i]);
  const double sine_squared = apart * (1.0 - 0.25 * apart);
  return sine_squared > 0.0 ? 1.0 / sine_squared : std::numeric_limits<double>::infinity();
}

}  // namespace

Identifiability identifiability(const FitRows& rows) {
  Identifiability result;
  const std::size_t together =
      std::clamp(rows.size() / (kSumsEach * std::max<std::size_t>(1, rows.columns.columns())),
                 kLeastTogether, kUpdatesTogether);
  DenseMatrix scaled = mixes(rows, together);
  const std::vector<double> lengths = lengths_of(scaled);
  scale_columns(scaled, lengths);
  const Spectrum found = spectrum(scaled);
  result.condition = found.condition();
  // Beyond rounding a larger number says no more.
  if (result.condition > 1e12) result.condition = std::numeric_limits<double>::infinity();
  const double smallest = found.values.empty() ? 1.0 : found.values.back();
  result.timing = timing_variance(rows, together, lengths, found.weakest) /
                  std::max(smallest * smallest, 1e-300);
  result.inflation = inflations(scaled);
  const std::size_t k = scaled.columns();
  for (std::size_t a = 0; a < k; ++a) {
    for (std::size_t b = a + 1; b < k; ++b) {
      if (inflation_of_pair(scaled, a, b) > kHighInflation) result.alike.push_back({a, b});
    }
  }
  const double highest =
      k == 0 ? 0.0 : *std::max_element(result.inflation.begin(), result.inflation.end());
  if (result.alike.empty() && highest > kHighInflation) {
    std::vector<std::size_t> involved;
    for (std::size_t c = 0; c < k; ++c) {
      if (std::fabs(found.weakest[c]) > 0.2) involved.push_back(c);
    }
    result.alike.push_back(involved);
  }
  return result;
}

void phases_first(Identifiability& found, std::size_t phases) {
  std::stable_partition(found.alike.begin(), found.alike.end(), [&](const auto& set) {
    return std::none_of(set.begin(), set.end(), [&](std::size_t c) { return c >= phases; });
  });
}

std::string refusal(const Identifiability& found, const std::vector<std::string>& names) {
  // An infinite condition is beyond the worst, and so would be one that is no number.
  const bool by_timing = found.condition <= kWorstCondition;
  if (by_timing && found.timing <= kMostTiming) return {};
  if (by_timing) {
    return "the mix of phases changed hardly more than the times of the sensor's updates are "
           "known: "
           "cannot be told apart";
  }
  if (found.alike.empty()) return "the phases always ran in the same mix: cannot be told apart";
  return describe(found.alike.front(), names, true);
}

std::optional<ColumnGroups> join_pair(ColumnGroups groups, std::size_t count,
                                      const std::vector<std::size_t>& alike) {
  if (alike.size() != 2) return std::nullopt;
  for (std::size_t c = groups.empty() ? 0 : count; c < count; ++c) groups.push_back({c});
  const auto [a, b] = std::minmax(alike[0], alike[1]);
  if (b >= groups.size()) return std::nullopt;
  groups[a].insert(groups[a].end(), groups[b].begin(), groups[b].end());
  groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
  const bool some_alone =
      std::any_of(groups.begin(), groups.end(), [](const auto& g) { return g.size() == 1; });
  if (!some_alone) return std::nullopt;
  return groups;
}

std::string describe(const std::vector<std::size_t>& alike, const std::vector<std::string>& names,
                     bool refused) {
  std::string list;
  for (std::size_t i = 0; i < alike.size(); ++i) {
    if (i > 0) list += i + 1 == alike.size() ? " and " : ", ";
    list += names[alike[i]];
  }
  return refused ? list + " always ran in the same proportion: cannot be told apart"
                 : list + " mostly ran in the same proportion: their shares are uncertain";
}

}  // namespace encore::energy
