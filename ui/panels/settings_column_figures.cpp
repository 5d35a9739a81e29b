#include "ui/panels/settings_column.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <string>

namespace encore::ui {

namespace {

/// One figure of the list.
void figure(const char* name, const char* label, const std::string& text, const char* tip) {
  figure_row({std::string("settings.scene.more.") + name, label, tip}, text);
}

std::string share_text(double share) {
  return fmt::format("{:.3g} %", share * 100.0);
}

/// A distribution in three figures; all of it is in the tooltip.
void distribution(const char* name, const char* label, const scene::Distribution& of, double factor,
                  const char* unit, const char* meaning) {
  const auto text = [&](double value) { return fmt::format("{:.3g}", value * factor); };
  const std::string tip = fmt::format(
      "{}\nShown: median, 90 % and largest.\nsmallest {}, 10 % {}, median {}, mean {}, 90 % {}, "
      "99 % {}, largest {}{}",
      meaning, text(of.min), text(of.percentile_10), text(of.median), text(of.mean),
      text(of.percentile_90), text(of.percentile_99), text(of.max), unit);
  figure_row(
      {std::string("settings.scene.more.") + name, label, tip},
      fmt::format("{} / {} / {}{}", text(of.median), text(of.percentile_90), text(of.max), unit));
}

void draw_shapes(const scene::SceneInfo& info) {
  distribution("extent", "Side length", info.extent, 100.0, " %",
               "Longest side of each triangle's box, in per cent of the scene's longest side. A "
               "few large ones fill many cells of a grid.");
  distribution("area", "Area", info.area, 1.0, "",
               "Area of each triangle, as a multiple of the mean area.");
  figure("unevenness", "Unevenness", fmt::format("{:.3f}", info.area_unevenness),
         "Gini coefficient of the areas: 0 when all triangles are equally large, near 1 when few "
         "hold almost all of the area.");
  figure("surface", "Surface", fmt::format("{:.4g}", info.surface_area),
         "Sum of the triangles' areas, in square world units.");
  figure("diagonal", "Diagonal", fmt::format("{:.4g}", info.diagonal),
         "Of the box around everything, in world units.");
}

void draw_occupancy(const scene::SceneInfo& info) {
  const glm::ivec3 cells = info.coarse_cells;
  figure("coarse", "Coarse grid", fmt::format("{} × {} × {}", cells.x, cells.y, cells.z),
         "Cells into which the bounds are cut for the next two figures; a triangle counts where "
         "its centre lies.");
  figure("occupied", "Occupied", share_text(info.occupied_share),
         "Share of those cells that hold a triangle: the less, the more empty space a structure "
         "can skip.");
  figure("fullest", "Fullest cell", share_text(info.fullest_cell_share),
         "Share of the triangles that lie in the fullest of those cells: a large one is a teapot "
         "in a stadium, which grids cannot divide well.");
  if (info.triangles_per_volume > 0.0) {
    figure("density", "Density", fmt::format("{:.4g}", info.triangles_per_volume),
           "Triangles a cubic world unit of the bounds.");
  }
}

void draw_motion(const scene::AnimationInfo& motion) {
  if (motion.moving_instances > 0) {
    figure("moving", "Moving", count_text(motion.moving_instances), "Instances that move.");
  }
  if (motion.frames > 0) {
    figure("frames", "Frames", count_text(motion.frames), "Of the longest sequence.");
  }
  if (motion.min_triangles != motion.max_triangles) {
    figure(
        "changing", "Changing count",
        fmt::format("{} … {}", count_text(motion.min_triangles), count_text(motion.max_triangles)),
        "Fewest and most triangles over the frames. Where triangles come and go, trees have to "
        "be built: there is nothing to refit.");
  }
}

}  // namespace

void draw_scene_figures(const scene::SceneInfo& info) {
  if (!info.source.empty()) {
    figure("source", "Source", info.source, "Where the scene comes from.");
  }
  figure("vertices", "Vertices", count_text(info.vertices),
         "Of the meshes shown, once an instance.");
  figure("models", "Models", count_text(info.models),
         "Different meshes in memory, all frames counted.");
  figure("materials", "Materials", count_text(info.materials), "Different surfaces.");
  figure("lights", "Lights", count_text(info.lights),
         "Point lights; each adds to the shading of every hit, but no rays.");
  if (info.degenerate_triangles > 0) {
    figure("degenerate", "Without area", count_text(info.degenerate_triangles),
           "Triangles without area: no ray hits them, but structures hold them.");
  }
  if (info.dropped_non_finite > 0) {
    figure("dropped", "Left out", count_text(info.dropped_non_finite),
           "Triangles with corners that are not finite numbers, or beyond 2^126: left out.");
  }
  draw_shapes(info);
  draw_occupancy(info);
  draw_motion(info.animation);
  figure("mesh_bytes", "Meshes", bytes_text(info.mesh_bytes), "Memory of all models and frames.");
  figure("list_bytes", "List", bytes_text(info.triangle_list_bytes),
         "Memory of the one list of triangles that structures are built over, with normals and "
         "colours.");
}

}  // namespace encore::ui
