#include "ui/panels/panels.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace encore::ui {

namespace {

struct Doing {
  const WorkView* work;
  std::string where;
  std::optional<Command> cancel;
};

/// All that goes on, the most interesting first.
std::vector<Doing> what_goes_on(const View& view) {
  std::vector<Doing> all;
  const auto add = [&](const WorkView& work, std::string where, Command cancel) {
    if (!work.active) return;
    std::optional<Command> way_out;
    if (work.cancellable) way_out = std::move(cancel);
    all.push_back({&work, std::move(where), std::move(way_out)});
  };
  add(view.scene.loading, "scene", CancelWork{});
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    add(view.panes[pane].work, pane == 0 ? "left pane" : "right pane", CancelWork{pane});
  }
  add(view.session.reading, "session", CancelSession{});
  add(view.doctor.work, "sensors", ExamineSensors{true});
  return all;
}

void draw_work(const Doing& doing, std::size_t others, Commands& commands) {
  const float em = ImGui::GetFontSize();
  const WorkView& work = *doing.work;
  progress_bar(em * 8.0F, work.progress ? &*work.progress : nullptr);
  note_widget("status.progress",
              work.progress ? fmt::format("{:.0f} %", *work.progress * 100.0) : "unknown");
  hint("How much of it is done, where that can be told.");
  ImGui::SameLine();
  if (doing.cancel) {
    if (ImGui::SmallButton("Cancel")) commands.push_back(*doing.cancel);
    note_widget("status.cancel");
    hint("Ends this work. Escape does the same.");
    ImGui::SameLine();
  }
  std::string text = fmt::format("{}: {}", doing.where, work.doing);
  if (work.progress) text += fmt::format(", {:.0f} %", *work.progress * 100.0);
  if (work.elapsed_s >= 1.0) text += fmt::format(", {:.0f} s", work.elapsed_s);
  if (others > 0) text += fmt::format("; {} more", others);
  ImGui::TextUnformatted(text.c_str());
  note_widget("status.text", text);
}

/// Of the pixel that the mouse is at now: what is known of it may be of where the mouse was.
std::string hover_text(const View& view, const UiState& state) {
  if (!state.inspect.hovered) return {};
  const PaneView& pane = view.panes.at(state.inspect.hovered->pane);
  if (!pane.hover) return {};
  const PixelView& pixel = *pane.hover;
  const std::string cost = fmt::format("{} steps, {} box tests, {} triangle tests", pixel.steps,
                                       pixel.box_tests, pixel.triangle_tests);
  if (!pixel.found) return fmt::format("pixel {}, {}: no hit · {}", pixel.x, pixel.y, cost);
  std::string what = fmt::format("triangle {}", pixel.triangle);
  if (!pixel.material.empty()) what += ", " + pixel.material;
  return fmt::format("pixel {}, {}: {}, distance {:.4g} · {}", pixel.x, pixel.y, what,
                     pixel.distance, cost);
}

std::string idle_text(const View& view, const UiState& state) {
  if (!view.scene.problem.empty()) return view.scene.problem;
  if (view.measure.measuring) return "measuring: " + view.measure.doing;
  if (const std::string hover = hover_text(view, state); !hover.empty()) return hover;
  if (!view.scene.scene) return "no scene; Ctrl+O opens one";
  return "ready";
}

/// What this machine lacks, and the recording; one short piece each.
struct Piece {
  const char* name;
  std::string text;
  std::string tip;
  ImVec4 color;
};
std::vector<Piece> lasting_pieces(const View& view, const ThemeColors& colors) {
  std::vector<Piece> pieces;
  const RecorderView& recorder = view.recorder;
  if (recorder.state == RecorderView::State::recording ||
      recorder.state == RecorderView::State::paused) {
    const bool paused = recorder.state == RecorderView::State::paused;
    pieces.push_back({"status.recorder",
                      fmt::format("{} {:.0f} s, {} rows", paused ? "paused" : "● recording",
                                  recorder.seconds, recorder.rows),
                      "Written to " + recorder.folder, paused ? colors.warning : colors.problem});
  } else if (recorder.state == RecorderView::State::failed) {
    pieces.push_back({"status.recorder", "recording failed", recorder.problem, colors.problem});
  }
  const auto software = std::find_if(view.panes.begin(), view.panes.end(),
                                     [](const PaneView& pane) { return pane.software; });
  if (software != view.panes.end() || view.window.opengl_software) {
    const std::string& name = software != view.panes.end() ? software->device : view.window.opengl;
    pieces.push_back({"status.software", "software rasteriser",
                      "OpenGL is computed by the processor here: " + name +
                          ". Its hits are right, its times and joules are the processor's.",
                      colors.warning});
  }
  if (view.power.origin == energy::Origin::unavailable && !view.power_opening) {
    pieces.push_back({"status.no_watts", "no watts",
                      view.power.detail.empty() ? "No power source is open." : view.power.detail,
                      colors.dim_text});
  }
  return pieces;
}

/// Right to left; what has no room is left out. Returns where they begin.
float draw_pieces(const std::vector<Piece>& pieces, float right, float least) {
  const float em = ImGui::GetFontSize();
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
    const float from = right - ImGui::CalcTextSize(piece->text.c_str()).x;
    if (from < least) break;
    ImGui::SameLine(from);
    colored_text(piece->color, piece->text);
    note_widget(piece->name, piece->text);
    hint(piece->tip);
    right = from - em;
  }
  return right;
}

}  // namespace

void draw_status(const Rect& area, const View& view, UiState& state, Commands& commands) {
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(em * 0.6F, em * 0.1F));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  if (begin_part("##status", area)) {
    ImGui::AlignTextToFramePadding();
    ImGui::Dummy({0.0F, 0.0F});
    const float right = draw_pieces(lasting_pieces(view, colors), area.width - em * 0.6F,
                                    std::min(area.width * 0.45F, em * 26.0F));
    ImGui::SameLine(em * 0.6F);
    ImGui::PushClipRect({area.x, area.y}, {std::max(area.x, area.x + right), area.bottom()}, true);
    const std::vector<Doing> doing = what_goes_on(view);
    if (!doing.empty()) {
      draw_work(doing.front(), doing.size() - 1, commands);
    } else {
      const std::string text = idle_text(view, state);
      const bool problem = !view.scene.problem.empty();
      const std::string shown = fitted(text, right - em * 0.6F);
      colored_text(problem ? colors.problem : colors.dim_text, shown);
      note_widget("status.text", text);
      if (shown != text || problem) hint(text);
    }
    ImGui::PopClipRect();
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace encore::ui
