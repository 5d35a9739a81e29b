#include "ui/plot/value_text.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace encore::ui {

namespace {

/// Numbers stand over the grabs and have to be read there.
constexpr float kGrabAlpha = 0.6F;

std::string hidden_label(const Row& row) {
  return "##" + row.name;
}

/// What a number shows while it is held: kept in Dear ImGui's storage from frame to frame, and
/// forgotten as soon as the widget was not drawn or not held.
template <class Number>
class Held {
 public:
  Held(const std::string& name, Number value) : value_(value) {
    const ImGuiID id = ImGui::GetID(name.c_str());
    frame_ = id + 1;
    number_ = id + 2;
    const ImGuiStorage& storage = *ImGui::GetStateStorage();
    if (storage.GetInt(frame_, -9) != ImGui::GetFrameCount() - 1) return;
    if constexpr (std::is_same_v<Number, float>) {
      value_ = storage.GetFloat(number_, value);
    } else {
      value_ = storage.GetInt(number_, value);
    }
  }

  Number& value() { return value_; }

  /// After the widget was drawn.
  void keep_if_held() {
    if (!ImGui::IsItemActive()) return;
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    storage.SetInt(frame_, ImGui::GetFrameCount());
    if constexpr (std::is_same_v<Number, float>) {
      storage.SetFloat(number_, value_);
    } else {
      storage.SetInt(number_, value_);
    }
  }

 private:
  Number value_;
  ImGuiID frame_ = 0;
  ImGuiID number_ = 0;
};

/// `beyond`: numbers that are typed may lie outside the slider's own range.
ImGuiSliderFlags slider_flags(bool logarithmic, bool beyond) {
  ImGuiSliderFlags flags = beyond ? 0 : ImGuiSliderFlags_AlwaysClamp;
  if (logarithmic) flags |= ImGuiSliderFlags_Logarithmic;
  return flags;
}

template <class Number>
std::string number_text(const NumberRow<Number>& about, Number value) {
  if (about.zero != nullptr && value == Number{}) return about.zero;
  return fmt::format("{}", value);
}

bool draw_number(const NumberRow<float>& about, float& value) {
  const std::string label = hidden_label(about.row);
  const char* format = about.format != nullptr ? about.format : "%.3g";
  if (about.typed) return ImGui::InputFloat(label.c_str(), &value, 0.0F, 0.0F, format);
  if (about.zero != nullptr && value == 0.0F) format = about.zero;
  return ImGui::SliderFloat(label.c_str(), &value, about.low, about.most_slid.value_or(about.high),
                            format, slider_flags(about.logarithmic, about.most_slid.has_value()));
}

bool draw_number(const NumberRow<int>& about, int& value) {
  const std::string label = hidden_label(about.row);
  if (about.typed) return ImGui::InputInt(label.c_str(), &value, 0, 0);
  const char* format = about.format != nullptr ? about.format : "%d";
  if (about.zero != nullptr && value == 0) format = about.zero;
  return ImGui::SliderInt(label.c_str(), &value, about.low, about.most_slid.value_or(about.high),
                          format, slider_flags(about.logarithmic, about.most_slid.has_value()));
}

template <class Number>
bool number_row_of(const NumberRow<Number>& about, Number& value) {
  const float spacing = ImGui::GetStyle().ItemInnerSpacing.x;
  begin_row(about.row, about.usual ? reset_width() + spacing : 0.0F);
  Held<Number> held(about.row.name, value);
  ImGui::PushStyleColor(ImGuiCol_SliderGrab, ImGui::GetColorU32(ImGuiCol_SliderGrab, kGrabAlpha));
  ImGui::PushStyleColor(ImGuiCol_SliderGrabActive,
                        ImGui::GetColorU32(ImGuiCol_SliderGrabActive, kGrabAlpha));
  const bool moved = draw_number(about, held.value());
  ImGui::PopStyleColor(2);
  held.keep_if_held();
  bool changed = about.commit == Commit::at_once ? moved : ImGui::IsItemDeactivatedAfterEdit();
  const Number wanted = std::clamp(held.value(), about.low, about.high);
  changed = changed && wanted != value;
  if (changed) value = wanted;
  end_row(about.row, number_text(about, value));
  if (!about.usual || value == *about.usual) return changed;
  ImGui::SameLine(0.0F, spacing);
  if (reset_button(about.row.name + ".reset", number_text(about, *about.usual))) {
    value = *about.usual;
    changed = true;
  }
  return changed;
}

/// The end of a range that the mouse holds: 0 none, 1 the lower, 2 the upper.
void drag_range(const RangeRow& about, const ImVec2& at, float width, float grab, double& from,
                double& to) {
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID(("held " + about.row.name).c_str());
  const double span = about.high - about.low;
  const double travel = std::max(double(width - 2.0F * grab), 1.0);
  const auto place = [&](double value, double offset) {
    return double(at.x) + offset + (value - about.low) / span * travel;
  };
  const double mouse = double(ImGui::GetIO().MousePos.x);
  if (ImGui::IsItemActivated()) {
    const double to_low = std::abs(mouse - place(from, double(grab) * 0.5));
    const double to_high = std::abs(mouse - place(to, double(grab) * 1.5));
    storage.SetInt(id, to_low < to_high ? 1 : 2);
  }
  const int held = storage.GetInt(id, 0);
  const double offset = double(grab) * (held == 1 ? 0.5 : 1.5);
  double value = about.low + (mouse - double(at.x) - offset) / travel * span;
  if (about.whole) value = std::round(value);
  value = std::clamp(value, about.low, about.high);
  if (held == 1) from = std::min(value, to);
  if (held == 2) to = std::max(value, from);
}

}  // namespace

