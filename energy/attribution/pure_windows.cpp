#include "energy/attribution/pure_windows.h"

#include "energy/attribution/windows.h"

#include <algorithm>

namespace encore::energy {

namespace {

constexpr double kBusyThroughout = 0.98;

/// What is left of `windows` (in order) without `hole`; holes come in order, too.
class Subtraction {
 public:
  explicit Subtraction(std::vector<Window> windows) : left_(std::move(windows)) {}

  void remove(std::vector<Window> holes) {
    holes = join_windows(std::move(holes));
    std::vector<Window> rest;
    std::size_t h = 0;
    for (Window window : left_) {
      while (h < holes.size() && holes[h].to <= window.from) ++h;
      for (std::size_t i = h; i < holes.size() && holes[i].from < window.to; ++i) {
        if (holes[i].from > window.from) rest.push_back({window.from, holes[i].from});
        window.from = std::max(window.from, holes[i].to);
      }
      if (window.to > window.from) rest.push_back(window);
    }
    left_ = std::move(rest);
  }
  [[nodiscard]] const std::vector<Window>& left() const { return left_; }

 private:
  std::vector<Window> left_;
};

}  // namespace

std::vector<Window> pure_windows(const BusyTimeline& busy, std::size_t column,
                                 const std::vector<Window>& within) {
  const std::vector<Window> joined = join_windows(within);
  if (joined.empty()) return {};
  const Seconds start = joined.front().from;
  const Seconds end = joined.back().to;
  std::vector<Window> own;
  for (const auto& piece : busy.pieces(column, start, end)) {
    if (piece.share < kBusyThroughout) continue;
    own.push_back({std::max(piece.start, start), std::min(piece.end, end)});
  }
  Subtraction pure(join_windows(std::move(own)));
  std::vector<Window> between;
  for (std::size_t i = 1; i < joined.size(); ++i) {
    between.push_back({joined[i - 1].to, joined[i].from});
  }
  pure.remove(std::move(between));
  for (std::size_t other = 0; other < busy.columns().size(); ++other) {
    if (other == column) continue;
    std::vector<Window> beside;
    for (const auto& piece : busy.pieces(other, start, end)) {
      beside.push_back({piece.start, piece.end});
    }
    pure.remove(std::move(beside));
  }
  return pure.left();
}

Seconds busy_in(const BusyTimeline& busy, std::size_t column, const std::vector<Window>& windows) {
  Seconds sum;
  for (const Window& window : join_windows(windows))
    sum += busy.busy(column, window.from, window.to);
  return sum;
}

}  // namespace encore::energy
