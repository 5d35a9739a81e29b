#include "ui/panels/settings_column.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/value_text.h"
#include "ui/shortcuts.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

void draw_mode(const ColumnContext& context) {
  UiState& state = context.state;
  if (text_button({"settings.measure.mode", state.measuring ? "Stop measuring" : "Start measuring",
                   fmt::format("In measure mode the panes trace by turns with rests between, and "
                               "figures are collected ({}).",
                               shortcut_text(Action::measure))})) {
    state.measuring = !state.measuring;
  }
  if (text_button_beside({"settings.measure.clear", "Clear results",
                          "Forgets what measure mode has found so far, of all configurations."})) {
    context.commands.push_back(ClearResults{});
  }
  const MeasureView& measure = context.view.measure;
  if (measure.measuring) {
    const std::string doing =
        fitted(measure.doing, std::max(ImGui::GetContentRegionAvail().x, 1.0F));
    ImGui::TextUnformatted(doing.c_str());
    note_widget("settings.measure.doing", measure.doing);
    tooltip("What goes on now: whose slot it is, and how far.");
    progress_bar(ImGui::GetContentRegionAvail().x, &measure.progress);
  }
  hint_line(measure.together);
}

void draw_slots(MeasureSettings& measure) {
  const MeasureSettings usual;
  number_row(NumberRow<float>{.row = {"settings.measure.slot", "Slot",
                                      "Seconds that one pane traces alone. It should be many times "
                                      "the sensor's period: too short, and the two ends, which no "
                                      "reading tells apart, weigh heavily."},
                              .low = 0.01F,
                              .high = 3600.0F,
                              .format = "%.2f s",
                              .usual = usual.slot_s,
                              .logarithmic = true,
                              .most_slid = 60.0F},
             measure.slot_s);
  number_row(NumberRow<float>{.row = {"settings.measure.idle", "Idle",
                                      "Seconds before each slot in which nothing runs, so that "
                                      "idle power is known. 0: no rests, and no figures above "
                                      "idle."},
                              .high = 3600.0F,
                              .format = "%.2f s",
                              .usual = usual.idle_s,
                              .most_slid = 30.0F},
             measure.idle_s);
}

void draw_rules(const View& view, MeasureSettings& measure) {
  // A scene that moves is updated before each frame anyway.
  if (!view.scene.animated) {
    toggle_row({"settings.measure.forced", "Update though nothing moves",
                "Builds or updates, by the policy, before each frame of a static scene: the "
                "thesis' dynamic tests."},
               measure.forced);
  }
  toggle_row({"settings.measure.stop_at_target", "Stop at target",
              "Ends measure mode when every pane's figure is as sure as the target asks."},
             measure.stop_at_target);
  number_row(NumberRow<float>{.row = {"settings.measure.target", "Target",
                                      "Half-width of the 95 % interval over the mean, in per cent; "
                                      "the line in the plot of errors."},
                              .low = 0.001F,
                              .high = 100.0F,
                              .format = "±%.3g %%",
                              .usual = MeasureSettings{}.target_percent,
                              .logarithmic = true,
                              .most_slid = 20.0F},
             measure.target_percent);
}

void draw_recording(const ColumnContext& context) {
  const RecorderView& recorder = context.view.recorder;
  const bool paused = recorder.state == RecorderView::State::paused;
  const bool on = paused || recorder.state == RecorderView::State::recording;
  if (!on) {
    if (text_button({"settings.measure.record", "Record",
                     fmt::format("Writes what is measured to a session folder while it goes on "
                                 "({}).",
                                 shortcut_text(Action::record))})) {
      context.commands.push_back(StartRecording{});
    }
  } else {
    if (text_button({"settings.measure.pause", paused ? "Go on" : "Pause",
                     "A pause leaves a gap in the session."})) {
      context.commands.push_back(PauseRecording{!paused});
    }
    if (text_button_beside({"settings.measure.stop", "End recording",
                            "Closes the session; it can be opened and compared."})) {
      context.commands.push_back(StopRecording{});
    }
  }
  if (text_button_beside({"settings.measure.sessions", "Sessions…",
                          "The session that is open, and what it is compared with."})) {
    context.state.sessions_open = true;
  }
  if (on) {
    figure_row({"settings.measure.recorded", paused ? "Paused" : "Recorded",
                fmt::format("Into {}.", recorder.folder)},
               fmt::format("{}, {}", duration_text(std::floor(recorder.seconds)),
                           bytes_text(recorder.bytes)));
  }
  problem_line(recorder.problem);
}

std::string source_text(const EnergySettings& energy) {
  switch (energy.from) {
    case EnergySettings::From::automatic:
      return "automatic";
    case EnergySettings::From::chosen:
      return energy.source.empty() ? "chosen" : energy.source;
    case EnergySettings::From::model:
      return fmt::format("{:.4g} W idle, {:.4g} W busy", energy.idle_watts, energy.busy_watts);
  }
  return {};
}

}  // namespace

void draw_measure_section(const ColumnContext& context) {
  if (!section("settings.measure", "Measuring",
               "Figures with their uncertainty, one pane at a time.")) {
    return;
  }
  MeasureSettings& measure = context.state.settings.measure;
  draw_mode(context);
  draw_slots(measure);
  draw_rules(context.view, measure);
  draw_recording(context);
}

void draw_energy_section(const ColumnContext& context) {
  if (!section("settings.energy", "Energy source", "Where watts and joules come from.")) return;
  UiState& state = context.state;
  EnergySettings& energy = state.settings.energy;
  badge(context.view.power);
  note_widget("settings.energy.badge", energy::to_string(context.view.power.origin));
  figure_row({"settings.energy.source", "Source",
              "automatic: the best sensor of this machine; a sensor by its name; or two numbers "
              "from a meter, by which joules are computed from times."},
             context.view.power_opening ? "opening …" : source_text(energy));
  problem_line(context.view.power_problem);
  const bool nothing = context.view.power.origin == energy::Origin::unavailable;
  if (nothing && context.view.power_problem.empty()) hint_line(context.view.power.detail);
  if (text_button({"settings.energy.watts", "Enter idle and busy watts…",
                   "Chooses a sensor, or computes joules from two numbers, marked as modelled."})) {
    state.dialog = Dialog::energy;
  }
  if (text_button({"settings.energy.doctor", "Sensor doctor",
                   "Lists the sensors of this machine, what is in the way of each, and the way "
                   "out."})) {
    state.doctor_open = true;
  }
  if (energy.from != EnergySettings::From::automatic &&
      text_button_beside({"settings.energy.automatic", "Automatic",
                          "Goes back to the best sensor that this machine has."})) {
    energy.from = EnergySettings::From::automatic;
    context.commands.push_back(ApplyEnergy{});
  }
}

}  // namespace encore::ui
