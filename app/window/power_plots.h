#pragma once

#include "app/window/opened_session.h"
#include "app/window/power_monitor.h"
#include "ui/plot/sample_history.h"
#include "ui/view.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace encore::app {

/// The histories of power that the plots draw: one a source, fed by what the monitor drained or
/// from a session that was opened. Used by the window's thread.
class PowerPlots {
 public:
  /// Takes over what came in since the last call.
  void add(const PowerNews& news, const PowerState& state);
  /// The series as panels see them; valid until the next add() or clear().
  [[nodiscard]] std::vector<ui::PowerSeriesView> views(const PowerState& state) const;

  /// Replaces everything by the series of a recorded session.
  void show(const OpenedSession& session);
  [[nodiscard]] std::vector<ui::PowerSeriesView> views(const OpenedSession& session) const;

  [[nodiscard]] const std::vector<MonitorEvent>& events() const { return events_; }

 private:
  struct Series {
    std::unique_ptr<ui::SampleHistory> history;
    std::optional<double> watts;
    bool gap = false;  ///< before the next point that has a value
  };
  static void append(Series& series, const PowerPoint& point);

  std::map<std::uint32_t, Series> series_;
  std::vector<MonitorEvent> events_;
};

}  // namespace encore::app
