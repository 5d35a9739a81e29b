#pragma once

#include "energy/provenance.h"
#include "ui/view.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace encore::ui {

// What all columns and panes share. What they set of a value goes by reference and return: true in
// the frame in which it was changed.

/// Says on hovering for a moment what the last item is, with its unit; also where it is greyed.
/// Breaks lines.
void tooltip(const char* text);
void tooltip(const std::string& text);

/// The origin's word on a ground of its colour (measured green, modelled amber, simulated violet,
/// unavailable grey); what it rests on, or why there is nothing, is its tooltip.
void badge(const energy::Provenance& provenance);
float badge_width(const energy::Provenance& provenance);

/// "12.3 ±0.4 mJ"; "unavailable" without a value, never a 0 in its place.
std::string figure_text(const EnergyFigure& figure, const char* unit);

/// A count with its thousands apart: "1,087,716".
std::string count_text(std::uint64_t count);
/// "1.5 MiB", "312 bytes".
std::string bytes_text(std::uint64_t bytes);
/// "512 × 512".
std::string size_text(int width, int height);

/// The head of a part of a column that folds up; Dear ImGui remembers whether it is open. `name` is
/// that of the widget map, and its identity, whatever the title says. True while it is open.
bool section(const std::string& name, const std::string& title, const char* tip,
             bool open_at_first = true);
/// A smaller head inside a section; to be ended with ImGui::TreePop() if true.
bool begin_group(const std::string& name, const std::string& title, const char* tip,
                 bool open_at_first);

/// A row of a column: its name in the widget map, the label at its left, and what it means.
struct Row {
  std::string name;
  const char* label = "";
  std::string tip{};
};

/// The label, and the cursor at the control's place, whose width it sets. `kept_right`: pixels that
/// stay free at the right end.
void begin_row(const Row& row, float kept_right = 0.0F);
/// After the control: its tooltip and its place in the widget map.
void end_row(const Row& row, std::string_view state);

/// A text at the control's place, cut to the room there is; all of it is in the tooltip then.
void figure_row(const Row& row, const std::string& text);
/// A box to tick, with its label behind it.
bool toggle_row(const Row& row, bool& value);
/// A button as wide as its label.
bool text_button(const Row& row, bool enabled = true);
/// The same in the line of the last one if there is room, else in the next.
bool text_button_beside(const Row& row, bool enabled = true);

/// One entry of a list.
struct Choice {
  std::string_view word;  ///< as shown, and in the widget map: "<row>.<word>"
  const char* tip = "";
};
/// A list of which one entry is chosen; `shown` in the place of its word, if it is given.
bool choice_row(const Row& row, std::size_t& chosen, std::span<const Choice> choices,
                std::string_view shown = {});

/// The same over values: `entries` has members `value`, `word` and `tip`. A value that is not among
/// them is shown as the first one.
template <class Value, class Entries>
bool value_choice_row(const Row& row, Value& value, const Entries& entries);

/// When a number that is dragged takes effect.
enum class Commit {
  at_once,
  at_release,  ///< for what starts long work: once, when the mouse lets go or Enter is pressed
};

/// A number and how it is set.
template <class Number>
struct NumberRow {
  Row row;
  Number low{};
  Number high{};
  const char* format = nullptr;       ///< null: Dear ImGui's
  std::optional<Number> usual{};      ///< where it differs, a button brings it back
  bool logarithmic = false;           ///< for ranges over powers of ten
  std::optional<Number> most_slid{};  ///< where the slider ends; more, up to `high`, can be typed
  bool typed = false;                 ///< a field to type in, no slider
  Commit commit = Commit::at_release;
  const char* zero = nullptr;  ///< what 0 is shown as: "automatic"
};
/// A slider; Ctrl and a click type a number, which is brought into the range.
bool number_row(const NumberRow<float>& about, float& value);
bool number_row(const NumberRow<int>& about, int& value);

/// A small round arrow that brings the usual value back; as wide as reset_width().
bool reset_button(const std::string& name, const std::string& usual);
float reset_width();

/// Two ends on one track.
struct RangeRow {
  Row row;  ///< the ends are in the widget map as "<row>.low" and "<row>.high"
  double low = 0.0;
  double high = 1.0;
  bool whole = false;  ///< only whole numbers
  std::string unit{};
};
/// Keeps from <= to; each end stays within the range.
bool range_row(const RangeRow& about, double& from, double& to);

/// How far work is, with a button to end it where it can be ended. True if that is pressed.
bool progress_row(const std::string& name, const WorkView& work);
/// Lines over the column's width, broken where they must be; nothing for an empty text.
void problem_line(const std::string& text);
void hint_line(const std::string& text);

template <class Value, class Entries>
bool value_choice_row(const Row& row, Value& value, const Entries& entries) {
  constexpr std::size_t kMost = 16;
  Choice choices[kMost];
  std::size_t count = 0;
  std::size_t chosen = 0;
  for (const auto& entry : entries) {
    if (count == kMost) break;
    if (entry.value == value) chosen = count;
    choices[count++] = {entry.word, entry.tip};
  }
  if (!choice_row(row, chosen, std::span<const Choice>(choices, count))) return false;
  value = std::data(entries)[chosen].value;
  return true;
}

}  // namespace encore::ui
