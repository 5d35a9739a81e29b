#include "app/window/engine.h"
#include "app/window/figures_view.h"
#include "app/window/pane_rows.h"
#include "app/window/steady_time.h"
#include "app/workloads.h"
#include "ui/plot/sample_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

ui::WorkView work_of(bool active, std::string doing, std::optional<double> progress,
                     bool cancellable, double elapsed_s) {
  ui::WorkView work;
  work.active = active;
  work.doing = std::move(doing);
  work.progress = progress;
  work.cancellable = cancellable;
  work.elapsed_s = elapsed_s;
  return work;
}

}  // namespace

void Engine::fill_scene(ui::View& view, const ui::UiState& state) const {
  ui::SceneView& scene = view.scene;
  scene = {};
  scene.scene = scene_;
  scene.info = scene_info_;
  scene.could_use = scene_could_use_;
  scene.problem = scene_problem_;
  if (scene_) {
    scene.animated = scene_->animated();
    scene.duration_s = scene_->duration_s();
    scene.warnings = scene_->warnings.messages;
  }
  for (const auto& worker : workers_) {
    const auto output = worker->output();
    if (output && scene.left_out.empty()) scene.left_out = output->left_out;
  }
  fill_left_out(scene, state);
  scene.loading =
      work_of(loader_.loading(), loader_.doing(), loader_.progress(), true, loader_.elapsed_s());
}

void Engine::fill_pane(ui::View& view, std::size_t pane, const ui::UiState& state) const {
  ui::PaneView& out = view.panes[pane];
  const std::uint64_t texture = out.texture;
  out = {};
  out.texture = texture;
  const PaneStatus status = workers_[pane]->status();
  out.state = status.state;
  out.problem = status.problem;
  // In measure mode the header says whose slot it is.
  const bool working = status.state == ui::PaneState::working && !workers_[pane]->in_slot();
  const double elapsed = working ? steady_now() - status.since_s : 0.0;
  out.work = work_of(working, status.doing, status.progress, !state.measuring, elapsed);
  out.my_slot = workers_[pane]->in_slot();
  const PaneRequest request = request_of(pane, state);
  out.width = request.width;
  out.height = request.height;
  const auto output = workers_[pane]->output();
  if (!output) return;
  if (output->screen) {
    out.traced_width = output->screen->width;
    out.traced_height = output->screen->height;
  }
  out.frame = output->frame;
  out.refinement = output->refinement;
  if (out.frame && out.frame->total_s() > 0.0 &&
      (state.measuring || state.settings.animation.playing || state.camera_moving)) {
    out.frames_per_s = 1.0 / out.frame->total_s();
  }
  out.device = output->device;
  out.software = output->software;
  out.refits_on_device = output->refits_on_device;
  out.stats = output->stats;
  out.nodes = output->nodes;
  out.profile = output->profile;
  out.sah_decay = output->sah_decay;
  out.break_even_frames = output->break_even_frames;
  out.selected_triangles = output->selected_triangles;
  out.heatmap = output->heatmap;
  out.difference = output->difference;
  if (output->hover && request.hover) out.hover = output->hover->pixel;
  out.memory_bytes = output->memory_bytes;
  out.joules_per_frame.provenance = view.power;
  for (const ui::ConfigurationView& configuration : configurations_) {
    if (configuration.pane != pane) continue;
    out.joules_per_frame = configuration.joules;
    for (const ui::PhaseFigure& phase : configuration.phases) {
      if (phase.phase == "render") out.render_joules = phase.joules;
    }
  }
  if (!out.joules_per_frame.value &&
      out.joules_per_frame.provenance.origin != energy::Origin::unavailable) {
    out.joules_per_frame.provenance = {energy::Origin::unavailable,
                                       state.measuring
                                           ? "not known yet: the first slots are under way"
                                           : "start measure mode to learn what a frame costs"};
  }
  if (output->pick && request.pick) {
    ui::PickView pick;
    pick.pane = pane;
    pick.pixel = output->pick->pixel;
    pick.path = output->pick->path;
    pick.sentences = output->pick->sentences;
    pick.nodes = output->pick->nodes;
    view.pick = std::move(pick);
  }
}

