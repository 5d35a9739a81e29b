#pragma once

#include "app/bench/race.h"

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace encore::app::bench {

/// One comparison: ours beside a peer of the same run.
struct BenchRow {
  std::string part{};   ///< "build", "refit", …
  std::string scene{};  ///< empty: of none
  std::uint64_t triangles = 0;
  int threads = 1;
  std::string operation{};  ///< what was done: "build", "primary", …
  std::string ours{};
  std::string peer{};  ///< empty: there is nothing to compare with
  std::string unit{};  ///< of the two values; more is better unless it is bytes or milliseconds
  double our_value = 0.0;
  double peer_value = 0.0;
  Spread ratio{};           ///< over 1: ours is better
  std::size_t repeats = 0;  ///< rounds that the ratio comes from
  double noise = 0.0;       ///< slowest of our rounds over the quickest; 0: not timed
  std::string note{};
};

/// Prints the rows as they come, a table a part and scene, and writes them as CSV.
class BenchReport {
 public:
  /// `csv` empty: no file. Throws std::runtime_error if it cannot be written. `before_print` is
  /// called before anything is printed.
  explicit BenchReport(
      const std::string& csv, std::function<void()> before_print = [] {});

  /// A line of text.
  void say(const std::string& line) const;
  void add(const BenchRow& row);
  [[nodiscard]] const std::vector<BenchRow>& rows() const { return rows_; }

 private:
  std::vector<BenchRow> rows_;
  std::function<void()> before_print_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> csv_;
};

/// The first line of the CSV file and one of a row, without line ends.
std::string csv_header();
std::string csv_line(const BenchRow& row);

}  // namespace encore::app::bench
