#pragma once

#include "accel/build_place.h"
#include "accel/settings.h"
#include "renderer/heatmap.h"
#include "scene/ray_settings.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace encore::ui {

inline constexpr std::size_t kPaneCount = 2;

/// Who draws a pane's picture.
enum class PaneDevice { off, cpu, gpu, raster };
/// What is shown of it. `difference`: against the other pane's picture, which has to have the same
/// size.
enum class PaneContent { picture, heatmap, difference };
/// How large a pane's picture is. `window`: as many pixels as the pane has.
enum class SizeChoice { square_256, square_512, square_768, square_1024, window, custom };

/// One tracer with all that is its own.
struct PaneSettings {
  PaneDevice device = PaneDevice::cpu;
  PaneContent content = PaneContent::picture;
  accel::StructureSpec structure = accel::default_spec(accel::StructureKind::bvh_median);
  accel::Policy policy = accel::Policy::rebuild;
  /// Where a structure for PaneDevice::gpu is built frame after frame.
  accel::BuildPlace build_on = accel::BuildPlace::automatic;
  SizeChoice size = SizeChoice::window;
  int custom_width = 640;  ///< of SizeChoice::custom
  int custom_height = 480;
  int threads = 0;  ///< of the CPU; 0: all

  friend bool operator==(const PaneSettings&, const PaneSettings&) = default;
};

/// What the colour of a node or cell says.
enum class OverlayColor { depth, leaf_size, sah, overlap, decay };
/// What becomes of lines behind the scene's surface.
enum class HiddenLines { hidden, dimmed, x_ray };

/// How the structure itself is drawn, over the pictures and in the 3D view.
struct OverlaySettings {
  bool show = false;
  OverlayColor color = OverlayColor::depth;
  HiddenLines hidden = HiddenLines::dimmed;
  int first_depth = 0;  ///< trees: the depths that are shown
  int last_depth = 8;
  bool leaves = true;
  bool inner_nodes = true;
  bool empty_leaves = false;
  int least_triangles = 0;       ///< leaves and cells with fewer are left out
  float smallest_pixels = 2.0F;  ///< what looks smaller is left out
  int most_nodes = 30'000;       ///< a frame; the smallest are left out first
  bool boxes = true;
  bool planes = true;  ///< kd-trees: the split planes, clipped to their node
  std::array<bool, 3> plane_axes{true, true, true};
  bool filled = false;
  float line_pixels = 1.2F;
  float opacity = 0.8F;
  bool section = false;  ///< cuts away what lies above the plane
  int section_axis = 0;
  float section_position = 0.5F;  ///< share of the scene's extent along the axis
  bool section_flipped = false;
  bool selected_subtree = false;  ///< only what lies below the selected node

  friend bool operator==(const OverlaySettings&, const OverlaySettings&) = default;
};

enum class HeatmapCost { steps, triangle_tests, box_tests, energy };

/// How costs a pixel are drawn.
struct HeatmapSettings {
  HeatmapCost cost = HeatmapCost::steps;
  int palette = 0;              ///< place in the renderer's list
  bool automatic_range = true;  ///< from 0 to the 99th percentile
  float low = 0.0F;
  float high = 100.0F;
  bool logarithmic = false;
  /// Of the modelled energy: how much one of each weighs against the others; the frame's joules are
  /// shared in that proportion.
  float step_weight = 1.0F;
  float box_weight = 1.0F;
  float triangle_weight = 2.0F;

  friend bool operator==(const HeatmapSettings&, const HeatmapSettings&) = default;
};

struct AnimationSettings {
  bool playing = false;
  bool loop = true;
  float speed = 1.0F;  ///< scene seconds a second

  friend bool operator==(const AnimationSettings&, const AnimationSettings&) = default;
};

/// How measure mode divides time.
struct MeasureSettings {
  float slot_s = 3.0F;  ///< one pane traces alone for so long
  float idle_s = 1.5F;  ///< nothing runs before each slot
  /// Static scenes: build or update, by the policy, before each frame though nothing moves (the
  /// thesis' dynamic tests).
  bool forced = false;
  float target_percent = 1.0F;  ///< the stop target: relative half-width of the 95 % interval
  bool stop_at_target = false;

  friend bool operator==(const MeasureSettings&, const MeasureSettings&) = default;
};

/// Where watts come from.
struct EnergySettings {
  enum class From { automatic, chosen, model };
  From from = From::automatic;
  std::string source;       ///< of `chosen`: as --source takes it
  float idle_watts = 0.0F;  ///< of `model`; 0: not entered
  float busy_watts = 0.0F;

  friend bool operator==(const EnergySettings&, const EnergySettings&) = default;
};

/// Everything that undo brings back and that is kept from run to run.
struct Settings {
  std::array<PaneSettings, kPaneCount> panes;
  scene::RaySettings rays;  ///< of both panes: they are to be compared
  OverlaySettings overlay;
  HeatmapSettings heatmap;
  AnimationSettings animation;
  MeasureSettings measure;
  EnergySettings energy;

  friend bool operator==(const Settings&, const Settings&) = default;
};

/// What the window starts with: the CPU beside the GPU, over the same structure.
Settings default_settings();

/// The words of files and tooltips: "cpu", "window", "sah".
std::string_view to_string(PaneDevice device);
std::string_view to_string(PaneContent content);
std::string_view to_string(SizeChoice size);
std::string_view to_string(OverlayColor color);
std::string_view to_string(HiddenLines hidden);
std::string_view to_string(HeatmapCost cost);
std::string_view to_string(EnergySettings::From from);
std::optional<PaneDevice> parse_pane_device(std::string_view word);
std::optional<PaneContent> parse_pane_content(std::string_view word);
std::optional<SizeChoice> parse_size_choice(std::string_view word);
std::optional<OverlayColor> parse_overlay_color(std::string_view word);
std::optional<HiddenLines> parse_hidden_lines(std::string_view word);
std::optional<HeatmapCost> parse_heatmap_cost(std::string_view word);
std::optional<EnergySettings::From> parse_energy_from(std::string_view word);

}  // namespace encore::ui
