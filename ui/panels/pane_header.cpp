#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_colors.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace encore::ui {

namespace {

constexpr std::array kDevices{PaneDevice::off, PaneDevice::cpu, PaneDevice::gpu,
                              PaneDevice::raster};

bool traces(PaneDevice device) {
  return device == PaneDevice::cpu || device == PaneDevice::gpu;
}

/// Another device keeps what applies to it.
void choose_device(PaneSettings& settings, PaneDevice device) {
  settings.device = device;
  if (!traces(device) && settings.content == PaneContent::heatmap) {
    settings.content = PaneContent::picture;
  }
}

/// Another structure keeps the settings that both kinds have.
void choose_kind(accel::StructureSpec& spec, accel::StructureKind kind) {
  const accel::StructureSpec usual = accel::default_spec(kind);
  spec.kind = kind;
  if (spec.settings.index() != usual.settings.index()) spec.settings = usual.settings;
}

std::string who_text(const PaneView& shown) {
  if (!shown.software) return shown.device;
  return shown.device +
         "\nA rasteriser in software: it runs on the CPU, so its times and joules are not those of "
         "a graphics card.";
}

/// The device as a coloured tag, which opens the list of devices.
void draw_device(const PaneContext& context) {
  PaneSettings& settings = context.settings();
  if (badge("##device", device_title(settings.device), device_color(settings.device))) {
    ImGui::OpenPopup("devices");
  }
  note_widget(context.name("device"), to_string(settings.device));
  if (!ImGui::IsPopupOpen("devices")) {
    std::string tip =
        "Who draws this picture: the CPU or the GPU by tracing rays through the structure, or the "
        "GPU's rasteriser, which needs none. A click changes it.";
    if (!context.shown().device.empty()) tip += "\nNow: " + who_text(context.shown());
    hint(tip);
  }
  if (!ImGui::BeginPopup("devices")) return;
  for (const PaneDevice device : kDevices) {
    if (ImGui::Selectable(device_title(device), device == settings.device)) {
      choose_device(settings, device);
    }
    note_widget(context.name("device.") + std::string(to_string(device)),
                device == settings.device ? "on" : "off");
  }
  ImGui::EndPopup();
}

/// How wide a combo is that shows all of a text.
float combo_width(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x + 2.0F * ImGui::GetStyle().FramePadding.x +
         ImGui::GetFrameHeight();
}

/// A combo as wide as there is room: its text is cut with an ellipsis, or only its arrow is left.
bool begin_combo(const char* id, const std::string& now, float width) {
  const float arrow = ImGui::GetFrameHeight();
  const float words = width - (combo_width(now) - ImGui::CalcTextSize(now.c_str()).x);
  ImGui::SetNextItemWidth(width);
  if (words < arrow) return ImGui::BeginCombo(id, nullptr, ImGuiComboFlags_NoPreview);
  return ImGui::BeginCombo(id, fitted(now, words).c_str());
}

void draw_kind(const PaneContext& context, float width) {
  accel::StructureSpec& spec = context.settings().structure;
  const std::string now(accel::to_string(spec.kind));
  const bool open = begin_combo("##kind", now, width);
  note_widget(context.name("structure"), now);
  if (!open) {
    tooltip(now + ": the acceleration structure that this pane's rays go through.");
    return;
  }
  for (const accel::StructureKind kind : accel::all_structure_kinds()) {
    const std::string name(accel::to_string(kind));
    if (ImGui::Selectable(name.c_str(), kind == spec.kind)) choose_kind(spec, kind);
    note_widget(context.name("structure.") + name);
  }
  ImGui::EndCombo();
}

void draw_content(const PaneContext& context, float width) {
  constexpr std::array kContents{PaneContent::picture, PaneContent::heatmap,
                                 PaneContent::difference};
  PaneSettings& settings = context.settings();
  const std::string now(to_string(settings.content));
  const bool open = begin_combo("##content", now, width);
  note_widget(context.name("content"), now);
  if (!open) {
    tooltip(fmt::format(
        "Shows the {} now. picture: the shaded scene; heatmap: what each pixel's ray cost; "
        "difference: against the other pane's picture of the same size.",
        now));
    return;
  }
  for (const PaneContent content : kContents) {
    if (content == PaneContent::heatmap && !traces(settings.device)) continue;
    const std::string name(to_string(content));
    if (ImGui::Selectable(name.c_str(), content == settings.content)) settings.content = content;
    note_widget(context.name("content.") + name);
  }
  ImGui::EndCombo();
}

/// The choices behind the device: where there is no room for both, the content's is an arrow only.
void draw_choices(const PaneContext& context, float right) {
  const float em = ImGui::GetFontSize();
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float arrow = ImGui::GetFrameHeight();
  const float content = std::max(combo_width("difference"), em * 7.0F);
  float room = right - ImGui::GetItemRectMax().x - spacing;
  const PaneSettings& settings = context.settings();
  if (traces(settings.device)) {
    room -= spacing;
    const float words = combo_width(std::string(accel::to_string(settings.structure.kind)));
    float kind = std::max(words, em * 8.0F);
    if (kind + content > room)
      kind = words + content > room ? std::min(words, room - arrow) : words;
    kind = std::max(kind, arrow);
    ImGui::SameLine();
    draw_kind(context, kind);
    room -= kind;
  }
  ImGui::SameLine();
  draw_content(context, room >= content ? content : arrow);
}

/// Who draws, at the end of the line if there is room for some of it.
void draw_who(const PaneContext& context, float right) {
  const PaneView& shown = context.shown();
  const float gap = ImGui::GetFontSize() * 0.9F;
  const float room = right - ImGui::GetItemRectMax().x - gap;
  if (shown.device.empty() || room < ImGui::GetFontSize() * 4.0F) return;
  ImGui::SameLine(0.0F, gap);
  ImGui::AlignTextToFramePadding();
  const ThemeColors& colors = theme_colors(context.state.preferences.theme);
  colored_text(shown.software ? colors.warning : colors.dim_text, fitted(shown.device, room));
  note_widget(context.name("who"), shown.device);
  hint(who_text(shown));
}

}  // namespace

