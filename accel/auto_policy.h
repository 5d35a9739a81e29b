#pragma once

#include "accel/settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace encore::accel {

/// The median of the last few values of a row.
class RecentMedian {
 public:
  void add(double value);
  [[nodiscard]] std::optional<double> value() const;

 private:
  static constexpr std::size_t kKept = 5;
  std::array<double, kKept> values_{};
  std::size_t count_ = 0;  ///< ever added
};

/// How fast something grows a step, relative to itself, where two looks in a row agree on the
/// direction: the lesser of the two. 0 where they do not, as where it jumps or swings.
class SteadyRate {
 public:
  /// It grew by this factor within so many steps.
  void add(double factor, std::uint64_t steps);
  /// Factor of growth that so many more steps would bring; at most 2 and at least 1/2.
  [[nodiscard]] double over(std::uint64_t steps) const;

 private:
  double last_ = 0.0;  ///< logarithm, a step
  double rate_ = 0.0;
};

/// What Policy::automatic did, and what it goes by.
struct AutoFigures {
  std::uint64_t rebuilds = 0;  ///< since the figures were last cleared
  std::uint64_t updates = 0;
  /// Frames until a rebuild now would have paid for itself if the excess stayed as it is. Nothing
  /// where that is never (as right after a rebuild), or costs are not known.
  std::optional<double> break_even_frames;
  /// The same when the last rebuilds of updated trees were decided on: their median, since then.
  std::optional<double> break_even_at_rebuild;
};

/// Decides under Policy::automatic whether a hierarchy is built or updated, from what building,
/// updating and tracing were seen to cost here. Costs are numbers above 0 of any one unit: seconds,
/// or joules where the watts of each phase are known.
///
/// The rule. After a build let e(i) be what tracing frame i costs above a fresh tree, and
/// D = build - update. A cycle of n frames costs (D + e(1) + ... + e(n-1)) / n a frame above what
/// must be; while e grows that is least when the next frame's excess first reaches it. So: build
/// where n e(n) >= D + e(1) + ... + e(n-1); that is each frame where e(1) >= D, and always where a
/// build costs no more than an update.
///
/// The excess is predicted from the surface area heuristic (Lauterbach et al. 2006): tracing costs
/// 1 + slope * (decay - 1) times what it does in a fresh tree, decay being the tree's SAH cost over
/// that of a fresh one of now. The latter is the cost after the last build and drifts on as it did
/// over the last builds: while a scene flies apart a fresh tree often gets the better, and a ratio
/// to the old build alone would see no decay at all. The slope is fitted to what tracing cost right
/// before and right after builds, where scene and view are almost the same; how fast those change
/// is seen from one fresh tree to the next and taken out. Single frames that fall out of line pull
/// little.
///
/// What is not tried is not known, so now and then, for at most kTrialShare of the costs, it builds
/// a tree that seems good or updates one that seems to be worth a build.
class AutoPolicy {
 public:
  /// Share of all costs that trials may take.
  static constexpr double kTrialShare = 0.01;

  explicit AutoPolicy(AutoRule rule = AutoRule::cost) : rule_(rule) {}

  /// What was done and what it cost, with everything that it brought along (sending to a device).
  void observe_build(double cost);
  void observe_update(double cost);
  /// What tracing a frame cost, and AccelerationStructure::assessed_cost() of what it was traced
  /// through (nothing: not known, or updates lose nothing; any unit); after observe_build() or
  /// observe_update() of that frame, if there was either.
  void observe_frame(double cost, std::optional<double> tree_cost);

  /// Whether the next change of a tree that could be updated is to be answered by a build. Nothing
  /// while build or tracing are unmeasured, and under AutoRule::quality: then the threshold decides
  /// (AccelerationStructure::decayed).
  [[nodiscard]] std::optional<bool> builds_next() const;

  [[nodiscard]] AutoFigures figures() const;
  /// Counts anew; what was learned stays.
  void clear_figures() {
    rebuilds_ = updates_ = 0;
    break_even_ = {};
  }
  /// See AutoFigures.
  [[nodiscard]] std::optional<double> break_even_frames() const;
  /// What a frame costs now above one of a fresh tree; 0 right after a build.
  [[nodiscard]] std::optional<double> excess() const;
  /// Build minus update, once both were measured.
  [[nodiscard]] std::optional<double> build_surplus() const;
  /// Relative growth of the cost of tracing over growth of the SAH cost.
  [[nodiscard]] double slope() const { return slope_over_ / slope_under_; }
  [[nodiscard]] AutoRule rule() const { return rule_; }

 private:
  /// What a build compares: the last frame before it and the first one after it.
  struct Before {
    double traced = 0.0;                 ///< 0: there is nothing to learn from
    std::optional<double> tree_cost{};   ///< as assessed
    std::optional<double> fresh_tree{};  ///< that after the build before this one
    double fresh_trace = 0.0;            ///< of the first frame after that
    std::uint64_t updates = 0;           ///< between the two
  };

  void begin_cycle(double cost, std::optional<double> tree_cost);
  void learn_slope(double decay, double ratio);
  [[nodiscard]] double decay_of(std::optional<double> tree_cost) const;
  [[nodiscard]] double growth(double decay) const;
  [[nodiscard]] double next_excess() const;

  AutoRule rule_;
  std::uint64_t rebuilds_ = 0;
  std::uint64_t updates_ = 0;
  RecentMedian break_even_;
  RecentMedian build_;
  RecentMedian update_;
  RecentMedian fresh_trace_;   ///< what the last frames would have cost in a fresh tree
  RecentMedian first_excess_;  ///< e(1) of the last cycles
  // Of the cycle since the last build.
  std::uint64_t frames_ = 0;
  std::uint64_t cycle_updates_ = 0;
  double sum_ = 0.0;  ///< of excesses
  double excess_ = 0.0;
  double previous_excess_ = 0.0;
  std::optional<double> built_tree_;  ///< SAH cost right after the build
  double built_trace_ = 0.0;          ///< cost of the first frame
  std::optional<double> tree_cost_;   ///< SAH cost now
  double decay_ = 1.0;
  double traced_ = 0.0;  ///< cost of the last frame
  Before before_;
  SteadyRate tree_drift_;   ///< of a fresh tree's SAH cost, an update
  SteadyRate trace_drift_;  ///< of what tracing a fresh tree costs, an update
  // Spent since the other was last done.
  double since_build_ = 0.0;
  double since_update_ = 0.0;
  bool updated_ = false;  ///< since the last frame
  // Least squares through the origin with a start value, old samples fading.
  static constexpr double kStartSlope = 0.8;
  static constexpr double kStartWeight = 0.05;
  double slope_over_ = kStartSlope * kStartWeight;
  double slope_under_ = kStartWeight;
  double misfit_ = 0.1;  ///< usual distance of a sample from the line
};

}  // namespace encore::accel
