#pragma once

#include "app/window/power_set.h"
#include "app/window/slots.h"
#include "energy/row_builder.h"

#include <memory>
#include <optional>

namespace encore::app {

/// Gathers the operations of one slot into rows of frames.csv, as the command line's runner does.
class SlotRows {
 public:
  /// `row`: the time that a row has to fill at least.
  SlotRows(const Slot& slot, std::shared_ptr<const PowerSet> power, const energy::Clock& clock,
           energy::Seconds row);
  ~SlotRows();
  SlotRows(const SlotRows&) = delete;
  SlotRows& operator=(const SlotRows&) = delete;

  /// An operation starts now: begins a row if none is under way.
  void begin();
  /// Adds an operation that has just ended; the row that it filled. `edges`: sources were read at
  /// the edges of its phases.
  std::optional<energy::FrameRow> add(const Operation& operation, bool edges);
  /// The row under way; nothing if it is empty.
  std::optional<energy::FrameRow> finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace encore::app
