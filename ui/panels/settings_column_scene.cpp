#include "scene/sample_scenes.h"
#include "ui/panels/settings_column.h"
#include "ui/plot/value_text.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <string>

namespace encore::ui {

namespace {

std::string extent_text(const scene::Bounds& bounds) {
  if (bounds.empty()) return "empty";
  const glm::vec3 size = bounds.size();
  return fmt::format("{:.4g} × {:.4g} × {:.4g}", size.x, size.y, size.z);
}

std::string corners_text(const scene::Bounds& bounds) {
  if (bounds.empty()) return "The scene holds no triangle.";
  return fmt::format(
      "Sides of the box around all triangles, in world units, from ({:.5g}, {:.5g}, {:.5g}) to "
      "({:.5g}, {:.5g}, {:.5g}).",
      bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z);
}

void draw_facts(const SceneView& scene) {
  figure_row({"settings.scene.name", "Name", "What the scene is called: by its file or its text."},
             scene.scene->name);
  if (!scene.info) {
    hint_line("counting what is in it …");
    return;
  }
  const scene::SceneInfo& info = *scene.info;
  figure_row({"settings.scene.triangles", "Triangles",
              "What structures are built over, all instances counted."},
             count_text(info.triangles));
  figure_row({"settings.scene.instances", "Instances",
              "Placements of models; a model may be placed more than once."},
             count_text(info.instances));
  figure_row({"settings.scene.bounds", "Bounds", corners_text(info.bounds)},
             extent_text(info.bounds));
  std::string motion = info.animation.kind;
  if (scene.animated) motion += fmt::format(", {}", duration_text(scene.duration_s));
  figure_row({"settings.scene.animation", "Animation",
              "How the scene moves, and how long one loop takes. Rigid parts are placed anew, "
              "deforming ones change their vertices, frame sequences may change their triangles."},
             motion);
}

void draw_warnings(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return;
  const std::string title =
      fmt::format("{} warning{}", warnings.size(), warnings.size() == 1 ? "" : "s");
  if (!begin_group("settings.scene.warnings", title,
                   "What was odd in the scene's files, and what was made of it.", false)) {
    return;
  }
  for (const std::string& warning : warnings) hint_line(warning);
  ImGui::TreePop();
}

void draw_samples(const ColumnContext& context) {
  const Row row{"settings.scene.sample", "Sample",
                "Scenes that the program makes itself, each with the triangle count of a row of "
                "the thesis' Table 2."};
  begin_row(row);
  const auto& scene = context.view.scene.scene;
  std::string now = "choose …";
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    if (scene && scene->name == sample.name) now = sample.name;
  }
  const bool open = ImGui::BeginCombo("##sample", now.c_str(), ImGuiComboFlags_HeightLarge);
  note_widget(row.name, now);
  if (!open) {
    tooltip(row.tip);
    return;
  }
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    const std::string label =
        fmt::format("{}  {}###{}", sample.name, count_text(sample.triangles), sample.name);
    if (ImGui::Selectable(label.c_str(), now == sample.name)) {
      context.commands.push_back(OpenScene{sample.name});
    }
    note_widget(row.name + "." + sample.name);
    tooltip(fmt::format("{}: {} triangles, {}", sample.description, count_text(sample.triangles),
                        sample.animation));
  }
  ImGui::EndCombo();
}

}  // namespace

void draw_scene_section(const ColumnContext& context) {
  const SceneView& scene = context.view.scene;
  if (!section("settings.scene", "Scene", "What is traced.")) return;
  if (scene.loading.active) {
    if (progress_row("settings.scene.loading", scene.loading)) {
      context.commands.push_back(CancelWork{});
    }
  }
  problem_line(scene.problem);
  if (scene.scene) {
    draw_facts(scene);
  } else if (!scene.loading.active) {
    hint_line("No scene is open: choose a sample, open a file, or drop one on the window.");
  }
  draw_warnings(scene.warnings);
  draw_samples(context);
  if (text_button({"settings.scene.open", "Open…",
                   "A scene file (.toml, .txt) or a model (.obj, .ply, .3ds, .gltf, .stl …)."})) {
    context.state.dialog = Dialog::open_scene;
  }
  if (scene.scene && text_button_beside({"settings.scene.reload", "Reload",
                                         "Reads the scene's files again; the camera stays."})) {
    context.commands.push_back(ReloadScene{});
  }
  if (scene.info && begin_group("settings.scene.more", "More figures",
                                "Sizes of the triangles, where they lie, memory.", false)) {
    draw_scene_figures(*scene.info);
    ImGui::TreePop();
  }
  draw_left_out(context);
}

}  // namespace encore::ui
