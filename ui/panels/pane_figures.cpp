#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_draw.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace encore::ui {

namespace {

constexpr std::size_t kLines = 2;

/// One figure of the last frame.
struct Figure {
  const char* name;
  std::string text;
  std::string brief;  ///< where there is little room
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
  const std::string time = value_text(total, "s", 3);
  Figure figure{"ms", time + " a frame", time, "Time of the last whole frame, by the clock:"};
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

Figure energy_figure(const EnergyFigure& joules) {
  Figure figure{"joules", "energy", "energy", "", &joules};
  if (joules.value) {
    figure.text = figure_text(joules, "J") + " a frame";
    figure.brief = value_text(*joules.value, "J", 3);
    figure.tip = figure.text + "\n";
  }
  figure.tip += "Joules a frame, idle power included, with the half-width of the 95 % interval.\n" +
                joules.provenance.detail;
  return figure;
}

/// "shadow: 65,536 rays, 0.42 ms (31 % of rendering), 12 mJ".
std::string kind_line(const PaneView& shown, scene::RayKind kind) {
  const RayKindFigures& rays = shown.frame->kinds[static_cast<std::size_t>(kind)];
  std::string line = fmt::format("\n{}: {} rays", scene::to_string(kind), count_text(rays.rays));
  if (!rays.share) return line;
  line +=
      fmt::format(", {} ({:.0f} % of rendering)",
                  value_text(*shown.frame->render_s * *rays.share, "s", 3), *rays.share * 100.0);
  if (shown.render_joules.value) {
    line += ", " + value_text(*shown.render_joules.value * *rays.share, "J", 3);
  }
  return line;
}

Figure rays_figure(const PaneView& shown) {
  const FrameFigures& frame = *shown.frame;
  const double rate = static_cast<double>(frame.rays) / *frame.render_s;
  const std::string text = fmt::format("{:.3g} Mrays/s", rate / 1e6);
  Figure figure{"rays", text, text,
                fmt::format("Millions of rays of all kinds a second while rendering: {} rays in "
                            "{}, in the last whole frame.",
                            count_text(frame.rays), value_text(*frame.render_s, "s", 3))};
  const bool several =
      frame.rays != frame.kinds[static_cast<std::size_t>(scene::RayKind::camera)].rays;
  if (!several) return figure;
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    if (frame.kinds[i].rays > 0) figure.tip += kind_line(shown, static_cast<scene::RayKind>(i));
  }
  if (shown.render_joules.value) {
    figure.tip += "\nJoules: rendering's, split by the time of each kind; " +
                  provenance_text(shown.render_joules.provenance);
  }
  return figure;
}

/// How well a picture of several samples is known.
Figure error_figure(const RefinementView& refinement) {
  Figure figure{"samples", "", "", ""};
  figure.text = refinement.complete()
                    ? fmt::format("{} samples", refinement.samples)
                    : fmt::format("{} of {} samples", refinement.samples, refinement.wanted);
  figure.brief = fmt::format("{} spp", refinement.samples);
  figure.tip = fmt::format("{} of {} camera rays a pixel have been drawn.", refinement.samples,
                           refinement.wanted);
  if (refinement.errors.empty()) return figure;
  const std::string error = fmt::format("error ±{:.3g}", refinement.errors.back().rmse);
  figure.text += ", " + error;
  figure.brief = error;
  figure.tip += "\n" + error +
                " (RMSE estimate): by how much the picture is expected to differ from one of "
                "endless samples, over all channels of all pixels; 1: as much as black differs "
                "from white. From how far the samples' parts differ, as if they were independent; "
                "stratified ones are somewhat better.";
  return figure;
}

/// What matters most comes first.
std::vector<Figure> figures_of(const PaneView& shown) {
  std::vector<Figure> figures;
  if (shown.frame) figures.push_back(time_figure(*shown.frame));
  figures.push_back(energy_figure(shown.joules_per_frame));
  if (shown.refinement) figures.push_back(error_figure(*shown.refinement));
  if (shown.frame && shown.frame->rays > 0 && shown.frame->render_s &&
      *shown.frame->render_s > 0.0) {
    figures.push_back(rays_figure(shown));
  }
  if (shown.frames_per_s) {
    const std::string text = fmt::format("{:.1f} fps", *shown.frames_per_s);
    figures.push_back({"fps", text, text, "Frames a second that this pane's times allow."});
  }
  return figures;
}

/// What is to be seen now and passes: refining, whose slot it is.
struct Passing {
  std::string text;
  std::string brief;
  std::string why;
  ImVec4 color;
};

Passing passing_of(const PaneContext& context) {
  const PaneView& shown = context.shown();
  Passing passing;
  passing.color = theme_colors(context.state.preferences.theme).dim_text;
  if (context.view.measure.measuring) {
    passing.text = shown.my_slot ? "its slot" : "waits for its slot";
    passing.brief = shown.my_slot ? "its slot" : "waiting";
    passing.why =
        "In measure mode the panes run one after the other, so that a sensor which sees the whole "
        "machine can tell whose joules they are. " +
        context.view.measure.doing;
    if (shown.my_slot) passing.color = device_color(context.settings().device);
  } else if (shown.traced_width > 0 && shown.traced_width < shown.width) {
    const std::string traced = size_text(shown.traced_width, shown.traced_height);
    passing.text = "refining " + traced;
    passing.brief = "refining";
    passing.why = fmt::format("A coarse picture of {} pixels is shown while that of {} is traced.",
                              traced, size_text(shown.width, shown.height));
  } else if (shown.refinement && !shown.refinement->complete()) {
    passing.text = fmt::format("refining {:.0f} %",
                               100.0 * shown.refinement->samples / shown.refinement->wanted);
    passing.brief = "refining";
    passing.why = fmt::format(
        "The mean of {} camera rays a pixel is shown while {} are drawn, in parts of 1, 1, 2, 4, 8 "
        "and so on.",
        shown.refinement->samples, shown.refinement->wanted);
  }
  return passing;
}

float text_width(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x;
}

float gap() {
  return ImGui::GetFontSize() * 0.9F;
}

float figure_width(const Figure& figure, bool brief) {
  const float badge_room =
      figure.energy != nullptr ? badge_width(figure.energy->provenance) + gap() * 0.5F : 0.0F;
  return text_width(brief ? figure.brief : figure.text) + badge_room;
}

/// Which line each figure is in, kLines for none: in turn, each the first line that has room.
struct Packing {
  std::vector<std::size_t> lines;
  bool all = true;
};

Packing pack(const std::vector<Figure>& figures, bool brief, std::array<float, kLines> rooms) {
  Packing packing;
  for (const Figure& figure : figures) {
    const float width = figure_width(figure, brief);
    std::size_t line = 0;
    while (line < kLines && rooms[line] < width) ++line;
    if (line < kLines) rooms[line] -= width + gap();
    if (line == kLines) packing.all = false;
    packing.lines.push_back(line);
  }
  return packing;
}

void draw_figure(const Figure& figure, bool brief, const PaneContext& context) {
  const std::string& text = brief ? figure.brief : figure.text;
  ImGui::TextUnformatted(text.c_str());
  note_widget(context.name(figure.name), text);
  hint(figure.tip);
  if (figure.energy == nullptr) return;
  ImGui::SameLine(0.0F, gap() * 0.5F);
  badge(figure.energy->provenance);
  note_widget(context.name("badge"), energy::to_string(figure.energy->provenance.origin));
}

void draw_passing(const PaneContext& context, const Passing& passing, float left, float right,
                  float y) {
  if (passing.text.empty()) return;
  const std::string& words =
      text_width(passing.text) <= right - left ? passing.text : passing.brief;
  const std::string cut = fitted(words, right - left);
  ImGui::SetCursorScreenPos({right - text_width(cut), y});
  colored_text(passing.color, cut);
  note_widget(context.name("passing"), cut);
  hint(passing.text + "\n" + passing.why);
}

/// Kept free for what passes, whether there is any or not, so that figures stay where they are.
float kept_for_passing(float width) {
  const float words = text_width("waits for its slot");
  return words <= width * 0.45F ? words : std::max(text_width("waiting"), text_width("refining"));
}

}  // namespace

void draw_pane_figures(const Rect& area, const PaneContext& context) {
  const std::vector<Figure> figures = figures_of(context.shown());
  const float kept = kept_for_passing(area.width);
  const std::array<float, kLines> rooms{area.width, area.width - kept - gap()};
  bool brief = false;
  Packing packing = pack(figures, brief, rooms);
  if (!packing.all) {
    brief = true;
    packing = pack(figures, brief, rooms);
  }
  const float step = pane_header_line();
  float end = area.x;
  for (std::size_t line = 0; line < kLines; ++line) {
    end = area.x;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      if (packing.lines[i] != line) continue;
      ImGui::SetCursorScreenPos({end, area.y + static_cast<float>(line) * step});
      draw_figure(figures[i], brief, context);
      end += figure_width(figures[i], brief) + gap();
    }
  }
  draw_passing(context, passing_of(context), end, area.right(),
               area.y + static_cast<float>(kLines - 1) * step);
}

}  // namespace encore::ui
