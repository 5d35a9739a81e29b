#include "app/window/settings_fields.h"

namespace encore::app {

namespace {

std::string_view text_of(ui::Theme theme) {
  return theme == ui::Theme::dark ? "dark" : "light";
}
std::optional<ui::Theme> parse_theme(std::string_view word) {
  if (word == "dark") return ui::Theme::dark;
  if (word == "light") return ui::Theme::light;
  return std::nullopt;
}

using Logarithm = accel::KdTreeSettings::DepthLogarithm;
std::string_view text_of(Logarithm logarithm) {
  return logarithm == Logarithm::natural ? "natural" : "base2";
}
std::optional<Logarithm> parse_logarithm(std::string_view word) {
  if (word == "natural") return Logarithm::natural;
  if (word == "base2") return Logarithm::base2;
  return std::nullopt;
}

template <class Archive>
void visit_structure_settings(Archive&, accel::BruteSettings&) {}

template <class Archive>
void visit_structure_settings(Archive& archive, accel::GridSettings& grid) {
  archive.integer("cells_per_axis", grid.cells_per_axis, {0, 1024});
  archive.number("density", grid.density, {0.01, 16});
  archive.integer("most_references", grid.most_references, {1, 1024});
}

template <class Archive>
void visit_structure_settings(Archive& archive, accel::KdTreeSettings& kd) {
  archive.number("depth_offset", kd.depth_offset, {0, 60});
  archive.number("depth_factor", kd.depth_factor, {0, 4});
  archive.word("depth_logarithm", kd.depth_logarithm, Words<Logarithm>{text_of, parse_logarithm});
  archive.integer("leaf_triangles", kd.leaf_triangles, {0, 1 << 20});
  archive.integer("bad_split_retries", kd.bad_split_retries, {0, 60});
  archive.integer("bad_split_margin", kd.bad_split_margin, {0, 1 << 20});
  archive.number("traversal_cost", kd.traversal_cost, {0.001, 1e6});
  archive.number("intersection_cost", kd.intersection_cost, {0.001, 1e6});
  archive.number("empty_bonus", kd.empty_bonus, {0, 0.99});
  archive.integer("most_references", kd.most_references, {2, 1024});
}

template <class Archive>
void visit_structure_settings(Archive& archive, accel::BvhSettings& bvh) {
  archive.word("preset", bvh.preset,
               Words<accel::BuildPreset>{accel::to_string, accel::parse_build_preset});
  archive.word("update_case", bvh.update_case,
               Words<accel::UpdateCase>{accel::to_string, accel::parse_update_case});
  archive.seed("seed", bvh.seed);
  archive.word("auto_rule", bvh.auto_rule,
               Words<accel::AutoRule>{accel::to_string, accel::parse_auto_rule});
  archive.number("rebuild_at", bvh.rebuild_at, {1.001, 1e6});
}

template <class Archive>
void visit_structure(Archive& archive, accel::StructureSpec& spec) {
  accel::StructureKind kind = spec.kind;
  archive.word("kind", kind,
               Words<accel::StructureKind>{accel::to_string, accel::parse_structure_kind});
  // The kind decides which settings there are.
  if (kind != spec.kind) {
    const accel::StructureSpec before = spec;
    spec = accel::default_spec(kind);
    spec.memory = before.memory;
    spec.intersection = before.intersection;
    spec.grouping = before.grouping;
  }
  archive.word("memory", spec.memory,
               Words<accel::MemoryMode>{accel::to_string, accel::parse_memory_mode});
  archive.word("intersection", spec.intersection,
               Words<accel::IntersectionMode>{accel::to_string, accel::parse_intersection_mode});
  archive.word("grouping", spec.grouping,
               Words<accel::RayGrouping>{accel::to_string, accel::parse_ray_grouping});
  std::visit([&](auto& settings) { visit_structure_settings(archive, settings); }, spec.settings);
}

template <class Archive>
void visit_pane(Archive& archive, ui::PaneSettings& pane) {
  archive.word("device", pane.device, Words<ui::PaneDevice>{ui::to_string, ui::parse_pane_device});
  archive.word("content", pane.content,
               Words<ui::PaneContent>{ui::to_string, ui::parse_pane_content});
  archive.word("policy", pane.policy, Words<accel::Policy>{accel::to_string, accel::parse_policy});
  archive.word("build_on", pane.build_on,
               Words<accel::BuildPlace>{accel::to_string, accel::parse_build_place});
  archive.word("size", pane.size, Words<ui::SizeChoice>{ui::to_string, ui::parse_size_choice});
  archive.integer("custom_width", pane.custom_width, {1, 16384});
  archive.integer("custom_height", pane.custom_height, {1, 16384});
  archive.integer("threads", pane.threads, {0, 4096});
  archive.table("structure", [&](Archive& inner) { visit_structure(inner, pane.structure); });
}

template <class Archive>
void visit_rays(Archive& archive, scene::RaySettings& rays) {
  archive.flag("shadows", rays.shadows);
  archive.flag("reflections", rays.reflections);
  archive.flag("refractions", rays.refractions);
  archive.flag("textures", rays.textures);
  archive.integer("depth", rays.depth, {0, scene::kMostDepth});
  archive.integer("samples", rays.samples, {1, scene::kMostSamples});
  archive.seed("seed", rays.seed);
}

template <class Archive>
void visit_overlay(Archive& archive, ui::OverlaySettings& overlay) {
  archive.flag("show", overlay.show);
  archive.word("color", overlay.color,
               Words<ui::OverlayColor>{ui::to_string, ui::parse_overlay_color});
  archive.word("hidden_lines", overlay.hidden,
               Words<ui::HiddenLines>{ui::to_string, ui::parse_hidden_lines});
  archive.integer("first_depth", overlay.first_depth, {0, 1000});
  archive.integer("last_depth", overlay.last_depth, {0, 1000});
  archive.flag("leaves", overlay.leaves);
  archive.flag("inner_nodes", overlay.inner_nodes);
  archive.flag("empty_leaves", overlay.empty_leaves);
  archive.integer("least_triangles", overlay.least_triangles, {0, 1 << 30});
  archive.number("smallest_pixels", overlay.smallest_pixels, {0, 1000});
  archive.integer("most_nodes", overlay.most_nodes, {1, 10'000'000});
  archive.flag("boxes", overlay.boxes);
  archive.flag("planes", overlay.planes);
  archive.flag("plane_x", overlay.plane_axes[0]);
  archive.flag("plane_y", overlay.plane_axes[1]);
  archive.flag("plane_z", overlay.plane_axes[2]);
  archive.flag("filled", overlay.filled);
  archive.number("line_pixels", overlay.line_pixels, {0.1, 32});
  archive.number("opacity", overlay.opacity, {0, 1});
  archive.flag("section", overlay.section);
  archive.integer("section_axis", overlay.section_axis, {0, 2});
  archive.number("section_position", overlay.section_position, {0, 1});
  archive.flag("section_flipped", overlay.section_flipped);
  archive.flag("selected_subtree", overlay.selected_subtree);
}

template <class Archive>
void visit_heatmap(Archive& archive, ui::HeatmapSettings& heatmap) {
  archive.word("cost", heatmap.cost, Words<ui::HeatmapCost>{ui::to_string, ui::parse_heatmap_cost});
  archive.integer("palette", heatmap.palette, {0, 100});
  archive.flag("automatic_range", heatmap.automatic_range);
  archive.number("low", heatmap.low, {-1e30, 1e30});
  archive.number("high", heatmap.high, {-1e30, 1e30});
  archive.flag("logarithmic", heatmap.logarithmic);
  archive.number("step_weight", heatmap.step_weight, {0, 1e9});
  archive.number("box_weight", heatmap.box_weight, {0, 1e9});
  archive.number("triangle_weight", heatmap.triangle_weight, {0, 1e9});
}

template <class Archive>
void visit_measure(Archive& archive, ui::MeasureSettings& measure) {
  archive.number("slot_s", measure.slot_s, {0.01, 3600});
  archive.number("idle_s", measure.idle_s, {0, 3600});
  archive.flag("forced", measure.forced);
  archive.number("target_percent", measure.target_percent, {0.001, 100});
  archive.flag("stop_at_target", measure.stop_at_target);
}

template <class Archive>
void visit_energy(Archive& archive, ui::EnergySettings& energy) {
  archive.word("from", energy.from,
               Words<ui::EnergySettings::From>{ui::to_string, ui::parse_energy_from});
  archive.text("source", energy.source);
  archive.number("idle_watts", energy.idle_watts, {0, 1e6});
  archive.number("busy_watts", energy.busy_watts, {0, 1e6});
}

}  // namespace

template <class Archive>
void visit_settings(Archive& archive, ui::Settings& settings) {
  archive.table("left_pane", [&](Archive& inner) { visit_pane(inner, settings.panes[0]); });
  archive.table("right_pane", [&](Archive& inner) { visit_pane(inner, settings.panes[1]); });
  archive.table("rays", [&](Archive& inner) { visit_rays(inner, settings.rays); });
  archive.table("overlay", [&](Archive& inner) { visit_overlay(inner, settings.overlay); });
  archive.table("heatmap", [&](Archive& inner) { visit_heatmap(inner, settings.heatmap); });
  archive.table("animation", [&](Archive& inner) {
    inner.flag("playing", settings.animation.playing);
    inner.flag("loop", settings.animation.loop);
    inner.number("speed", settings.animation.speed, {-1000, 1000});
  });
  archive.table("measure", [&](Archive& inner) { visit_measure(inner, settings.measure); });
  archive.table("energy", [&](Archive& inner) { visit_energy(inner, settings.energy); });
}

template <class Archive>
void visit_preferences(Archive& archive, ui::Preferences& preferences) {
  archive.word("theme", preferences.theme, Words<ui::Theme>{text_of, parse_theme});
  // 0: as the monitor says
  archive.number("ui_scale", preferences.ui_scale, {0, 3});
  archive.integer("up_axis", preferences.up_axis, {0, 2});
}

template <class Archive>
void visit_state(Archive& archive, ui::Preferences& preferences) {
  archive.integer("window_width", preferences.window_width, {64, 32768});
  archive.integer("window_height", preferences.window_height, {64, 32768});
  archive.text("last_folder", preferences.last_folder);
  archive.texts("recent_scenes", preferences.recent_scenes);
  archive.texts("recent_sessions", preferences.recent_sessions);
  archive.table("layout", [&](Archive& inner) {
    ui::LayoutSettings& layout = preferences.layout;
    inner.flag("left", layout.left);
    inner.flag("right", layout.right);
    inner.flag("plots", layout.plots);
    inner.number("left_width", layout.left_width, {1, 1000});
    inner.number("right_width", layout.right_width, {1, 1000});
    inner.number("plots_share", layout.plots_share, {0, 1});
    inner.number("plot_split", layout.plot_split, {0, 1});
    inner.number("pane_split", layout.pane_split, {0, 1});
  });
}

template <class Archive>
void visit_camera(Archive& archive, scene::Camera& camera) {
  archive.vector("eye", camera.eye);
  archive.vector("target", camera.target);
  archive.vector("up", camera.up);
  archive.number("fov", camera.vertical_fov_degrees, {0.001, 179.999});
  archive.number("orthographic_height", camera.orthographic_height, {0, 1e36});
}

template void visit_settings(SettingsWriter&, ui::Settings&);
template void visit_settings(SettingsReader&, ui::Settings&);
template void visit_preferences(SettingsWriter&, ui::Preferences&);
template void visit_preferences(SettingsReader&, ui::Preferences&);
template void visit_state(SettingsWriter&, ui::Preferences&);
template void visit_state(SettingsReader&, ui::Preferences&);
template void visit_camera(SettingsWriter&, scene::Camera&);
template void visit_camera(SettingsReader&, scene::Camera&);

}  // namespace encore::app
