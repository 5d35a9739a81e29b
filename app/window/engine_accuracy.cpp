#include "app/gpu_device.h"
#include "app/model_constants.h"
#include "app/ray_options.h"
#include "app/window/engine.h"
#include "app/window/picture_file.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <string>
#include <thread>
#include <utility>

namespace encore::app {

namespace {

constexpr std::chrono::milliseconds kLook{2};

/// Only constants give the joules of single frames; the rest is said in words.
void choose_model(const MeasuringOptions& power, AccuracyRequest& request) {
  request.no_joules =
      "the frames are too short for sensors here; encore accuracy measures with them, and watts "
      "that are entered give modelled joules";
  try {
    request.model = model_constants(power.model);
  } catch (const energy::PowerModelError& error) {
    request.no_joules = error.what();
  }
}

std::string words_for(const AccuracyReference::Plan& plan) {
  std::string rays = ray_list(plan.rays);
  for (std::size_t at = 0; (at = rays.find(',', at)) != std::string::npos;) {
    rays.insert(++at, " ");
  }
  return fmt::format("{}, {} × {}, {}reference of {} samples a pixel", plan.scene->name,
                     plan.size.width, plan.size.height, rays == "none" ? "" : "with " + rays + ", ",
                     plan.samples);
}

}  // namespace

void Engine::hold_panes(bool held, const std::atomic<bool>& stop) {
  // Measure mode has been told to end; its slot may take a while.
  while (held && scheduler_->running() && !stop) std::this_thread::sleep_for(kLook);
  for (const auto& worker : workers_) worker->hold(held);
  for (const auto& worker : workers_) {
    while (held && !worker->at_rest() && !stop) std::this_thread::sleep_for(kLook);
  }
}

void Engine::start_accuracy(const ui::AccuracyChoice& choice, const ui::UiState& state) {
  if (!scene_) return;
  AccuracyRequest request;
  AccuracyReference::Plan& plan = request.plan;
  plan.scene = scene_;
  plan.rays = useful_rays(*scene_, state.settings.rays);
  plan.size = {choice.side, choice.side};
  plan.samples = choice.reference_samples;
  plan.threads = setup_.threads;
  plan.camera = state.camera;
  plan.time_s = state.time_s;
  for (const ui::PaneDevice device : choice.devices) {
    for (const accel::StructureKind kind : choice.structures) {
      for (const accel::IntersectionMode mode : choice.modes) {
        for (const int samples : choice.samples) {
          WorkloadSpec spec;
          spec.scene = scene_;
          spec.device = device == ui::PaneDevice::gpu ? Device::gpu : Device::cpu;
          spec.structure = accel::default_spec(kind);
          // A pane's own settings of that structure are what the user looks at.
          for (const ui::PaneSettings& pane : state.settings.panes) {
            if (pane.structure.kind == kind) spec.structure = pane.structure;
          }
          spec.structure.intersection = mode;
          spec.test = TestKind::fixed;
          spec.size = plan.size;
          spec.threads = plan.threads;
          spec.rays = plan.rays;
          spec.rays.samples = samples;
          request.specs.push_back(std::move(spec));
        }
      }
    }
  }
  if (request.specs.empty()) return;
  choose_model(monitor_->chosen(), request);
  request.of = words_for(plan);
  accuracy_->start(std::move(request));
}

void Engine::save_accuracy(ui::UiState& state) const {
  try {
    std::filesystem::path folder = new_picture_file("accuracy");
    folder.replace_extension();
    accuracy_->save(folder);
    ui::tell(state, "saved accuracy.csv and the scatter to " + folder.string());
  } catch (const std::exception& error) {
    ui::tell(state, error.what(), true);
  }
}

void Engine::apply_accuracy(ui::UiState& state) {
  accuracy_->poll();
  if (accuracy_->running() && std::exchange(state.measuring, false)) {
    ui::tell(state, "measure mode waits until the comparison of accuracy has ended");
  }
  if (auto result = gpu_task_.take()) {
    gpu_ = result->value.value_or(false);
    no_gpu_ = result->error;
  }
  if (!state.accuracy.open || gpu_ || gpu_task_.running()) return;
  gpu_task_.start([device = setup_.gl_device, wake = setup_.wake](TaskControl&) {
    GpuContext gpu(device);
    gpu.info();
    if (wake) wake();
    return true;
  });
}

void Engine::fill_accuracy(ui::View& view, const ui::UiState& state) const {
  view.accuracy = {};
  if (!accuracy_ || (!state.accuracy.open && !accuracy_->running())) return;
  view.accuracy = accuracy_->view();
  view.accuracy.gpu = gpu_.value_or(false);
  view.accuracy.no_gpu = no_gpu_;
}

}  // namespace encore::app
