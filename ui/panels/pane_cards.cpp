#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::ui {

namespace {

/// Shorter work is not worth a bar that flashes up.
constexpr double kShow_s = 0.3;

/// What a card over the picture says.
struct Card {
  std::string text;
  bool problem = false;
  const char* button = nullptr;
  const char* button_name = nullptr;
  const char* button_tip = nullptr;
  bool bar = false;
  const double* progress = nullptr;
};

/// At the top of the picture, or in the middle of the room where there is no picture.
Rect card_area(const Rect& room, const Card& card, bool over_picture) {
  const float em = ImGui::GetFontSize();
  const float width = std::min(room.width - em, em * 28.0F);
  const float inner = width - 2.0F * card_padding();
  const float spacing = ImGui::GetStyle().ItemSpacing.y;
  float height = ImGui::CalcTextSize(card.text.c_str(), nullptr, false, inner).y;
  if (card.bar || card.button != nullptr) height += spacing + ImGui::GetFrameHeight();
  height = std::round(height + 2.0F * card_padding() + 1.0F);
  const float y =
      over_picture ? room.y + em * 0.5F : room.y + std::max(0.0F, (room.height - height) * 0.5F);
  return {std::round(room.x + (room.width - width) * 0.5F), std::round(y), std::round(width),
          height};
}

/// True when its button is pressed.
bool draw_card(const Rect& room, const Card& card, const PaneContext& context) {
  const bool over_picture = context.shown().texture != 0;
  const Rect area = card_area(room, card, over_picture);
  bool pressed = false;
  if (area.width > ImGui::GetFontSize() && begin_card("state", area)) {
    const ThemeColors& colors = theme_colors(context.state.preferences.theme);
    ImGui::PushTextWrapPos(0.0F);
    colored_text(card.problem ? colors.problem : colors.text, card.text);
    ImGui::PopTextWrapPos();
    note_widget(context.name("state"), card.text);
    const float button_width = card.button != nullptr ? ImGui::CalcTextSize(card.button).x +
                                                            2.0F * ImGui::GetStyle().FramePadding.x
                                                      : 0.0F;
    if (card.bar) {
      const float spacing = ImGui::GetStyle().ItemSpacing.x;
      const float room_left = area.width - 2.0F * card_padding();
      progress_bar(card.button != nullptr ? room_left - button_width - spacing : room_left,
                   card.progress);
      if (card.button != nullptr) ImGui::SameLine();
    }
    if (card.button != nullptr) {
      pressed = ImGui::Button(card.button);
      note_widget(context.name(card.button_name));
      tooltip(card.button_tip);
    }
  }
  if (area.width > ImGui::GetFontSize()) end_card();
  return pressed;
}

void draw_work(const Rect& room, const PaneContext& context) {
  const WorkView& work = context.shown().work;
  Card card;
  card.text = work.doing.empty() ? "working" : work.doing;
  if (work.progress) card.text += fmt::format(", {:.0f} %", *work.progress * 100.0);
  card.text += fmt::format(" ({})", duration_text(std::floor(work.elapsed_s * 10.0) / 10.0));
  card.bar = true;
  card.progress = work.progress ? &*work.progress : nullptr;
  if (work.cancellable) {
    card.button = "Cancel";
    card.button_name = "cancel";
    card.button_tip = "Ends this work; what was there before stays. Escape does the same.";
  }
  if (draw_card(room, card, context)) context.commands.push_back(CancelWork{context.pane});
}

void draw_rebuild(const Rect& room, const PaneContext& context, Card card) {
  if (draw_card(room, card, context)) context.commands.push_back(Rebuild{context.pane});
}

std::string waiting_text(const PaneContext& context) {
  const View& view = context.view;
  if (view.scene.loading.active) {
    return "waiting for the scene: " + view.scene.loading.doing;
  }
  if (!view.scene.scene) {
    return view.scene.problem.empty() ? "no scene is open: File > Open scene, or drop a file here"
                                      : view.scene.problem;
  }
  if (view.measure.measuring) return "waiting for its slot: " + view.measure.doing;
  return "waiting";
}

}  // namespace

