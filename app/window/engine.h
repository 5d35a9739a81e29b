#pragma once

#include "app/measuring_options.h"
#include "app/needs_cost.h"
#include "app/window/accuracy_task.h"
#include "app/window/doctor_view.h"
#include "app/window/export.h"
#include "app/window/live_attribution.h"
#include "app/window/measure_scheduler.h"
#include "app/window/opened_session.h"
#include "app/window/pane_worker.h"
#include "app/window/power_monitor.h"
#include "app/window/power_plots.h"
#include "app/window/recorder.h"
#include "app/window/scene_loader.h"
#include "ui/command.h"
#include "ui/ui_state.h"
#include "ui/view.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace encore::app {

/// Everything of the window that has no pixels: the scene, the two panes' workers, power, measuring
/// and recording, sessions. The window's thread calls it between frames; nothing here waits for
/// work.
class Engine {
 public:
  struct Setup {
    std::optional<int> gl_device;
    MeasuringOptions power;                ///< sources and model of the command line
    std::vector<std::string> search_path;  ///< of models
    std::function<void()> wake;            ///< there is news for the window; any thread
    int threads = 0;
  };
  explicit Engine(Setup setup);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  void open_scene(const std::string& name_or_path);
  /// Looks at what the panels have set and asks the workers for it; takes over what has been
  /// finished (a scene that was loaded sets the camera and the time).
  void apply(ui::UiState& state, double now_s);
  /// Carries out a command; false if it is none of the engine's.
  bool execute(const ui::Command& command, ui::UiState& state);
  /// Everything that panels read but pictures and the window itself.
  void fill(ui::View& view, const ui::UiState& state);

  /// What a pane shows last; null before the first.
  [[nodiscard]] std::shared_ptr<const PaneOutput> output(std::size_t pane) const {
    return workers_.at(pane)->output();
  }
  /// Whether something goes on that changes the window by itself, and so needs frames.
  [[nodiscard]] bool busy() const;
  [[nodiscard]] const std::shared_ptr<const scene::Scene>& scene() const { return scene_; }
  /// Ends measuring and recording; the session is whole when this returns.
  void shut_down();

 private:
  void take_scene(ui::UiState& state);
  void take_tasks(ui::UiState& state);
  void run_animation(ui::UiState& state, double now_s);
  void apply_measuring(const ui::UiState& state);
  [[nodiscard]] std::pair<int, int> picture_size(std::size_t pane, const ui::UiState& state) const;
  [[nodiscard]] PaneRequest request_of(std::size_t pane, const ui::UiState& state) const;
  [[nodiscard]] std::optional<energy::PerPhase<double>> policy_watts() const;
  void examine_sensors();
  void use_energy(const ui::EnergySettings& energy);
  void start_recording(const ui::UiState& state);
  void open_session(const std::filesystem::path& folder, bool other);
  void fill_scene(ui::View& view, const ui::UiState& state) const;
  void fill_pane(ui::View& view, std::size_t pane, const ui::UiState& state) const;
  void fill_power(ui::View& view, const ui::UiState& state);
  void fill_recorder(ui::View& view) const;
  void fill_session(ui::View& view) const;
  void fill_doctor(ui::View& view) const;
  void hold_panes(bool held, const std::atomic<bool>& stop);
  void start_accuracy(const ui::AccuracyChoice& choice, const ui::UiState& state);
  void save_accuracy(ui::UiState& state) const;
  void apply_accuracy(ui::UiState& state);
  void fill_accuracy(ui::View& view, const ui::UiState& state) const;
  void measure_left_out(const ui::UiState& state);
  void take_left_out();
  void fill_left_out(ui::SceneView& view, const ui::UiState& state) const;

  Setup setup_;
  std::unique_ptr<PowerMonitor> monitor_;
  std::unique_ptr<LiveAttribution> attribution_;
  std::unique_ptr<Recorder> recorder_;
  std::array<std::unique_ptr<PaneWorker>, ui::kPaneCount> workers_;
  std::unique_ptr<MeasureScheduler> scheduler_;
  PowerPlots plots_;
  PowerState power_;
  ui::EnergySettings energy_;  ///< as applied last
  std::vector<ui::AnnotationView> annotations_;

  SceneLoader loader_;
  std::shared_ptr<const scene::Scene> scene_;
  std::shared_ptr<const scene::SceneInfo> scene_info_;
  scene::Needs scene_could_use_;
  std::string scene_name_;  ///< as it was asked for
  std::string scene_problem_;
  double last_now_s_ = 0.0;

  struct PaneInput {
    std::uint64_t rebuild = 1;
    bool cancelled = false;
    std::optional<Probe> hover;
    std::optional<PickedRay> pick;
  };
  std::array<PaneInput, ui::kPaneCount> inputs_;
  std::array<ui::PaneSettings, ui::kPaneCount> last_panes_;
  std::shared_ptr<const Figures> figures_;
  std::vector<ui::ConfigurationView> configurations_;  ///< of figures_

  SessionOpener session_task_;
  SessionOpener other_task_;
  SessionExporter export_task_;
  std::string session_problem_;
  std::shared_ptr<const OpenedSession> session_;
  std::shared_ptr<const OpenedSession> other_session_;
  std::vector<ui::ChangeView> changes_;
  std::vector<std::string> comparison_warnings_;
  std::vector<ui::ConfigurationView> session_configurations_;
  PowerPlots session_plots_;
  DoctorTask doctor_task_;
  std::optional<DoctorFindings> doctor_;
  std::string doctor_problem_;
  BackgroundTask<std::vector<std::string>> opengl_task_;
  std::vector<std::string> opengl_lines_;
  BackgroundTask<bool> gpu_task_;  ///< asks whether OpenGL can trace
  std::optional<bool> gpu_;
  std::string no_gpu_;
  std::unique_ptr<AccuracyTask> accuracy_;

  /// What frames would cost with what they do without, and of which scene and rays that holds.
  struct LeftOutCost {
    std::shared_ptr<const scene::Scene> scene;
    scene::RaySettings rays;
    std::optional<NeedsCost> cost;

    [[nodiscard]] bool is_of(const scene::Scene* other, const scene::RaySettings& others) const;
  };
  LeftOutCost left_out_cost_;
  std::string needs_problem_;
  BackgroundTask<LeftOutCost> needs_task_;
};

}  // namespace encore::app
