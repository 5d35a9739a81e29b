#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>

namespace encore::accel {

/// How another thread follows a build and ends it (AccelerationStructure::set_build_watch).
struct BuildWatch {
  const std::atomic<bool>* cancel = nullptr;  ///< true: end the build; null: it cannot be ended
  /// Share of the work that is done: 0 when a build begins, never less than before while it goes
  /// on, 1 when it has ended. An estimate of time: grids know the work of each pass, hierarchies
  /// take n (1 + log2 n) for a node of n triangles that waits (BuildMeter::left).
  std::atomic<float> progress{0.0F};

  // What tests are made of, so that they need no clock:
  std::uint64_t looks = 0;                      ///< how often the last build has looked at the flag
  std::uint64_t last_look = ~std::uint64_t{0};  ///< the look that cancels, whatever the flag says
};

/// Thrown by a build that was cancelled.
class BuildCancelled : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "the build was cancelled"; }
};

/// The builders' side of a watch. Without one nothing is looked at, estimated or divided; with one
/// the flag is looked at before every kPart elements of a pass over an array, and before every node
/// of at least kNode triangles: about every 0.1 ms.
class BuildMeter {
 public:
  static constexpr std::size_t kPart = 1U << 13U;
  static constexpr std::uint32_t kNode = 1U << 10U;

  /// `watch` may be null.
  explicit BuildMeter(BuildWatch* watch) : watch_(watch) {
    if (watch_ == nullptr) return;
    watch_->progress.store(0.0F, std::memory_order_relaxed);
    watch_->looks = 0;
  }

  [[nodiscard]] bool watched() const { return watch_ != nullptr; }
  [[nodiscard]] double done() const { return done_; }

  /// Whether somebody has asked for the end. The only member that other threads than the building
  /// one may call.
  [[nodiscard]] bool cancel_asked() const {
    return watch_ != nullptr && watch_->cancel != nullptr &&
           watch_->cancel->load(std::memory_order_relaxed);
  }
  /// What such a thread can be watched by: it ends where this one does.
  [[nodiscard]] const std::atomic<bool>* cancel_flag() const {
    return watch_ != nullptr ? watch_->cancel : nullptr;
  }

  /// Throws BuildCancelled if the build is to end.
  void check() {
    if (watch_ != nullptr) [[unlikely]] {
      look();
    }
  }

  /// The same; `progress` in [0, 1] is what is done.
  void report(double progress) {
    done_ = std::max(done_, std::min(progress, 1.0));
    if (watch_ == nullptr) return;
    watch_->progress.store(static_cast<float>(done_), std::memory_order_relaxed);
    look();
  }

  /// The build has ended well.
  void finish() {
    if (watch_ != nullptr) watch_->progress.store(1.0F, std::memory_order_relaxed);
  }

  /// A pass over [0, count): calls body(begin, end) for one part after the other, the whole at once
  /// if nobody watches. Progress goes on evenly to `until`; where the caller reports by itself, it
  /// stays.
  template <class Body>
  void pass(std::size_t count, double until, Body body) {
    const double from = done_;
    const std::size_t part = watch_ != nullptr ? kPart : std::max<std::size_t>(count, 1);
    for (std::size_t begin = 0; begin < count; begin += part) {
      if (watch_ != nullptr) {
        report(from + (until - from) * static_cast<double>(begin) / static_cast<double>(count));
      }
      body(begin, std::min(begin + part, count));
    }
    done_ = std::max(done_, until);
  }
  template <class Body>
  void pass(std::size_t count, Body body) {
    pass(count, done_, body);
  }

  /// The same for a pass that many short ranges go through as well: where the part ends that begins
  /// at `begin`.
  template <class Index>
  Index part_end(Index begin, Index end) {
    if (end - begin <= kPart) [[likely]] {
      return end;
    }
    check();
    return begin + static_cast<Index>(kPart);
  }

  /// The same for a pass whose elements differ much in their work: the caller calls it with the
  /// number of the element that comes next and what has been done so far, in any unit that grows
  /// by one an element at least. Returns how much that may become until the next call; without a
  /// watch there is none.
  std::size_t next_call(std::size_t element, std::size_t count, std::size_t work, double from,
                        double until) {
    if (watch_ == nullptr) return ~std::size_t{0};
    report(from + (until - from) * static_cast<double>(element) / static_cast<double>(count));
    return work + kPart;
  }

  /// Work that a node of so many triangles still needs, in units of its own: every level of a
  /// balanced tree goes over all of them once.
  static double left(std::uint32_t triangles);

 private:
  void look();

  BuildWatch* watch_;
  double done_ = 0.0;
};

}  // namespace encore::accel
