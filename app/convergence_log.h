#pragma once

#include "energy/convergence/stop_rule.h"
#include "energy/plan.h"
#include "energy/runner.h"
#include "energy/session_csv.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// Feeds the joules of several sources into one tracker, as one sum at the slowest one's times.
class TotalEnergy {
 public:
  TotalEnergy(const energy::Sampler& sampler, std::vector<std::size_t> total,
              energy::Seconds start);

  /// The source whose beat the sum follows.
  [[nodiscard]] const energy::SourceInfo& slowest() const;
  /// Tells every point of the sum that is new.
  void tell_new(const std::function<void(const energy::TracePoint&)>& tell);

 private:
  const energy::Sampler& sampler_;
  std::vector<std::size_t> total_;
  std::size_t slowest_ = 0;
  energy::Seconds reached_;
  energy::Joules sum_;
  bool first_ = true;
};

/// A point of a figure's history as a row of convergence.csv.
energy::ConvergenceRow convergence_row(const energy::ConvergencePoint& point,
                                       const std::vector<energy::KeyValue>& configuration);

/// How well the figures of one configuration are known while it is measured: rows of
/// convergence.csv, and the stop rule of a plan with `until`.
class ConvergenceLog {
 public:
  /// `sampler` is null if there is no power source.
  ConvergenceLog(const energy::Plan& plan, const energy::Sampler* sampler,
                 const std::vector<std::size_t>& total, energy::Seconds start);

  /// A row that ended now; true if there are new points.
  bool add(const energy::FrameRow& row, energy::Seconds now);
  /// Whether the plan's `until` is reached, or cannot be.
  [[nodiscard]] bool enough(energy::Seconds now);
  /// "±1 % needs about 212 s", while a plan with `until` runs; empty without one.
  [[nodiscard]] const std::string& words() const { return words_; }
  /// The first prediction of how long `until` takes, once, when it is made.
  std::optional<energy::Seconds> new_prediction();
  /// How `until` ended, as one sentence; empty without one.
  [[nodiscard]] std::string verdict(energy::Seconds now) const;

  /// The points so far, as rows of a file.
  [[nodiscard]] std::vector<energy::ConvergenceRow> rows(
      const std::vector<energy::KeyValue>& configuration) const;

 private:
  energy::Seconds start_;
  std::optional<energy::StopRule> rule_;
  std::optional<TotalEnergy> energy_;
  energy::ConvergenceTracker tracker_;
  energy::StopOutlook outlook_;
  std::optional<energy::Seconds> first_prediction_;
  bool prediction_told_ = false;
  std::optional<energy::Seconds> hopeless_since_;
  std::string words_;
};

}  // namespace encore::app