std::string PaneContext::name(const char* part) const {
  return fmt::format("pane.{}.{}", pane, part);
}

const char* device_title(PaneDevice device) {
  switch (device) {
    case PaneDevice::off:
      return "OFF";
    case PaneDevice::cpu:
      return "CPU";
    case PaneDevice::gpu:
      return "GPU";
    case PaneDevice::raster:
      return "RASTER";
  }
  return "";
}

ImVec4 device_color(PaneDevice device) {
  if (device == PaneDevice::off) return ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
  const PlotColor color = device == PaneDevice::cpu   ? PlotColor::cpu
                          : device == PaneDevice::gpu ? PlotColor::gpu
                                                      : PlotColor::raster;
  return ImGui::ColorConvertU32ToFloat4(plot_color(color));
}

float pane_header_height() {
  const float em = ImGui::GetFontSize();
  return std::round(ImGui::GetFrameHeight() + em * 0.5F + 2.0F * pane_header_line());
}

float pane_header_line() {
  return std::round(ImGui::GetFontSize() * 1.35F);
}

void draw_pane_header(const Rect& area, const PaneContext& context) {
  const float em = ImGui::GetFontSize();
  const float inset = em * 0.5F;
  const float right = area.right() - inset;
  ImGui::SetCursorScreenPos({area.x + inset, area.y + std::round(em * 0.2F)});
  draw_device(context);
  if (context.settings().device == PaneDevice::off) return;
  draw_choices(context, right);
  draw_who(context, right);
  const float top = area.y + std::round(em * 0.4F + ImGui::GetFrameHeight());
  draw_pane_figures({area.x + inset, top, right - area.x - inset, area.bottom() - top}, context);
}

}  // namespace encore::ui
