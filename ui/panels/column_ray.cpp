#include "accel/inspect/ray_path.h"
#include "ui/panels/column_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

namespace encore::ui {

namespace {

std::size_t step_count(const PickView& pick) {
  return pick.path ? pick.path->steps.size() : 0;
}

/// Goes to a step and selects its node.
void go_to(const ColumnContext& context, const PickView& pick, std::size_t step) {
  UiState& state = context.state;
  state.ray_step = std::min(step, std::max<std::size_t>(step_count(pick), 1) - 1);
  if (pick.pane != state.inspected_pane || state.ray_step >= pick.nodes.size()) return;
  if (const auto& node = pick.nodes[state.ray_step]) select_node(state, *node);
}

std::string sentence_of(const PickView& pick, std::size_t step) {
  if (step >= pick.sentences.size()) return {};
  return pick.sentences[step];
}

std::string all_text(const PickView& pick) {
  std::string text =
      fmt::format("pixel {}, {}: {}\n", pick.pixel.x, pick.pixel.y, accel::summary(*pick.path));
  for (std::size_t i = 0; i < pick.sentences.size(); ++i) {
    text += fmt::format("{}. {}\n", i + 1, pick.sentences[i]);
  }
  return text;
}

void draw_summary(const ColumnContext& context, const PickView& pick) {
  const std::string text =
      fmt::format("Pixel {}, {}: {}", pick.pixel.x, pick.pixel.y, accel::summary(*pick.path));
  ImGui::TextWrapped("%s", text.c_str());
  note_widget("ray.summary", text);
  tooltip("Distances in world units from the eye; steps are nodes or cells that were entered.");
  if (!pick.pixel.material.empty()) {
    const std::string material = "material " + pick.pixel.material;
    colored_text(theme_colors(context.state.preferences.theme).dim_text,
                 fitted(material, ImGui::GetContentRegionAvail().x));
    tooltip(material);
  }
}

void draw_buttons(const ColumnContext& context, const PickView& pick) {
  const std::size_t count = step_count(pick);
  const std::size_t step = context.state.ray_step;
  const auto button = [](const char* label, const char* name, const char* tip) {
    const bool pressed = ImGui::Button(label);
    note_widget(name);
    tooltip(tip);
    ImGui::SameLine();
    return pressed;
  };
  if (button("|<", "ray.first", "The first step.")) go_to(context, pick, 0);
  if (button("<", "ray.previous", "One step back: Left.") && step > 0) {
    go_to(context, pick, step - 1);
  }
  if (button(">", "ray.next", "One step on: Right.")) go_to(context, pick, step + 1);
  if (button(">|", "ray.last", "The last step.")) go_to(context, pick, count - 1);
  if (button("Copy", "ray.copy", "Copies all steps as text.")) {
    context.commands.push_back(CopyText{all_text(pick), "ray copied"});
  }
  if (button("×", "ray.clear", "Lets go of this ray: Escape.")) {
    context.commands.push_back(ClearPick{});
  }
  const std::string at =
      fmt::format("{} of {}", count_text(context.state.ray_step + 1), count_text(count));
  // In the next line where there is no room behind the buttons.
  if (ImGui::CalcTextSize(at.c_str()).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
  ImGui::TextUnformatted(at.c_str());
  note_widget("ray.step", at);
  tooltip("The step that is shown, of all that were kept.");
}

void draw_step(const ColumnContext& context, const PickView& pick, std::size_t step) {
  const bool current = step == context.state.ray_step;
  const std::string sentence = sentence_of(pick, step);
  const std::string all = fmt::format("{}. {}", step + 1, sentence.empty() ? "…" : sentence);
  const std::string cut = fitted(all, ImGui::GetContentRegionAvail().x);
  if (ImGui::Selectable(fmt::format("{}###{}", cut, step).c_str(), current)) {
    go_to(context, pick, step);
    context.state.inspect.seen_step = context.state.ray_step;
  }
  note_widget(fmt::format("ray.step.{}", step), current ? "selected" : "");
  if (cut != all) tooltip(all);
}

void draw_steps(const ColumnContext& context, const PickView& pick) {
  if (ImGui::BeginChild("steps", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoNav)) {
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const std::size_t step = context.state.ray_step;
    if (context.state.inspect.seen_step != step) {
      context.state.inspect.seen_step = step;
      const float at = static_cast<float>(step) * line;
      const float height = ImGui::GetWindowHeight();
      if (at < ImGui::GetScrollY() || at + line > ImGui::GetScrollY() + height) {
        ImGui::SetScrollY(std::max(0.0F, at - height * 0.5F));
      }
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(step_count(pick)), line);
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        draw_step(context, pick, static_cast<std::size_t>(i));
      }
    }
  }
  ImGui::EndChild();
}

bool arrow_pressed(ImGuiKey key) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), true);
}

}  // namespace

void handle_ray_keys(const ColumnContext& context) {
  if (!context.view.pick || step_count(*context.view.pick) == 0) return;
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyCtrl || io.KeyAlt || io.KeyShift || ImGui::IsAnyItemActive()) {
    return;
  }
  const PickView& pick = *context.view.pick;
  const std::size_t step = context.state.ray_step;
  if (arrow_pressed(ImGuiKey_LeftArrow) && step > 0) go_to(context, pick, step - 1);
  if (arrow_pressed(ImGuiKey_RightArrow)) go_to(context, pick, step + 1);
}

void draw_ray(const ColumnContext& context) {
  if (!context.view.pick) {
    return draw_missing(context, "ray.none",
                        "No ray was picked. Click a pixel in a pane to follow its ray.");
  }
  const PickView& pick = *context.view.pick;
  if (!pick.path || !pick.path->recorded) {
    return draw_missing(context, "ray.none", "This structure cannot tell what a ray does.");
  }
  draw_summary(context, pick);
  draw_buttons(context, pick);
  ImGui::Separator();
  draw_steps(context, pick);
}

}  // namespace encore::ui
