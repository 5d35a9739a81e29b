#include "app/window/engine.h"

#include "app/device.h"
#include "app/model_constants.h"
#include "app/window/figures_view.h"
#include "app/window/scene_preferences.h"
#include "ui/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace encore::app {

namespace {

std::optional<Device> device_of(ui::PaneDevice device) {
  switch (device) {
    case ui::PaneDevice::cpu:
      return Device::cpu;
    case ui::PaneDevice::gpu:
      return Device::gpu;
    case ui::PaneDevice::raster:
      return Device::raster;
    case ui::PaneDevice::off:
      break;
  }
  return std::nullopt;
}

ui::SlotView::Kind slot_kind(ui::PaneDevice device) {
  switch (device) {
    case ui::PaneDevice::gpu:
      return ui::SlotView::Kind::gpu;
    case ui::PaneDevice::raster:
      return ui::SlotView::Kind::raster;
    default:
      return ui::SlotView::Kind::cpu;
  }
}

/// The picture's size for a pane that has so many pixels.
std::pair<int, int> size_of(const ui::PaneSettings& pane, const ui::UiState::Area& area) {
  switch (pane.size) {
    case ui::SizeChoice::square_256:
      return {256, 256};
    case ui::SizeChoice::square_512:
      return {512, 512};
    case ui::SizeChoice::square_768:
      return {768, 768};
    case ui::SizeChoice::square_1024:
      return {1024, 1024};
    case ui::SizeChoice::custom:
      return {std::clamp(pane.custom_width, 1, 16384), std::clamp(pane.custom_height, 1, 16384)};
    case ui::SizeChoice::window:
      break;
  }
  return {std::min(area.width, 16384), std::min(area.height, 16384)};
}

}  // namespace

Engine::Engine(Setup setup) : setup_(std::move(setup)) {
  monitor_ = std::make_unique<PowerMonitor>();
  monitor_->choose(setup_.power);
  attribution_ = std::make_unique<LiveAttribution>(*monitor_);
  recorder_ = std::make_unique<Recorder>(*monitor_, *attribution_);
  std::vector<PaneWorker*> panes;
  for (auto& worker : workers_) {
    worker = std::make_unique<PaneWorker>(
        PaneWorker::Setup{setup_.gl_device, monitor_.get(), attribution_.get(), setup_.wake,
                          [this](const energy::FrameRow& row) { recorder_->add(row); }});
    panes.push_back(worker.get());
  }
  scheduler_ = std::make_unique<MeasureScheduler>(MeasureScheduler::Setup{
      panes, attribution_.get(), &monitor_->clock(), monitor_->start(), setup_.wake});
  accuracy_ = std::make_unique<AccuracyTask>(AccuracyTask::Setup{
      [device = setup_.gl_device] { return standard_tools(std::make_shared<GpuContext>(device)); },
      [this](bool held, const std::atomic<bool>& end) { hold_panes(held, end); }, setup_.wake});
}

Engine::~Engine() {
  shut_down();
}

void Engine::shut_down() {
  if (!scheduler_) return;
  session_task_.cancel();
  other_task_.cancel();
  export_task_.cancel();
  doctor_task_.cancel();
  loader_.cancel();
  // Whatever may wait for a worker goes before the workers, and they before what they tell.
  accuracy_->cancel();
  accuracy_.reset();
  needs_task_.cancel();
  needs_task_.wait();
  scheduler_.reset();
  for (auto& worker : workers_) worker.reset();
  recorder_->stop();
  recorder_->wait();
}

void Engine::open_scene(const std::string& name_or_path) {
  scene_problem_.clear();
  loader_.start(name_or_path, setup_.search_path, setup_.wake);
}

void Engine::take_scene(ui::UiState& state) {
  if (auto loaded = loader_.take_scene()) {
    if (!loaded->scene) {
      scene_problem_ = loaded->problem;
      if (!loaded->problem.empty()) ui::tell(state, loaded->problem, true);
    } else {
      const bool reloaded = scene_ && scene_name_ == loaded->name;
      accuracy_->cancel();
      scene_ = loaded->scene;
      scene_name_ = loaded->name;
      scene_info_.reset();
      scene_could_use_ = {};
      scene_problem_.clear();
      if (!reloaded) {
        state.camera = scene_->camera;
        state.free_camera.reset();
        state.time_s = 0.0;
        for (const std::string& problem : apply_preferences(*scene_, state.settings)) {
          ui::tell(state, problem, true);
        }
      }
      state.selected_node.reset();
      state.ray_step = 0;
      for (PaneInput& input : inputs_) {
        input.cancelled = false;
        input.hover.reset();
        input.pick.reset();
      }
      attribution_->clear();
      ui::remember(state.preferences.recent_scenes, scene_name_);
    }
  }
  if (auto described = loader_.take_info()) {
    scene_info_ = std::move(described->info);
    scene_could_use_ = described->could_use;
  }
}