float card_padding() {
  return std::round(ImGui::GetFontSize() * 0.6F);
}

bool begin_card(const char* id, const Rect& area) {
  const float padding = card_padding();
  ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_PopupBg);
  ground.w = 0.92F;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ground);
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, padding * 0.5F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(padding, padding));
  ImGui::SetCursorScreenPos({area.x, area.y});
  const bool shown = ImGui::BeginChild(
      id, {area.width, area.height}, true,
      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
  return shown;
}

void end_card() {
  ImGui::EndChild();
}

void draw_pane_state(const Rect& room, const PaneContext& context) {
  const PaneView& shown = context.shown();
  if (shown.work.active) {
    // A picture that gets better by itself is not to be covered; the header says how far it is.
    const bool refining = shown.work.doing.starts_with("refining");
    if (shown.work.elapsed_s > kShow_s && !refining) draw_work(room, context);
    return;
  }
  switch (shown.state) {
    case PaneState::cancelled:
      return draw_rebuild(room, context,
                          {.text = "Cancelled. What was there before stays until it goes on.",
                           .button = "Go on",
                           .button_name = "go_on",
                           .button_tip = "Does what was cancelled after all."});
    case PaneState::failed:
      return draw_rebuild(
          room, context,
          {.text = shown.problem.empty() ? "This picture could not be made." : shown.problem,
           .problem = true,
           .button = "Try again",
           .button_name = "try_again",
           .button_tip = "Builds and traces again with what is set."});
    case PaneState::waiting:
      // In measure mode the picture of its last slot says enough.
      if (shown.texture == 0 || !context.view.measure.measuring) {
        draw_card(room, {.text = waiting_text(context)}, context);
      }
      return;
    case PaneState::off:
    case PaneState::working:
    case PaneState::ready:
      if (!shown.problem.empty()) {
        draw_card(room, {.text = shown.problem, .problem = true}, context);
      }
      return;
  }
}

void draw_no_panes(const Rect& area, UiState& state) {
  constexpr const char* kText = "Both panes are off: nothing is drawn or measured.";
  constexpr std::array<const char*, 2> kLabels{"Left pane: CPU", "Right pane: GPU"};
  constexpr std::array<const char*, 2> kTips{
      "The processor traces the scene in the left pane.",
      "The graphics device traces the scene in the right pane."};
  constexpr std::array kDevices{PaneDevice::cpu, PaneDevice::gpu};
  if (begin_part("##no panes", area)) {
    const float em = ImGui::GetFontSize();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float left = area.x + em;
    const float room = std::max(area.width - 2.0F * em, em);
    const auto button_width = [&](const char* label) {
      return ImGui::CalcTextSize(label).x + 2.0F * style.FramePadding.x;
    };
    const float both = button_width(kLabels[0]) + style.ItemSpacing.x + button_width(kLabels[1]);
    const ImVec2 words = ImGui::CalcTextSize(kText, nullptr, false, room);
    const float height = words.y + em * 0.6F + ImGui::GetFrameHeight();
    const float top = area.y + std::max(0.0F, (area.height - height) * 0.5F);
    ImGui::SetCursorScreenPos({left + std::max(0.0F, (room - words.x) * 0.5F), top});
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + words.x + 1.0F);
    colored_text(theme_colors(state.preferences.theme).dim_text, kText);
    ImGui::PopTextWrapPos();
    note_widget("panes.off", kText);
    ImGui::SetCursorScreenPos(
        {left + std::max(0.0F, (room - both) * 0.5F), top + words.y + em * 0.6F});
    for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
      if (pane > 0 && both <= room) ImGui::SameLine();
      if (pane > 0 && both > room) ImGui::SetCursorScreenPos({left, ImGui::GetCursorScreenPos().y});
      if (ImGui::Button(kLabels.at(pane))) state.settings.panes.at(pane).device = kDevices.at(pane);
      note_widget(fmt::format("panes.off.switch_on.{}", pane));
      tooltip(kTips.at(pane));
    }
  }
  ImGui::End();
}

}  // namespace encore::ui
