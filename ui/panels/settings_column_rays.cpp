#include "ui/panels/settings_column.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cstdint>
#include <string>

namespace encore::ui {

namespace {

/// Which of the section's rows have something to do in this scene.
struct RayRows {
  bool shadows = false;
  bool reflections = false;
  bool refractions = false;
  bool textures = false;
  bool depth = false;
};

RayRows rows_of(const scene::Needs& could, const scene::RaySettings& rays) {
  RayRows rows;
  rows.shadows = could.shadows;
  rows.reflections = could.reflections;
  rows.refractions = could.refractions;
  rows.textures = could.textures;
  rows.depth = (could.reflections && rays.reflections) || (could.refractions && rays.refractions);
  return rows;
}

void draw_kinds(const RayRows& rows, scene::RaySettings& rays) {
  if (rows.shadows) {
    toggle_row({"rays.shadows", "Shadows",
                "A light that something stands in front of adds nothing. Costs a ray to each light "
                "from every point that is seen, which may end at the first triangle in its way."},
               rays.shadows);
  }
  if (rows.reflections) {
    toggle_row({"rays.reflections", "Reflections",
                "What mirrors show, and what glass mirrors of it. Costs a ray from every such "
                "point, and what that one meets."},
               rays.reflections);
  }
  if (rows.refractions) {
    toggle_row({"rays.refractions", "Refractions",
                "What is seen through glass, bent by its index of refraction. Costs a ray into and "
                "a ray out of each body of glass, and with reflections a tree of both."},
               rays.refractions);
  }
  if (rows.textures) {
    toggle_row({"rays.textures", "Textures",
                "Pictures that surfaces wear. Cost no rays, but memory: 24 bytes a triangle and 4 "
                "a texel, and a look-up at each hit."},
               rays.textures);
  }
}

void draw_seed(scene::RaySettings& rays) {
  const Row row{"rays.seed", "Seed",
                "Where in their pixels the samples lie; the same seed gives the same picture, to "
                "the bit. 0 to 4,294,967,295, taken with Enter."};
  begin_row(row, reset_width() + ImGui::GetStyle().ItemInnerSpacing.x);
  std::uint32_t typed = rays.seed;
  if (ImGui::InputScalar("##seed", ImGuiDataType_U32, &typed, nullptr, nullptr, nullptr,
                         ImGuiInputTextFlags_EnterReturnsTrue)) {
    rays.seed = typed;
  }
  end_row(row, fmt::format("{}", rays.seed));
  const scene::RaySettings usual;
  if (rays.seed == usual.seed) return;
  ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
  if (reset_button(row.name + ".reset", fmt::format("{}", usual.seed))) rays.seed = usual.seed;
}

void draw_numbers(const RayRows& rows, scene::RaySettings& rays) {
  const scene::RaySettings usual;
  if (rows.depth) {
    number_row(NumberRow<int>{.row = {"rays.depth", "Depth",
                                      "Reflections and refractions one after the other on a ray's "
                                      "way; at the limit a surface shows its own colour only. "
                                      "With both kinds each more may double the rays. 0 to 16."},
                              .high = scene::kMostDepth,
                              .usual = usual.depth},
               rays.depth);
  }
  number_row(NumberRow<int>{.row = {"rays.samples", "Samples",
                                    "Camera rays a pixel. 1: through its centre, as the thesis "
                                    "has it. More are spread over the pixel and smooth edges; "
                                    "time and energy grow with their number. 1 to 4,096."},
                            .low = 1,
                            .high = scene::kMostSamples,
                            .usual = usual.samples,
                            .logarithmic = true,
                            .most_slid = 256},
             rays.samples);
  if (rays.samples > 1) draw_seed(rays);
}

/// "0.12 ms (0.10 to 0.14)"; empty where it was not measured.
std::string time_text(const SceneView& scene, const std::string& feature) {
  for (const LeftOutTime& one : scene.left_out_times) {
    if (one.feature != feature) continue;
    if (one.below_noise) return "time below noise";
    return fmt::format("{:.3g} ms ({:.3g} to {:.3g})", one.ms, one.low_ms, one.high_ms);
  }
  return {};
}

bool another_picture(const SceneView& scene, const std::string& feature) {
  for (const LeftOutTime& one : scene.left_out_times) {
    if (one.feature == feature) return !one.same_picture;
  }
  return false;
}

void draw_left_out_row(const SceneView& scene, const scene::LeftOut& one) {
  const std::string time = time_text(scene, one.feature);
  std::string tip = one.reason;
  tip += one.bytes ? "\nSaves " + bytes_text(*one.bytes) + " a copy."
                   : "\nIts code is not compiled into the kernels.";
  if (!time.empty()) {
    tip += fmt::format("\n{}: {}{}", "A frame with it", time,
                       another_picture(scene, one.feature) ? ", but another picture" : " longer");
    tip += "\n" + scene.left_out_measured;
  }
  std::string text = one.bytes ? bytes_text(*one.bytes) : std::string();
  if (!time.empty()) text += (text.empty() ? "" : ", ") + time;
  text += (text.empty() ? "" : ": ") + one.reason;
  // The row's label lives as long as the row is drawn.
  figure_row({"settings.scene.left_out." + one.feature, one.feature.c_str(), tip}, text);
}

}  // namespace

void draw_rays_section(const ColumnContext& context) {
  const SceneView& scene = context.view.scene;
  const auto any = [](accel::StructureKind) { return true; };
  if (!scene.scene || !any_structure(context.state, any)) return;
  scene::RaySettings& rays = context.state.settings.rays;
  const RayRows rows = rows_of(scene.could_use, rays);
  if (!section("settings.rays", "Rays",
               "Which rays the pictures of both panes are made of, beyond one through the centre "
               "of each pixel. Only what this scene has a use for is listed.")) {
    return;
  }
  draw_kinds(rows, rays);
  draw_numbers(rows, rays);
}

void draw_left_out(const ColumnContext& context) {
  const SceneView& scene = context.view.scene;
  if (scene.left_out.empty()) return;
  std::uint64_t bytes = 0;
  for (const scene::LeftOut& one : scene.left_out) bytes += one.bytes.value_or(0);
  const std::string title = bytes > 0 ? "Left out: " + bytes_text(bytes) : "Left out";
  if (!begin_group("settings.scene.left_out", title,
                   "What this scene, as it is set, has no use for: it is neither kept nor sent nor "
                   "compiled. Bytes are those of one copy of the scene's triangles; each device "
                   "has one.",
                   false)) {
    return;
  }
  for (const scene::LeftOut& one : scene.left_out) draw_left_out_row(scene, one);
  const bool free = !scene.measuring_left_out && !context.view.accuracy.work.active;
  if (text_button({"settings.scene.left_out.measure",
                   scene.measuring_left_out ? "Measuring ..." : "Measure times",
                   "How much longer a frame would take with each of these, drawn by turns on the "
                   "CPU while the panes rest: about a second."},
                  free)) {
    context.commands.push_back(MeasureLeftOut{});
  }
  if (!scene.left_out_problem.empty()) ImGui::TextWrapped("%s", scene.left_out_problem.c_str());
  ImGui::TreePop();
}

}  // namespace encore::ui
