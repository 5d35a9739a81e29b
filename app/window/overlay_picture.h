#pragma once

#include "accel/inspect/node_selection.h"
#include "app/window/pane_output.h"
#include "renderer/gl/context.h"
#include "renderer/overlay/overlay_renderer.h"
#include "ui/settings.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace encore::app {

/// What is drawn over a picture of a pane's scene.
struct OverlayScene {
  std::shared_ptr<const PaneOutput> output;  ///< whose structure it is
  scene::Camera camera;
  int width = 0;  ///< of the picture on the screen, in its pixels
  int height = 0;
  std::uint32_t background = 0;  ///< texture of the traced picture
  std::uint64_t background_serial = 0;
  std::shared_ptr<const std::vector<float>> distances;  ///< of that picture; null: not known
  int distances_width = 0;
  int distances_height = 0;
  ui::OverlaySettings settings;
  bool with_nodes = false;
  std::optional<std::uint32_t> selected_node;
  std::size_t ray_step = 0;
  bool with_ray = false;
  bool moving = false;  ///< the camera is: fewer nodes do where drawing them is slow
  std::optional<scene::Camera> other_camera;  ///< whose frustum is drawn
  double other_aspect = 1.0;
};

/// Draws the structure, the selection and the picked ray over a picture. What did not change since
/// the last call is not drawn again.
class OverlayPicture {
 public:
  explicit OverlayPicture(std::shared_ptr<renderer::gl::Context> context);

  /// The texture to show. Throws GlError.
  std::uint32_t draw(const OverlayScene& scene);
  /// Likewise four bytes a pixel, rows from the top; of the last draw().
  void read(std::vector<std::uint8_t>& rgba) { overlay_.read(rgba); }
  [[nodiscard]] int width() const { return drawn_.width; }
  [[nodiscard]] int height() const { return drawn_.height; }

  [[nodiscard]] std::size_t nodes_drawn() const { return selection_.nodes.size(); }
  [[nodiscard]] std::size_t nodes_left_out() const {
    return std::size_t(selection_.too_small) + selection_.over_budget;
  }
  /// The node under a pixel of the last picture; nothing if there is none.
  [[nodiscard]] std::optional<std::uint32_t> node_at(int x, int y) const;

 private:
  void send_nodes(const OverlayScene& scene);
  void choose_nodes(const OverlayScene& scene);
  void add_planes(const OverlayScene& scene);
  void add_selection(const OverlayScene& scene);
  void add_ray(const OverlayScene& scene);
  void add_frustum(const OverlayScene& scene);
  [[nodiscard]] bool same(const OverlayScene& scene) const;

  renderer::OverlayRenderer overlay_;
  bool software_;  ///< the device is a rasteriser in software
  OverlayScene drawn_;
  bool any_ = false;
  std::shared_ptr<const accel::NodeTable> sent_nodes_;
  std::shared_ptr<const accel::NodeValues> sent_values_;
  std::uint64_t version_ = 0;
  accel::NodeSelection selection_;
  std::vector<std::uint32_t> boxes_;
  std::vector<std::uint32_t> colors_;  ///< one a node of the table
  std::vector<renderer::OverlayQuad> quads_;
  std::vector<renderer::OverlaySegment> segments_;
  std::vector<renderer::OverlayPoint> points_;
  std::vector<renderer::OverlayTriangle> triangles_;
};

}  // namespace encore::app
