#pragma once

#include "ui/settings.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

namespace encore::ui {

/// In words what changed between two settings: "structure of pane CPU: kd-sah", "overlay: on",
/// "several settings". Empty if nothing did. Whether the animation plays counts as no change.
std::string change_name(const Settings& before, const Settings& after);

/// Brings settings back. One step is what changed between two frames in which no widget was held,
/// so that a drag of a slider is one step. Whether the animation plays is not brought back: undo
/// would else start it.
class History {
 public:
  /// Older steps than `most` are forgotten.
  explicit History(std::size_t most = 200) : most_(most) {}

  /// To be told once a frame; `busy`: a widget is held or text is being typed. The first call says
  /// what there is to begin with. A change ends what could be redone.
  void observe(const Settings& now, bool busy);

  /// The settings before the last step, nothing if there is none; a change that was not observed
  /// yet is a step, too.
  std::optional<Settings> undo(const Settings& now);
  /// The settings after the step that was last undone.
  std::optional<Settings> redo(const Settings& now);

  [[nodiscard]] bool can_undo() const { return done_ > 0; }
  [[nodiscard]] bool can_redo() const { return done_ < steps_.size(); }
  /// What undo() and redo() would bring back; empty if nothing.
  [[nodiscard]] std::string undo_name() const;
  [[nodiscard]] std::string redo_name() const;
  [[nodiscard]] std::size_t size() const { return steps_.size(); }

 private:
  struct Step {
    Settings before;
    Settings after;
    std::string name;
  };
  std::size_t most_;
  std::deque<Step> steps_;
  std::size_t done_ = 0;  ///< steps that are in effect
  std::optional<Settings> last_;
};

}  // namespace encore::ui
