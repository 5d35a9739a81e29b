#include "app/bench/report.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace encore::app::bench {

namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

/// Three or four digits that mean something, whatever the size.
std::string short_number(double value) {
  if (value == 0.0) return "0";
  if (value >= 1000.0) return fmt::format("{:.0f}", value);
  if (value >= 100.0) return fmt::format("{:.1f}", value);
  if (value >= 10.0) return fmt::format("{:.2f}", value);
  return fmt::format("{:.3f}", value);
}

}  // namespace

BenchReport::BenchReport(const std::string& csv, std::function<void()> before_print)
    : before_print_(std::move(before_print)), csv_(nullptr, &std::fclose) {
  if (csv.empty()) return;
  csv_.reset(std::fopen(csv.c_str(), "w"));
  if (csv_ == nullptr) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", csv, std::strerror(errno)));
  }
  fmt::print(csv_.get(), "{}\n", csv_header());
}

void BenchReport::say(const std::string& line) const {
  before_print_();
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void BenchReport::add(const BenchRow& row) {
  before_print_();
  const bool first = rows_.empty() || rows_.back().part != row.part ||
                     rows_.back().scene != row.scene || rows_.back().threads != row.threads;
  if (first) {
    std::string head = row.part;
    if (!row.scene.empty()) head += fmt::format(", {}, {} triangles", row.scene, row.triangles);
    head += row.threads == 1 ? ", 1 thread" : fmt::format(", {} threads", row.threads);
    fmt::print("\n{}\n  {:<14} {:<40} {:>8} {:<10} {:<33} {:>8}  {:>18} {:>5} {:>6}\n", head,
               "what", "ours", "", "", "peer", "", "ratio: min med max", "runs", "noise");
  }
  fmt::print("  {:<14} {:<40} {:>8} {:<10} ", row.operation, row.ours, short_number(row.our_value),
             row.unit);
  if (row.peer.empty()) {
    fmt::print("{:<33} {:>8}  {:>18}", "-", "", "");
  } else {
    fmt::print("{:<33} {:>8}  {:>5.2f} {:>6.2f} {:>5.2f}", row.peer, short_number(row.peer_value),
               row.ratio.min, row.ratio.median, row.ratio.max);
  }
  fmt::print(" {:>5} {:>6}{}\n", row.repeats,
             row.noise > 0.0 ? fmt::format("{:.2f}", row.noise) : "",
             row.note.empty() ? "" : "  " + row.note);
  std::fflush(stdout);
  if (csv_ != nullptr) {
    fmt::print(csv_.get(), "{}\n", csv_line(row));
    std::fflush(csv_.get());
  }
  rows_.push_back(row);
}

std::string csv_header() {
  return "part,scene,triangles,threads,operation,ours,peer,unit,our_value,peer_value,ratio_min,"
         "ratio_median,ratio_max,repeats,noise,note";
}

std::string csv_line(const BenchRow& row) {
  return fmt::format("{},{},{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.4g},{}",
                     row.part, quoted(row.scene), row.triangles, row.threads, quoted(row.operation),
                     quoted(row.ours), quoted(row.peer), row.unit, row.our_value, row.peer_value,
                     row.ratio.min, row.ratio.median, row.ratio.max, row.repeats, row.noise,
                     quoted(row.note));
}

}  // namespace encore::app::bench
