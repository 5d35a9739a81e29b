#pragma once

#include "app/window/overlay_picture.h"
#include "app/window/pane_output.h"
#include "renderer/gl/context.h"
#include "renderer/overlay/screen_texture.h"
#include "ui/ui_state.h"
#include "ui/view.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace encore::app {

/// The window's textures: what the panes and the 3D view show, with the structure drawn over it.
/// Lives in the window's context and thread.
class Screen {
 public:
  explicit Screen(std::shared_ptr<renderer::gl::Context> context);

  /// Uploads what is new and draws overlays, and tells the view the textures to show.
  void update(const std::array<std::shared_ptr<const PaneOutput>, ui::kPaneCount>& outputs,
              const ui::UiState& state, ui::View& view);
  /// The node under a pixel of the 3D view.
  [[nodiscard]] std::optional<std::uint32_t> node_at(int x, int y) const;

  /// Writes what a pane (0, 1) or the 3D view (2) shows as PNG; how it went, for people. Throws
  /// std::runtime_error that names the file.
  void save(std::size_t part, const std::filesystem::path& file);

 private:
  struct Part {
    std::unique_ptr<renderer::ScreenTexture> texture;
    std::unique_ptr<OverlayPicture> overlay;
    std::shared_ptr<const ScreenPicture> uploaded;
    std::uint64_t serial = 0;  ///< of the texture's content
    bool overlaid = false;     ///< what is shown last is the overlay's picture
    std::string problem;       ///< of drawing the overlay
  };
  void upload(Part& part, const std::shared_ptr<const ScreenPicture>& picture);
  void update_pane(std::size_t pane, const std::shared_ptr<const PaneOutput>& output,
                   const ui::UiState& state, ui::View& view);
  void update_free(const std::shared_ptr<const PaneOutput>& output, const ui::UiState& state,
                   ui::View& view);
  std::uint32_t draw_over(Part& part, const OverlayScene& scene);

  std::shared_ptr<renderer::gl::Context> context_;
  std::array<Part, ui::kPaneCount + 1> parts_;
};

}  // namespace encore::app
