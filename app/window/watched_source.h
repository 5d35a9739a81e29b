#pragma once

#include "app/window/busy_marks.h"
#include "energy/sources/power_source.h"

#include <memory>
#include <optional>

namespace encore::app {

/// A source as the window reads it: at another pace, if one was asked for; and without a value
/// while two devices are busy at once, if it works by the busy marks (a power model, a simulated
/// sensor), which hold one device at a time.
class WatchedSource final : public energy::PowerSource {
 public:
  WatchedSource(std::unique_ptr<energy::PowerSource> source, std::optional<energy::Seconds> poll,
                std::shared_ptr<const BusyMarks> busy);

  [[nodiscard]] const energy::SourceInfo& info() const override { return info_; }
  energy::ReadResult read(energy::Seconds now) override;

 private:
  std::unique_ptr<energy::PowerSource> source_;
  energy::SourceInfo info_;
  std::shared_ptr<const BusyMarks> busy_;  ///< null: it does not work by marks
  std::optional<energy::Seconds> last_;
  bool refused_ = false;
};

}  // namespace encore::app
