#include "app/window/power_point.h"

#include <algorithm>

namespace encore::app {

PowerPoint PowerPoints::make(const energy::SourceInfo& info, const energy::ReadResult& result) {
  const energy::Reading& reading = result.reading;
  PowerPoint point{reading.time.value,
                   {},
                   reading.energy.value,
                   reading.changed,
                   result.state == energy::ReadState::restarted};
  if (reading.power) point.watts = reading.power->value;
  const auto anchor = std::find_if(anchors_.begin(), anchors_.end(),
                                   [&](const Anchor& one) { return one.source == info.name; });
  if (anchor == anchors_.end()) {
    anchors_.push_back({info.name, reading.time, reading.energy});
    point.gap = true;
    return point;
  }
  if (!info.is_counter) return point;
  const energy::Seconds length = reading.time - anchor->time;
  const bool falls = reading.energy < anchor->energy;
  if (point.gap || falls) {
    *anchor = {info.name, reading.time, reading.energy};
    point.gap = true;
  } else if (reading.changed && length >= info.update_period * 2.0 && length.value > 0) {
    // From change to change: between two of them a counter stands still, which is no power of 0.
    point.watts = ((reading.energy - anchor->energy) / length).value;
    *anchor = {info.name, reading.time, reading.energy};
  }
  return point;
}

}  // namespace encore::app