bool choice_row(const Row& row, std::size_t& chosen, std::span<const Choice> choices,
                std::string_view shown) {
  begin_row(row);
  const std::string now(!shown.empty()            ? shown
                        : chosen < choices.size() ? choices[chosen].word
                                                  : std::string_view());
  const bool open = ImGui::BeginCombo(hidden_label(row).c_str(), now.c_str());
  note_widget(row.name, now);
  if (!open) {
    const char* of_choice = chosen < choices.size() ? choices[chosen].tip : "";
    tooltip(*of_choice == '\0' ? row.tip : fmt::format("{}\n\n{}: {}", row.tip, now, of_choice));
    return false;
  }
  bool changed = false;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const std::string word(choices[i].word);
    if (ImGui::Selectable(word.c_str(), i == chosen)) {
      changed = i != chosen || now != word;
      chosen = i;
    }
    note_widget(row.name + "." + word, i == chosen ? "on" : "off");
    tooltip(choices[i].tip);
  }
  ImGui::EndCombo();
  return changed;
}

bool number_row(const NumberRow<float>& about, float& value) {
  return number_row_of(about, value);
}

bool number_row(const NumberRow<int>& about, int& value) {
  return number_row_of(about, value);
}

float reset_width() {
  return ImGui::GetFontSize() * 1.1F;
}

bool reset_button(const std::string& name, const std::string& usual) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size{reset_width(), ImGui::GetFrameHeight()};
  const bool pressed = ImGui::InvisibleButton(("##" + name).c_str(), size);
  note_widget(name, usual);
  const bool hovered = ImGui::IsItemHovered();
  tooltip(fmt::format("Back to the usual value: {}", usual));
  // Three quarters of a ring that end in an arrow's head.
  const ImU32 color = ImGui::GetColorU32(hovered ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  const ImVec2 middle{at.x + size.x * 0.5F, at.y + size.y * 0.5F};
  const float radius = ImGui::GetFontSize() * 0.3F;
  constexpr float kPi = std::numbers::pi_v<float>;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PathArcTo(middle, radius, -0.75F * kPi, 0.75F * kPi, 16);
  list.PathStroke(color, 0, std::max(1.0F, ImGui::GetFontSize() * 0.09F));
  const ImVec2 end{middle.x - radius * 0.7071F, middle.y - radius * 0.7071F};
  const float head = radius * 0.75F;
  list.AddTriangleFilled({end.x - head, end.y + head * 0.5F}, {end.x - head * 0.4F, end.y - head},
                         {end.x + head * 0.7F, end.y + head * 0.7F}, color);
  return pressed;
}

bool range_row(const RangeRow& about, double& from, double& to) {
  begin_row(about.row);
  const float width = ImGui::CalcItemWidth();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  ImGui::InvisibleButton(hidden_label(about.row).c_str(), {width, height});
  const bool active = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();
  const double old_from = from;
  const double old_to = to;
  const float grab = std::round(ImGui::GetStyle().GrabMinSize * 0.9F);
  from = std::clamp(from, about.low, about.high);
  to = std::clamp(to, from, about.high);
  const double clamped_from = from;
  const double clamped_to = to;
  const double span = about.high - about.low;
  if (active && span > 0.0) drag_range(about, at, width, grab, from, to);
  const bool changed = from != clamped_from || to != clamped_to;

  const float travel = width - 2.0F * grab;
  const float x0 = at.x + (span > 0.0 ? float((from - about.low) / span) : 0.0F) * travel;
  const float x1 = at.x + grab + (span > 0.0 ? float((to - about.low) / span) : 1.0F) * travel;
  const auto end_text = [&](double value) {
    return about.whole ? fmt::format("{:.0f}", value) : value_text(value, about.unit, 3);
  };
  const std::string text = end_text(from) + " … " + end_text(to);
  end_row(about.row, text);
  if (ImGui::IsItemVisible()) {
    note_area(about.row.name + ".low", x0, at.y, grab, height, fmt::format("{:.6g}", from));
    note_area(about.row.name + ".high", x1, at.y, grab, height, fmt::format("{:.6g}", to));
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding;
  const ImU32 ground = ImGui::GetColorU32(hovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg);
  list.AddRectFilled(at, {at.x + width, at.y + height}, ground, rounding);
  const ImU32 mark =
      ImGui::GetColorU32(active ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab, kGrabAlpha);
  list.AddRectFilled({x0, at.y}, {x1 + grab, at.y + height}, ImGui::GetColorU32(ImGuiCol_Header),
                     rounding);
  list.AddRectFilled({x0, at.y + 2.0F}, {x0 + grab, at.y + height - 2.0F}, mark, rounding);
  list.AddRectFilled({x1, at.y + 2.0F}, {x1 + grab, at.y + height - 2.0F}, mark, rounding);
  const ImVec2 words = ImGui::CalcTextSize(text.c_str());
  list.AddText({at.x + (width - words.x) * 0.5F, at.y + (height - words.y) * 0.5F},
               ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  // What is merely out of the track stays as it was set.
  if (!changed) {
    from = old_from;
    to = old_to;
  }
  return changed;
}

}  // namespace encore::ui
