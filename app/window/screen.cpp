#include "app/window/screen.h"

#include "app/window/picture_file.h"
#include "ui/layout.h"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

namespace encore::app {

Screen::Screen(std::shared_ptr<renderer::gl::Context> context) : context_(std::move(context)) {
  for (Part& part : parts_) part.texture = std::make_unique<renderer::ScreenTexture>(context_);
}

void Screen::upload(Part& part, const std::shared_ptr<const ScreenPicture>& picture) {
  if (!picture || part.uploaded == picture) return;
  part.texture->upload(picture->rgba, picture->width, picture->height);
  part.uploaded = picture;
  ++part.serial;
}

std::uint32_t Screen::draw_over(Part& part, const OverlayScene& scene) {
  try {
    if (!part.overlay) part.overlay = std::make_unique<OverlayPicture>(context_);
    const std::uint32_t texture = part.overlay->draw(scene);
    part.overlaid = true;
    part.problem.clear();
    return texture;
  } catch (const std::exception& error) {
    // A structure too large for the device: the picture without it is still worth showing.
    part.problem = error.what();
    part.overlaid = false;
    return scene.background;
  }
}

void Screen::update_pane(std::size_t pane, const std::shared_ptr<const PaneOutput>& output,
                         const ui::UiState& state, ui::View& view) {
  Part& part = parts_[pane];
  ui::PaneView& shown = view.panes[pane];
  if (!output || !output->screen) {
    shown.texture = 0;
    part.overlay.reset();  // with its memory
    return;
  }
  upload(part, output->screen);
  shown.texture = part.texture->texture();
  part.overlaid = false;
  shown.node_values = output->node_values;

  const bool inspected = state.inspected_pane == pane;
  const bool nodes = state.settings.overlay.show && output->nodes;
  const bool ray = output->pick.has_value() && view.pick.has_value();
  const bool selection = inspected && state.selected_node && output->nodes;
  if (!nodes && !ray && !selection) {
    part.overlay.reset();
    return;
  }
  const ui::UiState::Area& area = state.picture_areas[pane];
  const ui::Rect fitted =
      ui::fit_picture({0.0F, 0.0F, static_cast<float>(area.width), static_cast<float>(area.height)},
                      output->width, output->height);
  if (fitted.empty()) return;
  OverlayScene scene;
  scene.output = output;
  scene.camera = state.camera;
  scene.width = static_cast<int>(fitted.width);
  scene.height = static_cast<int>(fitted.height);
  scene.background = part.texture->texture();
  scene.background_serial = part.serial;
  // Depths of another view would hide the wrong lines.
  if (output->distances && output->camera == state.camera) {
    scene.distances = output->distances;
    scene.distances_width = output->image->width;
    scene.distances_height = output->image->height;
  }
  scene.settings = state.settings.overlay;
  scene.with_nodes = nodes;
  if (inspected) scene.selected_node = state.selected_node;
  scene.with_ray = ray;
  scene.moving = state.camera_moving || state.settings.animation.playing;
  scene.ray_step = state.ray_step;
  shown.texture = draw_over(part, scene);
  if (part.overlay && nodes) {
    shown.nodes_drawn = part.overlay->nodes_drawn();
    shown.nodes_hidden_small = part.overlay->nodes_left_out();
  }
  if (!part.problem.empty() && shown.problem.empty()) shown.problem = part.problem;
}

void Screen::update_free(const std::shared_ptr<const PaneOutput>& output, const ui::UiState& state,
                         ui::View& view) {
  Part& part = parts_[ui::kPaneCount];
  ui::PaneView& shown = view.structure_view;
  const ui::UiState::Area& area = state.picture_areas[ui::kPaneCount];
  shown = {};
  if (!state.structure_view || !state.free_camera || area.width <= 0 || area.height <= 0) {
    part.overlay.reset();
    part.uploaded.reset();
    return;
  }
  if (!output) return;
  shown.state = ui::PaneState::ready;
  shown.width = area.width;
  shown.height = area.height;
  OverlayScene scene;
  scene.output = output;
  scene.camera = *state.free_camera;
  scene.width = area.width;
  scene.height = area.height;
  // The traced surface follows a moving camera with a delay; lines of another view over it would
  // lie wrong, so it is left out until it has caught up.
  if (output->free && output->free->camera == *state.free_camera) {
    const auto picture = std::shared_ptr<const ScreenPicture>(output->free, &output->free->screen);
    upload(part, picture);
    scene.background = part.texture->texture();
    scene.background_serial = part.serial;
    scene.distances =
        std::shared_ptr<const std::vector<float>>(output->free, &output->free->distances);
    scene.distances_width = output->free->screen.width;
    scene.distances_height = output->free->screen.height;
  }
  scene.settings = state.settings.overlay;
  scene.with_nodes = true;
  scene.selected_node = state.selected_node;
  scene.with_ray = view.pick.has_value();
  scene.moving = state.camera_moving || state.settings.animation.playing;
  scene.ray_step = state.ray_step;
  scene.other_camera = state.camera;
  const auto& pane = view.panes[state.inspected_pane];
  if (pane.height > 0) scene.other_aspect = double(pane.width) / pane.height;
  shown.texture = draw_over(part, scene);
  shown.problem = part.problem;
  if (part.overlay) {
    shown.nodes_drawn = part.overlay->nodes_drawn();
    shown.nodes_hidden_small = part.overlay->nodes_left_out();
  }
}

void Screen::update(const std::array<std::shared_ptr<const PaneOutput>, ui::kPaneCount>& outputs,
                    const ui::UiState& state, ui::View& view) {
  for (std::size_t pane = 0; pane < ui::kPaneCount; ++pane) {
    update_pane(pane, outputs[pane], state, view);
  }
  update_free(outputs.at(state.inspected_pane), state, view);
}

std::optional<std::uint32_t> Screen::node_at(int x, int y) const {
  const Part& part = parts_[ui::kPaneCount];
  if (!part.overlay) return std::nullopt;
  return part.overlay->node_at(x, y);
}

void Screen::save(std::size_t part_index, const std::filesystem::path& file) {
  Part& part = parts_.at(part_index);
  if (part.overlaid && part.overlay) {
    std::vector<std::uint8_t> rgba;
    part.overlay->read(rgba);
    write_rgba_png(file, part.overlay->width(), part.overlay->height(), rgba);
  } else if (part.uploaded) {
    write_rgba_png(file, part.uploaded->width, part.uploaded->height, part.uploaded->rgba);
  } else {
    throw std::runtime_error("there is no picture to save yet");
  }
}

}  // namespace encore::app