void Engine::fill_power(ui::View& view, const ui::UiState& state) {
  view.power = power_.total;
  view.power_opening = power_.opening;
  view.power_problem = power_.error;
  view.sampling_share = power_.cost.share();
  ui::PlotData& plots = view.plots;
  plots = {};
  plots.power = plots_.views(power_);
  if (power_.total.origin == energy::Origin::unavailable) plots.no_power = power_.total.detail;
  if (figures_ && figures_->idle_watts) plots.idle_watts = figures_->idle_watts->value;
  for (const LiveFigures& one : figures_ ? figures_->configurations : std::vector<LiveFigures>{}) {
    if (one.summary.idle_watts_ci95) plots.idle_half_width = one.summary.idle_watts_ci95->value;
  }
  plots.slots = scheduler_->slots();
  plots.annotations = annotations_;
  plots.now_s = (monitor_->clock().now() - monitor_->start()).value;
  // Which configurations are those of the panes as they are set now.
  for (ui::ConfigurationView& configuration : configurations_) configuration.pane.reset();
  for (std::size_t pane = 0; pane < ui::kPaneCount && figures_; ++pane) {
    const PaneRequest request = request_of(pane, state);
    const auto output = workers_[pane]->output();
    if (!request.device || !request.scene || !output) continue;
    const WorkloadSpec spec = workload_of(request, state.settings.measure.forced, output->software);
    const auto wanted = configuration_of(spec, output->triangles);
    for (std::size_t i = 0; i < figures_->configurations.size() && i < configurations_.size();
         ++i) {
      if (figures_->configurations[i].configuration == wanted) configurations_[i].pane = pane;
    }
  }
  plots.configurations = configurations_;
  for (std::size_t pane = 0; pane < ui::kPaneCount; ++pane) {
    const auto output = workers_[pane]->output();
    if (!output || !output->refinement || output->refinement->errors.empty()) continue;
    const ui::PaneSettings& settings = state.settings.panes[pane];
    plots.pictures.push_back(
        {fmt::format("{} pane, {}", pane == 0 ? "left" : "right", ui::to_string(settings.device)),
         output->refinement->errors});
  }
}

void Engine::fill_recorder(ui::View& view) const {
  const RecorderState state = recorder_->state();
  ui::RecorderView& recorder = view.recorder;
  recorder = {};
  using State = ui::RecorderView::State;
  switch (state.mode) {
    case RecorderMode::off:
    case RecorderMode::stopping:
      recorder.state = State::off;
      break;
    case RecorderMode::starting:
    case RecorderMode::recording:
      recorder.state = State::recording;
      break;
    case RecorderMode::paused:
      recorder.state = State::paused;
      break;
    case RecorderMode::failed:
      recorder.state = State::failed;
      break;
  }
  recorder.seconds = state.seconds;
  recorder.rows = state.rows + state.samples;
  recorder.bytes = state.bytes;
  recorder.folder = state.folder.string();
  if (state.mode == RecorderMode::failed) recorder.problem = state.message;
}

