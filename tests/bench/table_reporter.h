#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace encore::bench {

/// What a benchmark measures; its name is "scene/operation/structure".
struct BenchCase {
  std::string operation;  ///< "build", "refit" or "trace"
  std::string scene;
  std::string structure;
  std::string reference;  ///< the structure whose time the ratio compares with; may be missing
  double items = 0;       ///< triangles or rays an iteration
  [[nodiscard]] std::string name() const { return scene + "/" + operation + "/" + structure; }
};

/// Collects the repetitions of all benchmarks and prints a table for each operation at the end:
/// median time, range, throughput, and how many times as fast as the reference of the same run.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  void add(const BenchCase& bench_case) { cases_.push_back(bench_case); }

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  void print_table(const std::string& operation, const std::string& unit);
  [[nodiscard]] double median_ms(const std::string& name) const;

  std::vector<BenchCase> cases_;
  std::map<std::string, std::vector<double>> times_ms_;  // by name, one a repetition
  std::map<std::string, double> hits_;
};

}  // namespace encore::bench
