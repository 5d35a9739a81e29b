#include "tests/bench/table_reporter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace encore::bench {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace

bool TableReporter::ReportContext(const Context& context) {
  fmt::print(
      "Machine: {}, {} cores. One thread; times are processor time of the whole process.\n"
      "Repetitions of all benchmarks are interleaved at random.\n",
      processor_name(), context.cpu_info.num_cpus);
  const auto& load = context.cpu_info.load_avg;
  if (!load.empty() && load[0] > 1.0) {
    fmt::print("Note: load average {:.1f}; other programs share caches and memory.\n", load[0]);
  }
  std::fflush(stdout);
  return true;
}

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    const std::string& name = run.run_name.function_name;
    if (run.error_occurred) {
      fmt::print(stderr, "{}: {}\n", name, run.error_message);
      continue;
    }
    times_ms_[name].push_back(1e3 * run.cpu_accumulated_time /
                              static_cast<double>(std::max<std::int64_t>(run.iterations, 1)));
    if (const auto hits = run.counters.find("hits"); hits != run.counters.end()) {
      hits_[name] = hits->second;
    }
  }
  if (!runs.empty()) {
    const std::string& name = runs.front().run_name.function_name;
    fmt::print(stderr, "{:<44} {:>10.3f} ms\n", name, median_ms(name));
  }
}

double TableReporter::median_ms(const std::string& name) const {
  const auto found = times_ms_.find(name);
  if (found == times_ms_.end()) return 0.0;
  std::vector<double> sorted = found->second;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

void TableReporter::print_table(const std::string& operation, const std::string& unit) {
  bool any = false;
  for (const BenchCase& c : cases_) {
    const double median = median_ms(c.name());
    if (c.operation != operation || median <= 0) continue;
    if (!any) {
      fmt::print("\n{:<6} {:<14} {:>9} {:<22} {:>10} {:>22} {:>9} {:>10}{}\n", operation, "scene",
                 "items", "structure", "ms", "min .. max", unit, "x Embree",
                 operation == "trace" ? "      hits" : "");
      any = true;
    }
    const auto& times = times_ms_[c.name()];
    const auto [low, high] = std::minmax_element(times.begin(), times.end());
    BenchCase reference = c;
    reference.structure = c.reference;
    const double reference_ms = median_ms(reference.name());
    fmt::print("{:<6} {:<14} {:>9.0f} {:<22} {:>10.3f} {:>22} {:>9.2f} {:>10}", "", c.scene,
               c.items, c.structure, median, fmt::format("{:.3f} .. {:.3f}", *low, *high),
               c.items / median * 1e-3,
               reference_ms > 0 ? fmt::format("{:.2f}", reference_ms / median) : "-");
    if (operation == "trace") fmt::print("{:>10.0f}", hits_[c.name()]);
    fmt::print("\n");
  }
}

void TableReporter::Finalize() {
  print_table("build", "Mtri/s");
  print_table("refit", "Mtri/s");
  print_table("trace", "Mrays/s");
#if !defined(ENCORE_HAVE_EMBREE)
  fmt::print("\nEmbree 3 was not found when this program was built: no reference column.\n");
#endif
}

}  // namespace encore::bench