void Engine::fill_session(ui::View& view) const {
  ui::SessionView& session = view.session;
  session = {};
  const bool reading = session_task_.running() || other_task_.running();
  const bool exporting = export_task_.running();
  const double progress = session_task_.running() ? session_task_.progress()
                          : other_task_.running() ? other_task_.progress()
                                                  : export_task_.progress();
  session.reading =
      work_of(reading || exporting, exporting ? "exporting" : "reading", progress, true, 0.0);
  session.problem = session_problem_;
  if (!session_) return;
  session.folder = session_->folder.string();
  session.state = session_->cut_off ? "cut off: its program ended without saying so"
                                    : std::string(to_string(session_->session.info.state));
  const energy::SessionInfo& info = session_->session.info;
  session.facts = {
      fmt::format("{}, started {}", info.program, info.started_utc),
      fmt::format("plan {}", info.plan.name),
      fmt::format("power: {} ({})", info.sensor.detail, to_string(info.sensor.origin))};
  std::string line;
  for (const char c : session_->machine_card + "\n") {
    if (c != '\n') {
      line += c;
    } else if (!line.empty()) {
      session.facts.push_back(std::exchange(line, {}));
    }
  }
  for (const std::string& remark : session_->remarks) session.facts.push_back(remark);
  session.plots.power = session_plots_.views(*session_);
  if (session.plots.power.empty()) session.plots.no_power = info.sensor.detail;
  for (const energy::WindowRow& window : session_->session.windows) {
    ui::SlotView slot;
    slot.from_s = window.from.value;
    slot.to_s = window.to.value;
    slot.kind = ui::SlotView::Kind::idle;
    slot.label = window.kind;
    if (window.kind != "idle") {
      slot.kind = ui::SlotView::Kind::cpu;
      for (const energy::KeyValue& part : window.configuration) {
        if (part.key != "device") continue;
        if (part.value == "gpu") slot.kind = ui::SlotView::Kind::gpu;
        if (part.value == "raster") slot.kind = ui::SlotView::Kind::raster;
      }
    }
    session.plots.slots.push_back(std::move(slot));
  }
  for (const energy::EventRow& event : session_->session.events) {
    session.plots.annotations.push_back({event.time.value, event.message});
  }
  session.plots.configurations = session_configurations_;
  for (const energy::SummaryRow& summary : session_->session.summaries) {
    if (summary.idle_watts) session.plots.idle_watts = summary.idle_watts->value;
    if (summary.idle_watts_ci95) session.plots.idle_half_width = summary.idle_watts_ci95->value;
  }
  session.plots.now_s = session_->seconds;
  if (other_session_) session.other_folder = other_session_->folder.string();
  session.changes = changes_;
  session.warnings = comparison_warnings_;
}

void Engine::fill_doctor(ui::View& view) const {
  ui::DoctorView& doctor = view.doctor;
  doctor = {};
  doctor.work =
      work_of(doctor_task_.running(), "looking at the sensors", doctor_task_.progress(), true, 0.0);
  doctor.opengl = opengl_lines_;
  if (!doctor_problem_.empty()) doctor.conclusion = doctor_problem_;
  if (!doctor_) return;
  doctor.machine = doctor_->host;
  for (const DoctorRow& row : doctor_->sensors) {
    ui::SensorRow sensor;
    sensor.name = row.name;
    sensor.place = row.place;
    sensor.includes = row.includes;
    sensor.usable = row.usable;
    sensor.in_total = row.in_total;
    if (row.period_s) {
      sensor.period =
          fmt::format("{}{:.1f} ms", row.period_is_bound ? "at most " : "", *row.period_s * 1e3);
    }
    sensor.watts = row.watts;
    sensor.obstacle = row.reason;
    sensor.way_out = row.way_out;
    doctor.sensors.push_back(std::move(sensor));
  }
  if (!doctor_->any_usable) doctor.conclusion = doctor_->advice;
}

void Engine::fill(ui::View& view, const ui::UiState& state) {
  view.pick.reset();
  fill_scene(view, state);
  fill_power(view, state);
  for (std::size_t pane = 0; pane < ui::kPaneCount; ++pane) fill_pane(view, pane, state);
  view.measure = scheduler_->view();
  view.measure.together =
      "the panes run by turns: a sensor that sees the whole machine could not tell them apart";
  fill_recorder(view);
  fill_session(view);
  fill_doctor(view);
  fill_accuracy(view, state);
}

}  // namespace encore::app
