#include "app/doctor_opengl.h"
#include "app/window/engine.h"

#include <fmt/format.h>

#include <type_traits>
#include <utility>
#include <variant>

namespace encore::app {

namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

}  // namespace

void Engine::examine_sensors() {
  doctor_problem_.clear();
  DoctorRequest request;
  request.sensor_root = setup_.power.sensor_root;
  doctor_task_.start([request, wake = setup_.wake](TaskControl& control) {
    auto findings = examine_for_window(request, control);
    wake();
    return findings;
  });
  opengl_task_.start([wake = setup_.wake](TaskControl&) {
    std::vector<std::string> lines;
    std::string line;
    for (const char c : opengl_text(examine_opengl()) + "\n") {
      if (c != '\n') {
        line += c;
      } else if (!line.empty()) {
        lines.push_back(std::exchange(line, {}));
      }
    }
    wake();
    return lines;
  });
}

void Engine::use_energy(const ui::EnergySettings& energy) {
  MeasuringOptions options = setup_.power;
  switch (energy.from) {
    case ui::EnergySettings::From::automatic:
      break;
    case ui::EnergySettings::From::chosen:
      options.sources = {energy.source};
      options.model.clear();
      break;
    case ui::EnergySettings::From::model:
      options.sources.clear();
      options.model = model_from_watts(double(energy.idle_watts), double(energy.busy_watts));
      break;
  }
  monitor_->choose(std::move(options));
  energy_ = energy;
}

void Engine::start_recording(const ui::UiState& state) {
  RecordingSetup setup;
  setup.name = scene_ ? scene_->name : "window";
  if (scene_) setup.scenes = {scene_name_};
  setup.settings = {{"slot_s", fmt::format("{}", state.settings.measure.slot_s)},
                    {"idle_s", fmt::format("{}", state.settings.measure.idle_s)}};
  annotations_.clear();
  recorder_->start(std::move(setup));
}

void Engine::open_session(const std::filesystem::path& folder, bool other) {
  session_problem_.clear();
  SessionOpener& task = other ? other_task_ : session_task_;
  task.start([folder, wake = setup_.wake](TaskControl& control) {
    auto session = open_for_window(folder, control);
    wake();
    return session;
  });
}

bool Engine::execute(const ui::Command& command, ui::UiState& state) {
  const auto other = [](const auto&) { return false; };
  return std::visit(
      Overloaded{[this](const ui::OpenScene& open) {
                   open_scene(open.name_or_path);
                   return true;
                 },
                 [this](const ui::ReloadScene&) {
                   if (!scene_name_.empty()) open_scene(scene_name_);
                   return true;
                 },
                 [this](const ui::CancelWork& cancel) {
                   if (cancel.pane) {
                     inputs_.at(*cancel.pane).cancelled = true;
                   } else {
                     loader_.cancel();
                   }
                   return true;
                 },
                 [this](const ui::Rebuild& rebuild) {
                   PaneInput& input = inputs_.at(rebuild.pane);
                   // After a cancel what was under way goes on; else it is built again.
                   if (!std::exchange(input.cancelled, false)) ++input.rebuild;
                   return true;
                 },
                 [this](const ui::HoverPixel& hover) {
                   inputs_.at(hover.pane).hover = Probe{hover.x, hover.y};
                   return true;
                 },
                 [this, &state](const ui::PickPixel& pick) {
                   for (PaneInput& input : inputs_) input.pick.reset();
                   const PaneRequest request = request_of(pick.pane, state);
                   if (request.width <= 0) return true;
                   const Probe pixel{pick.x, pick.y};
                   inputs_.at(pick.pane).pick = PickedRay{
                       pixel, ray_of(request.camera, pixel, request.width, request.height)};
                   state.ray_step = 0;
                   state.inspected_pane = pick.pane;
                   return true;
                 },
                 [this, &state](const ui::ClearPick&) {
                   for (PaneInput& input : inputs_) input.pick.reset();
                   state.ray_step = 0;
                   return true;
                 },
                 [this, &state](const ui::StartRecording&) {
                   start_recording(state);
                   return true;
                 },
                 [this](const ui::PauseRecording& pause) {
                   if (pause.paused) {
                     recorder_->pause();
                   } else {
                     recorder_->resume();
                   }
                   return true;
                 },
                 [this](const ui::StopRecording&) {
                   recorder_->stop();
                   return true;
                 },
                 [this](const ui::Annotate& note) {
                   const double now = (monitor_->clock().now() - monitor_->start()).value;
                   annotations_.push_back({now, note.text});
                   recorder_->annotate(note.text);
                   return true;
                 },
                 [this](const ui::ClearResults&) {
                   attribution_->clear();
                   return true;
                 },
                 [this](const ui::OpenSession& open) {
                   open_session(open.folder, false);
                   return true;
                 },
                 [this, &state](const ui::CompareSession& compare) {
                   if (session_) {
                     open_session(compare.folder, true);
                   } else {
                     ui::tell(state, "open the session to compare with first", true);
                   }
                   return true;
                 },
                 [this, &state](const ui::CloseSession&) {
                   session_.reset();
                   other_session_.reset();
                   changes_.clear();
                   comparison_warnings_.clear();
                   state.show_session = false;
                   return true;
                 },
                 [this](const ui::CancelSession&) {
                   session_task_.cancel();
                   other_task_.cancel();
                   export_task_.cancel();
                   return true;
                 },
                 [this](const ui::ExportSession& to) {
                   export_task_.start([to, wake = setup_.wake](TaskControl& control) {
                     auto result = export_session(to.from, to.to, control);
                     wake();
                     return result;
                   });
                   return true;
                 },
                 [this, &state](const ui::ApplyEnergy&) {
                   try {
                     use_energy(state.settings.energy);
                   } catch (const std::exception& error) {
                     ui::tell(state, error.what(), true);
                   }
                   return true;
                 },
                 [this](const ui::ExamineSensors& examine) {
                   if (examine.stop) {
                     doctor_task_.cancel();
                     return true;
                   }
                   examine_sensors();
                   return true;
                 },
                 [this, &state](const ui::StartAccuracy& start) {
                   start_accuracy(start.choice, state);
                   return true;
                 },
                 [this](const ui::StopAccuracy&) {
                   accuracy_->cancel();
                   return true;
                 },
                 [this, &state](const ui::MeasureLeftOut&) {
                   measure_left_out(state);
                   return true;
                 },
                 [this, &state](const ui::SaveAccuracy&) {
                   save_accuracy(state);
                   return true;
                 },
                 other},
      command);
}

}  // namespace encore::app
