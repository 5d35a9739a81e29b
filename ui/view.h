#pragma once

#include "accel/settings.h"
#include "accel/stats.h"
#include "energy/provenance.h"
#include "renderer/heatmap.h"
#include "scene/camera.h"
#include "scene/left_out.h"
#include "scene/needs.h"
#include "scene/ray.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "scene/scene_info.h"
#include "ui/left_out_time.h"
#include "ui/settings.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::accel {
class NodeTable;
struct NodeValues;
struct StructureProfile;
struct RayPath;
}  // namespace encore::accel

namespace encore::ui {

class SampleHistory;

// What panels read: everything here is as it was when the frame began, and stays so until it ends.

/// A figure of energy or power. Without a value `provenance.detail` says why.
struct EnergyFigure {
  std::optional<double> value;
  std::optional<double> half_width;  ///< of the 95 % interval
  energy::Provenance provenance;
};

/// Work that goes on off the window's thread.
struct WorkView {
  bool active = false;
  std::string doing;               ///< "building kd-sah over 1,087,716 triangles"
  std::optional<double> progress;  ///< in [0, 1], where it can be told
  bool cancellable = false;
  double elapsed_s = 0.0;
};

struct SceneView {
  std::shared_ptr<const scene::Scene> scene;     ///< null before the first one is there
  std::shared_ptr<const scene::SceneInfo> info;  ///< null until it is known
  scene::Needs could_use;                        ///< with every kind of ray; known with `info`
  std::vector<scene::LeftOut> left_out;          ///< of the panes' copies, as they are set
  std::vector<LeftOutTime> left_out_times;       ///< where they were measured
  std::string left_out_measured;                 ///< how; empty where they were not
  std::string left_out_problem;                  ///< why measuring failed; one line
  bool measuring_left_out = false;
  bool animated = false;
  double duration_s = 0.0;  ///< of one loop of the animation
  std::vector<std::string> warnings;
  WorkView loading;
  std::string problem;  ///< why the last scene could not be opened; one line
};

enum class PaneState {
  off,
  waiting,    ///< for a scene, or for its slot
  working,    ///< building, tracing
  ready,      ///< the picture is of what is set
  cancelled,  ///< by the user; Rebuild goes on
  failed,
};

/// Rays of one kind in a frame.
struct RayKindFigures {
  std::uint64_t rays = 0;
  /// Of the time that rendering took, in [0, 1]; nothing where it was not told apart.
  std::optional<double> share{};
};

/// What the last frame cost. Times that did not occur are missing, not 0.
struct FrameFigures {
  std::optional<double> animate_s;
  std::optional<double> build_s;
  std::optional<double> update_s;
  std::optional<double> transfer_s;
  std::optional<double> render_s;
  std::uint64_t rays = 0;  ///< of all kinds; 0: no rays were traced
  std::array<RayKindFigures, scene::kRayKinds> kinds{};
  std::uint64_t uploaded_bytes = 0;
  [[nodiscard]] double total_s() const;
};

struct HeatmapView {
  double min = 0.0, median = 0.0, percentile_99 = 0.0, max = 0.0, mean = 0.0, sum = 0.0;
  double low = 0.0, high = 0.0;     ///< what the palette's ends stand for
  std::vector<std::uint64_t> bins;  ///< pixels, from bins_low to bins_high in equal steps
  double bins_low = 0.0, bins_high = 0.0;
  std::string unit;               ///< "steps", "J"
  energy::Provenance provenance;  ///< of modelled energy
};

struct DifferenceView {
  double rmse = 0.0;
  double largest = 0.0;
  std::uint64_t differing_pixels = 0;
  std::optional<std::uint64_t> differing_hits;  ///< where both trace rays
  std::uint64_t pixels = 0;
};

/// What is known of one pixel's ray.
struct PixelView {
  int x = 0;
  int y = 0;
  bool found = false;
  double distance = 0.0;
  std::uint32_t triangle = 0;
  std::string material;
  std::uint32_t steps = 0;
  std::uint32_t box_tests = 0;
  std::uint32_t triangle_tests = 0;
};

/// How well a picture was known after some time of drawing.
struct PictureError {
  double elapsed_s = 0.0;
  int samples = 0;
  double rmse = 0.0;  ///< estimated; 1: as much as black differs from white
};

/// A picture of several rays a pixel that is drawn part by part.
struct RefinementView {
  int samples = 0;  ///< so far
  int wanted = 1;
  std::vector<PictureError> errors;  ///< after each part that allows an estimate

