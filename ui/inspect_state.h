#pragma once

#include "ui/settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace encore::accel {
class NodeTable;
}  // namespace encore::accel

namespace encore::ui {

/// Places of the pictures that a camera moves in: the panes, and after them the free 3D view.
inline constexpr std::size_t kPictureCount = kPaneCount + 1;

/// What moving a camera by hand keeps from frame to frame.
struct NavigationState {
  enum class Drag { none, orbit, pan, look };
  Drag drag = Drag::none;
  bool moved = false;  ///< by more than a click may
  float pressed_x = 0.0F;
  float pressed_y = 0.0F;
  float last_x = 0.0F;  ///< up to where the mouse's way has been followed
  float last_y = 0.0F;
  float speed = 1.0F;  ///< of flying, set by the wheel
  std::array<double, kPictureCount> wheel_until{};
  std::array<int, kPictureCount> moved_in_frame{-9, -9, -9};  ///< ImGui::GetFrameCount()
};

/// Which nodes the list shows.
struct TreeState {
  std::weak_ptr<const accel::NodeTable> of;
  std::set<std::uint32_t> open;
  std::vector<std::uint32_t> rows;  ///< nodes, from the top
  bool stale = true;                ///< rows are to be made again
  std::optional<std::uint32_t> revealed;
};

enum class StructureTab { statistics, tree, selection, ray };

/// What the panes, the 3D view and the structure's column keep between frames.
struct InspectState {
  struct Pixel {
    std::size_t pane = 0;
    int x = 0;
    int y = 0;

    friend bool operator==(const Pixel&, const Pixel&) = default;
  };
  NavigationState navigation;
  std::optional<Pixel> hovered;  ///< as last told
  TreeState tree;
  StructureTab tab = StructureTab::statistics;
  std::optional<Pixel> seen_pick;  ///< what the ray's tab was opened for
  std::optional<std::uint32_t> seen_node;
  std::optional<std::size_t> seen_step;
};

}  // namespace encore::ui