void Engine::take_tasks(ui::UiState& state) {
  if (auto result = session_task_.take()) {
    if (result->value) {
      session_ = *result->value;
      other_session_.reset();
      changes_.clear();
      session_plots_.show(*session_);
      session_configurations_ = views_of(*session_);
      state.show_session = true;
      ui::remember(state.preferences.recent_sessions, session_->folder.string());
    } else if (!result->cancelled) {
      session_problem_ = result->error;
      ui::tell(state, result->error, true);
    }
  }
  if (auto result = other_task_.take()) {
    if (result->value && session_) {
      other_session_ = *result->value;
      const OpenedComparison comparison = compare_opened(*session_, *other_session_);
      changes_ = views_of(comparison);
      comparison_warnings_ = comparison.warnings;
      for (const std::string& name : comparison.only_a) {
        comparison_warnings_.push_back("only in the first: " + name);
      }
      for (const std::string& name : comparison.only_b) {
        comparison_warnings_.push_back("only in the second: " + name);
      }
      if (changes_.empty()) {
        ui::tell(state, "the two sessions have no configuration in common", true);
      }
    } else if (!result->cancelled) {
      session_problem_ = result->error;
      ui::tell(state, result->error, true);
    }
  }
  if (auto result = export_task_.take()) {
    if (result->value) {
      ui::tell(state,
               fmt::format("exported {} files to {}", result->value->files,
                           result->value->folder.string()),
               false);
    } else if (!result->cancelled) {
      ui::tell(state, result->error, true);
    }
  }
  if (auto result = doctor_task_.take()) {
    if (result->value) doctor_ = std::move(*result->value);
    doctor_problem_ = result->error;
  }
  if (auto result = opengl_task_.take(); result && result->value) {
    opengl_lines_ = std::move(*result->value);
  }
  const bool asked = doctor_ || !doctor_problem_.empty() || doctor_task_.running();
  if (state.doctor_open && !asked) examine_sensors();
}

void Engine::run_animation(ui::UiState& state, double now_s) {
  const double step = std::clamp(now_s - last_now_s_, 0.0, 0.25);
  last_now_s_ = now_s;
  if (!scene_ || !scene_->animated() || !state.settings.animation.playing || state.measuring) {
    return;
  }
  const double duration = scene_->duration_s();
  if (!(duration > 0.0)) return;
  state.time_s += step * double(state.settings.animation.speed);
  if (state.settings.animation.loop) {
    state.time_s = std::fmod(state.time_s, duration);
    if (state.time_s < 0.0) state.time_s += duration;
  } else if (state.time_s >= duration || state.time_s < 0.0) {
    state.time_s = std::clamp(state.time_s, 0.0, duration);
    state.settings.animation.playing = false;
  }
}

std::pair<int, int> Engine::picture_size(std::size_t pane, const ui::UiState& state) const {
  const ui::PaneSettings& settings = state.settings.panes[pane];
  const ui::PaneSettings& other = state.settings.panes[1 - pane];
  const auto size = size_of(settings, state.picture_areas[pane]);
  if (other.device == ui::PaneDevice::off) return size;
  const auto others = size_of(other, state.picture_areas[1 - pane]);
  // A difference is of pictures of one size: the other pane's.
  if (settings.content == ui::PaneContent::difference) return others;
  // Panes that share the window's odd pixel are meant to be compared.
  constexpr int kOdd = 4;
  const bool both = settings.size == ui::SizeChoice::window && other.size == settings.size;
  if (both && std::abs(size.first - others.first) <= kOdd &&
      std::abs(size.second - others.second) <= kOdd) {
    return {std::min(size.first, others.first), std::min(size.second, others.second)};
  }
  return size;
}

std::optional<energy::PerPhase<double>> Engine::policy_watts() const {
  try {
    return phase_watts(model_constants(monitor_->chosen().model));
  } catch (const energy::PowerModelError&) {
    return std::nullopt;  // whoever opens the model says what is wrong with it
  }
}