  [[nodiscard]] bool complete() const { return samples >= wanted; }
};

/// One pane: a tracer's picture and what is known of it.
struct PaneView {
  PaneState state = PaneState::off;
  WorkView work;
  std::string problem;        ///< one line, where the state is failed or a part is missing
  std::uint64_t texture = 0;  ///< for ImGui::Image, the picture with all that lies over it; 0: none
  int width = 0;              ///< of the picture as it is set
  int height = 0;
  int traced_width = 0;  ///< of what is shown: smaller while it is refined
  int traced_height = 0;
  std::optional<FrameFigures> frame;         ///< of the last whole frame
  std::optional<RefinementView> refinement;  ///< of pictures of several rays a pixel
  std::optional<double> frames_per_s;  ///< over the last second or so; none while nothing changes
  /// An operation, gross; in measure mode.
  EnergyFigure joules_per_frame;
  /// The same of rendering alone; without a value where phases are not told apart.
  EnergyFigure render_joules;
  std::string device;     ///< "CPU, 2 threads", "llvmpipe (…), software, runs on the CPU"
  bool software = false;  ///< the graphics device is a rasteriser in software
  bool my_slot = false;   ///< measure mode: it is this pane that runs now
  bool refits_on_device = false;
  std::shared_ptr<const accel::BuildStats> stats;  ///< null while there is no structure
  std::shared_ptr<const accel::NodeTable> nodes;   ///< null unless they are shown
  std::shared_ptr<const accel::StructureProfile> profile;
  std::shared_ptr<const accel::NodeValues> node_values;  ///< one a node, by OverlayColor
  /// Policy auto: frames in which a build now would pay for itself; nothing where that is not
  /// known.
  std::optional<double> break_even_frames;
  std::optional<double> sah_decay;  ///< SAH cost now over that of the last build
  std::size_t nodes_drawn = 0;
  std::size_t nodes_hidden_small = 0;             ///< left out for their size or the limit
  std::vector<std::uint32_t> selected_triangles;  ///< of the selected node
  std::optional<HeatmapView> heatmap;
  std::optional<DifferenceView> difference;
  std::optional<PixelView> hover;
  std::uint64_t memory_bytes = 0;  ///< triangles, structure, pictures of this pane
};

/// The ray that was picked.
struct PickView {
  std::size_t pane = 0;
  PixelView pixel;
  std::shared_ptr<const accel::RayPath> path;
  std::vector<std::string> sentences;               ///< one a step
  std::vector<std::optional<std::uint32_t>> nodes;  ///< of each step, places in the node table
};

struct PowerSeriesView {
  std::string name;
  std::string includes;
  energy::Provenance provenance;
  bool in_total = false;
  bool lost = false;
  const SampleHistory* history = nullptr;
  std::optional<double> watts;  ///< the latest
};

struct PhaseFigure {
  std::string phase;              ///< "build", "render", …, "idle", "remainder"
  std::optional<double> seconds;  ///< an operation
  EnergyFigure joules;            ///< an operation, gross
};

/// Rays of one kind in an operation, on average.
struct RayKindCost {
  scene::RayKind kind = scene::RayKind::camera;
  std::optional<double> rays;
  std::optional<double> seconds;
  /// Of the render phase, split by time.
  EnergyFigure joules;
};

/// One point of error against run time.
struct ErrorPoint {
  double elapsed_s = 0.0;
  double relative = 0.0;            ///< half-width of the 95 % interval over the mean
  std::optional<double> samples{};  ///< independent ones that it rests on, where that is known
};

/// What one configuration has cost so far.
struct ConfigurationView {
  std::string label;  ///< "cpu bvh-median refit 512x512"
  std::optional<std::size_t> pane;
  double operations = 0.0;
  double measured_s = 0.0;
  std::optional<double> mean_s;
  std::optional<double> median_s;
  std::optional<double> ci95_s;
  std::optional<double> rays_per_s;
  EnergyFigure watts;
  EnergyFigure joules;      ///< an operation, gross
  EnergyFigure net_joules;  ///< above idle
  std::vector<PhaseFigure> phases;
  std::vector<RayKindCost> rays;  ///< of the kinds that were traced; empty where that is not known
  std::vector<ErrorPoint> time_error;
  std::vector<ErrorPoint> joules_error;
  std::vector<std::string> notes;
};

/// The error of a pane's picture of several rays a pixel, as it fell while it was drawn.
struct PictureErrorView {
  std::string label;  ///< "cpu bvh-median, picture"
  std::vector<PictureError> errors;
};

struct SlotView {
  double from_s = 0.0;
  double to_s = 0.0;
  enum class Kind { idle, cpu, gpu, raster, build } kind = Kind::idle;
  std::string label;
};
struct AnnotationView {
  double time_s = 0.0;
  std::string text;
};

/// What the three plots show: of now, or of a session that was opened.
struct PlotData {
  std::vector<PowerSeriesView> power;
  std::string no_power;  ///< why there are no watts and what to do; empty if there are
  std::optional<double> idle_watts;
  std::optional<double> idle_half_width;
  std::vector<SlotView> slots;
  std::vector<AnnotationView> annotations;
  std::vector<ConfigurationView> configurations;
  std::vector<PictureErrorView> pictures;  ///< of the panes; none of sessions
  double now_s = 0.0;                      ///< the right end of the time axis
};

struct MeasureView {
  bool measuring = false;
  std::string doing;      ///< "CPU pane, 1.2 s of 3 s", "idle"
  double progress = 0.0;  ///< of the slot
  std::string together;   ///< why the panes run by turns, or that separate sensors see them apart
};

struct RecorderView {
  enum class State { off, recording, paused, failed } state = State::off;
  double seconds = 0.0;
  std::uint64_t rows = 0;
  std::uint64_t bytes = 0;
  std::string folder;  ///< of the recording, or of the last one
  std::string problem;
};

struct ChangeView {
  std::string label;
  double a_s = 0.0, b_s = 0.0;
  double time_percent = 0.0;  ///< of B against A
  std::optional<double> time_low, time_high;
  std::string time_verdict;  ///< "lower", "higher", "no difference beyond noise", …
  std::optional<double> a_joules, b_joules;
  std::optional<double> joules_percent, joules_low, joules_high;
  std::string joules_verdict;
};

struct SessionView {
  WorkView reading;
  std::string problem;
  std::string folder;              ///< of the session that is open; empty: none
  std::string state;               ///< "complete", "cut off: its program ended"
  std::vector<std::string> facts;  ///< machine, plan, sensor, one line each
  PlotData plots;
  std::string other_folder;  ///< of the one it is compared with
  std::vector<ChangeView> changes;
  std::vector<std::string> warnings;
};

struct SensorRow {
  std::string name;
  std::string place;
  std::string includes;
  bool usable = false;
  bool in_total = false;
  std::string period;  ///< "1.0 ms", empty: not seen
  std::optional<double> watts;
  std::string obstacle;  ///< what is in the way
  std::string way_out;
};
struct DoctorView {
  WorkView work;
  std::string machine;
  std::vector<SensorRow> sensors;
  std::vector<std::string> opengl;  ///< one line a device
  std::string conclusion;
};

/// One configuration held to the reference.
struct AccuracyResult {
  PaneDevice device = PaneDevice::cpu;
  accel::StructureKind structure = accel::StructureKind::bvh_median;
  accel::IntersectionMode intersection = accel::IntersectionMode::precise;
  int samples = 1;
  double rmse = 0.0;  ///< 1: as much as black differs from white
  std::uint64_t missed = 0;
  std::uint64_t invented = 0;
  std::uint64_t wrong_triangle = 0;
  std::optional<double> largest_t;  ///< relative error of t where the triangle is right
  std::optional<double> seconds;    ///< a frame, median
  std::optional<double> joules;     ///< a frame, gross
  bool best_by_time = false;        ///< on the Pareto front of error and time
  bool best_by_energy = false;
};

/// Error against run time, of the current scene.
struct AccuracyView {
  WorkView work;
  std::string problem;
  std::string of;  ///< what was compared: "mirrors, 256 × 256, shadows"
  std::vector<AccuracyResult> results;
  std::optional<double> reference_error;  ///< estimated RMSE of the reference itself
  energy::Provenance energy;              ///< of the joules, or why there are none
  int rounds = 0;                         ///< of timing, so far
  int rounds_wanted = 0;
  std::string csv;   ///< the results as accuracy.csv
  bool gpu = false;  ///< OpenGL can trace here
  std::string no_gpu;
};

/// What the window itself costs, and is.
struct WindowView {
  double frame_ms = 0.0;         ///< the last frame's
  double frame_median_ms = 0.0;  ///< of the last few hundred
  double frame_99_ms = 0.0;
  double processor_share = 0.0;  ///< of one core
  double frames_per_s = 0.0;
  std::uint64_t memory_bytes = 0;  ///< of the process
  std::string opengl;              ///< what draws the window
  bool opengl_software = false;
  float monitor_scale = 1.0F;
};

struct View {
  SceneView scene;
  std::array<PaneView, kPaneCount> panes;
  PaneView structure_view;  ///< the free 3D view; its texture and size
  std::optional<PickView> pick;
  MeasureView measure;
  energy::Provenance power;  ///< of the total
  bool power_opening = false;
  std::string power_problem;    ///< why the source that was asked for could not be opened
  double sampling_share = 0.0;  ///< of one core
  PlotData plots;               ///< of now
  RecorderView recorder;
  SessionView session;
  DoctorView doctor;
  AccuracyView accuracy;
  WindowView window;
};

}  // namespace encore::ui
