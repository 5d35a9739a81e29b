#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_colors.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

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

/// The device as a coloured tag, which opens the list of devices.
void draw_device(const PaneContext& context) {
  PaneSettings& settings = context.settings();
  if (badge("##device", device_title(settings.device), device_color(settings.device))) {
    ImGui::OpenPopup("devices");
  }
  note_widget(context.name("device"), to_string(settings.device));
  if (!ImGui::IsPopupOpen("devices")) {
    hint(
        "Who draws this picture: the CPU or the GPU by tracing rays through the structure, or the "
        "GPU's rasteriser, which needs none. A click changes it.");
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

void draw_kind(const PaneContext& context, float width) {
  accel::StructureSpec& spec = context.settings().structure;
  const std::string now(accel::to_string(spec.kind));
  ImGui::SetNextItemWidth(width);
  const bool open = ImGui::BeginCombo("##kind", now.c_str());
  note_widget(context.name("structure"), now);
  if (!open) {
    tooltip("The acceleration structure that this pane's rays go through.");
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
  ImGui::SetNextItemWidth(width);
  const bool open = ImGui::BeginCombo("##content", now.c_str());
  note_widget(context.name("content"), now);
  if (!open) {
    tooltip(
        "picture: the shaded scene; heatmap: what each pixel's ray cost; difference: against the "
        "other pane's picture of the same size.");
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

/// What is to be seen now and passes: refining, whose slot it is. At the right end of the line.
void draw_passing(const PaneContext& context, float right) {
  const PaneView& shown = context.shown();
  std::string text;
  std::string why;
  ImVec4 color = theme_colors(context.state.preferences.theme).dim_text;
  if (context.view.measure.measuring) {
    text = shown.my_slot ? "its slot" : "waits for its slot";
    why =
        "In measure mode the panes run one after the other, so that a sensor which sees the whole "
        "machine can tell whose joules they are. " +
        context.view.measure.doing;
    if (shown.my_slot) color = device_color(context.settings().device);
  } else if (shown.traced_width > 0 && shown.traced_width < shown.width) {
    text = fmt::format("refining {}", size_text(shown.traced_width, shown.traced_height));
    why = fmt::format("A coarse picture of {} pixels is shown while that of {} is traced.",
                      size_text(shown.traced_width, shown.traced_height),
                      size_text(shown.width, shown.height));
  }
  if (text.empty()) return;
  ImGui::SameLine();
  const float room = right - ImGui::GetCursorScreenPos().x;
  if (room < ImGui::GetFontSize() * 2.0F) return;
  const std::string cut = fitted(text, room);
  ImGui::SetCursorScreenPos(
      {right - ImGui::CalcTextSize(cut.c_str()).x, ImGui::GetCursorScreenPos().y});
  ImGui::AlignTextToFramePadding();
  colored_text(color, cut);
  note_widget(context.name("passing"), text);
  hint(why);
}

/// One figure of the second line.
struct Figure {
  const char* name;
  std::string text;
  std::string tip;
  const EnergyFigure* energy = nullptr;
};

void add_share(std::string& lines, const char* phase, const std::optional<double>& seconds,
               double total) {
  if (!seconds) return;
  lines += fmt::format("\n{}: {}", phase, value_text(*seconds, "s", 3));
  if (total > 0.0) lines += fmt::format(" ({:.1f} %)", *seconds / total * 100.0);
}

Figure time_figure(const FrameFigures& frame) {
  const double total = frame.total_s();
  Figure figure{"ms", fmt::format("{} a frame", value_text(total, "s", 3)),
                "Time of the last whole frame, by the clock:"};
  add_share(figure.tip, "animate", frame.animate_s, total);
  add_share(figure.tip, "build", frame.build_s, total);
  add_share(figure.tip, "update", frame.update_s, total);
  add_share(figure.tip, "transfer", frame.transfer_s, total);
  add_share(figure.tip, "render", frame.render_s, total);
  if (frame.uploaded_bytes > 0) {
    figure.tip += "\nuploaded: " + bytes_text(frame.uploaded_bytes);
  }
  return figure;
}

std::vector<Figure> figures_of(const PaneView& shown) {
  std::vector<Figure> figures;
  if (shown.frame) figures.push_back(time_figure(*shown.frame));
  if (shown.frames_per_s) {
    figures.push_back({"fps", fmt::format("{:.1f} fps", *shown.frames_per_s),
                       "Frames a second that this pane's times allow."});
  }
  figures.push_back({"joules",
                     shown.joules_per_frame.value
                         ? figure_text(shown.joules_per_frame, "J") + " a frame"
                         : "energy",
                     "Joules a frame, idle power included, with the half-width of the 95 % "
                     "interval.\n" +
                         shown.joules_per_frame.provenance.detail,
                     &shown.joules_per_frame});
  if (shown.frame && shown.frame->rays > 0 && shown.frame->render_s &&
      *shown.frame->render_s > 0.0) {
    const double rate = static_cast<double>(shown.frame->rays) / *shown.frame->render_s;
    figures.push_back(
        {"rays", fmt::format("{:.3g} Mrays/s", rate / 1e6),
         fmt::format("Millions of rays a second while rendering: {} rays in {}.",
                     count_text(shown.frame->rays), value_text(*shown.frame->render_s, "s", 3))});
  }
  return figures;
}

/// As many figures as there is room for, the first ones first, then who draws.
void draw_figures(const PaneContext& context, float right) {
  const PaneView& shown = context.shown();
  const float gap = ImGui::GetFontSize() * 0.9F;
  bool first = true;
  for (const Figure& figure : figures_of(shown)) {
    const float badge_room =
        figure.energy != nullptr ? badge_width(figure.energy->provenance) + gap * 0.5F : 0.0F;
    const float width = ImGui::CalcTextSize(figure.text.c_str()).x + badge_room;
    if (!first) ImGui::SameLine(0.0F, gap);
    if (ImGui::GetCursorScreenPos().x + width > right) {
      if (first) ImGui::NewLine();
      return;
    }
    first = false;
    ImGui::TextUnformatted(figure.text.c_str());
    note_widget(context.name(figure.name), figure.text);
    hint(figure.tip);
    if (figure.energy != nullptr) {
      ImGui::SameLine(0.0F, gap * 0.5F);
      badge(figure.energy->provenance);
      note_widget(context.name("badge"), energy::to_string(figure.energy->provenance.origin));
    }
  }
  const float room = right - ImGui::GetItemRectMax().x - gap;
  if (shown.device.empty() || room < ImGui::GetFontSize() * 3.0F) return;
  ImGui::SameLine(0.0F, gap);
  const ThemeColors& colors = theme_colors(context.state.preferences.theme);
  colored_text(shown.software ? colors.warning : colors.dim_text, fitted(shown.device, room));
  note_widget(context.name("who"), shown.device);
  hint(shown.software ? shown.device +
                            "\nA rasteriser in software: it runs on the CPU, so its "
                            "times and joules are not those of a graphics card."
                      : shown.device);
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
  return std::round(ImGui::GetFrameHeight() + em * 1.85F);
}

void draw_pane_header(const Rect& area, const PaneContext& context) {
  const float em = ImGui::GetFontSize();
  const float inset = em * 0.5F;
  const float right = area.right() - inset;
  ImGui::SetCursorScreenPos({area.x + inset, area.y + std::round(em * 0.2F)});
  draw_device(context);
  const PaneDevice device = context.settings().device;
  const float room = std::max(right - ImGui::GetItemRectMax().x, em * 4.0F);
  if (traces(device)) {
    ImGui::SameLine();
    draw_kind(context, std::min(em * 8.0F, room * 0.45F));
  }
  if (device != PaneDevice::off) {
    ImGui::SameLine();
    draw_content(context, std::min(em * 7.0F, room * 0.4F));
    draw_passing(context, right);
    ImGui::SetCursorScreenPos(
        {area.x + inset, area.y + std::round(em * 0.4F + ImGui::GetFrameHeight())});
    draw_figures(context, right);
  }
}

}  // namespace encore::ui