PaneRequest Engine::request_of(std::size_t pane, const ui::UiState& state) const {
  const ui::PaneSettings& settings = state.settings.panes[pane];
  const PaneInput& input = inputs_[pane];
  PaneRequest request;
  request.scene = scene_;
  request.device = device_of(settings.device);
  request.structure = settings.structure;
  request.policy = settings.policy;
  request.build_on = settings.build_on;
  if (settings.policy == accel::Policy::automatic) request.phase_watts = policy_watts();
  request.threads = settings.threads > 0 ? settings.threads : setup_.threads;
  request.rays = state.settings.rays;
  request.time_s = state.time_s;
  request.camera = state.camera;
  std::tie(request.width, request.height) = picture_size(pane, state);
  request.moving = state.camera_moving;
  request.rebuild = input.rebuild;
  request.cancelled = input.cancelled;
  request.content = settings.content;
  request.heatmap = state.settings.heatmap;
  const auto other = workers_[1 - pane]->output();
  const bool differs = settings.content == ui::PaneContent::difference;
  const bool other_differs = state.settings.panes[1 - pane].content == ui::PaneContent::difference;
  if (differs) request.other = other;
  const bool inspected = state.inspected_pane == pane;
  const bool overlay = state.settings.overlay.show;
  request.hits = differs || other_differs ||
                 (overlay && state.settings.overlay.hidden != ui::HiddenLines::x_ray) ||
                 input.pick.has_value();
  request.nodes =
      overlay || (inspected && (state.structure_view || state.preferences.layout.right));
  request.node_color = state.settings.overlay.color;
  if (inspected) request.selected_node = state.selected_node;
  if (inspected && state.structure_view && state.free_camera) {
    const ui::UiState::Area& area = state.picture_areas[ui::kPaneCount];
    if (area.width > 0 && area.height > 0) {
      request.free = FreeView{*state.free_camera, area.width, area.height};
    }
  }
  request.hover = input.hover;
  request.pick = input.pick;
  if (settings.content == ui::PaneContent::heatmap &&
      state.settings.heatmap.cost == ui::HeatmapCost::energy) {
    // The last figure of this configuration, or what was entered for a busy machine.
    const auto out = workers_[pane]->output();
    const ui::EnergySettings& energy = state.settings.energy;
    if (energy.from == ui::EnergySettings::From::model && energy.busy_watts > 0.0F && out &&
        out->frame && out->frame->render_s) {
      request.frame_joules = double(energy.busy_watts) * *out->frame->render_s;
      request.frame_energy = {energy::Origin::modelled,
                              fmt::format("{} W while busy, as entered", energy.busy_watts)};
    }
    for (const ui::ConfigurationView& configuration : configurations_) {
      if (configuration.pane == pane && configuration.joules.value) {
        request.frame_joules = configuration.joules.value;
        request.frame_energy = configuration.joules.provenance;
      }
    }
    if (!request.frame_joules) {
      request.frame_energy = {
          energy::Origin::unavailable,
          "no joules a frame are known: use measure mode with a power source, or enter idle and "
          "busy watts"};
    }
  }
  return request;
}

void Engine::apply_measuring(const ui::UiState& state) {
  scheduler_->set(state.settings.measure);
  for (std::size_t pane = 0; pane < ui::kPaneCount; ++pane) {
    const ui::PaneSettings& settings = state.settings.panes[pane];
    std::string label(ui::to_string(settings.device));
    const auto device = device_of(settings.device);
    if (device && traces_rays(*device)) {
      label += fmt::format(" {}", accel::to_string(settings.structure.kind));
    }
    scheduler_->label(pane, slot_kind(settings.device), std::move(label));
  }
  if (state.measuring) {
    scheduler_->start();
  } else {
    scheduler_->stop();
  }
}

void Engine::apply(ui::UiState& state, double now_s) {
  take_scene(state);
  take_tasks(state);
  apply_accuracy(state);
  take_left_out();
  run_animation(state, now_s);
  power_ = monitor_->state();
  plots_.add(monitor_->drain(), power_);
  const auto figures = attribution_->latest();
  if (figures != figures_) {
    figures_ = figures;
    configurations_ = figures_ ? views_of(*figures_) : std::vector<ui::ConfigurationView>{};
  }
  const ui::MeasureSettings& measure = state.settings.measure;
  if (state.measuring && measure.stop_at_target && !configurations_.empty()) {
    const auto reached = [&measure](const ui::ConfigurationView& one) {
      const auto& errors = one.joules_error.empty() ? one.time_error : one.joules_error;
      // An interval of few samples may be narrow by chance.
      constexpr double kLeastSamples = 40.0;
      return !errors.empty() && errors.back().samples.value_or(0.0) >= kLeastSamples &&
             errors.back().relative * 100.0 <= double(measure.target_percent);
    };
    if (std::all_of(configurations_.begin(), configurations_.end(), reached)) {
      state.measuring = false;
      ui::tell(state, fmt::format("every configuration is known to {} %", measure.target_percent),
               false);
    }
  }
  for (std::size_t pane = 0; pane < ui::kPaneCount; ++pane) {
    // Another structure or device is a fresh start after a cancel.
    if (!(state.settings.panes[pane] == last_panes_[pane])) inputs_[pane].cancelled = false;
    last_panes_[pane] = state.settings.panes[pane];
    workers_[pane]->ask(request_of(pane, state));
  }
  apply_measuring(state);
}

bool Engine::busy() const {
  if (loader_.loading() || session_task_.running() || other_task_.running() ||
      export_task_.running() || doctor_task_.running() || gpu_task_.running() ||
      (accuracy_ && accuracy_->running()) || needs_task_.running() || power_.opening) {
    return true;
  }
  for (const auto& worker : workers_) {
    if (worker->status().state == ui::PaneState::working) return true;
  }
  return scheduler_->running();
}

}  // namespace encore::app
