#include "app/profile_run.h"

#include "app/profile_folder.h"
#include "app/profile_report.h"
#include "energy/machine.h"
#include "energy/runner.h"
#include "energy/session_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

namespace encore::app {

namespace {

using energy::SessionState;

energy::Provenance missing_sensor(const energy::Machine& machine) {
  std::string why = "this version has no power source";
  if (machine.virtual_machine.value_or(false)) {
    why += "; this is a virtual machine, where sensors are rarely passed through";
  }
  return {energy::Origin::unavailable, why};
}

/// The names of the scenes, each once, in order.
std::vector<std::string> scene_names(const std::vector<WorkloadSpec>& specs) {
  std::vector<std::string> names;
  for (const WorkloadSpec& spec : specs) {
    if (std::find(names.begin(), names.end(), spec.scene->name) == names.end()) {
      names.push_back(spec.scene->name);
    }
  }
  return names;
}

/// Threads that render: one number, or "2 (toys), 4 (bunny)" where scenes ask for different ones.
std::string rendering_threads(const std::vector<WorkloadSpec>& specs) {
  std::vector<std::pair<std::string, unsigned>> of_scene;
  for (const WorkloadSpec& spec : specs) {
    const unsigned threads = spec.threads > 0 ? static_cast<unsigned>(spec.threads)
                                              : std::max(1U, std::thread::hardware_concurrency());
    const std::pair<std::string, unsigned> entry{spec.scene->name, threads};
    if (std::find(of_scene.begin(), of_scene.end(), entry) == of_scene.end()) {
      of_scene.push_back(entry);
    }
  }
  const auto differs = [&](const auto& entry) { return entry.second != of_scene.front().second; };
  if (of_scene.empty() || std::none_of(of_scene.begin(), of_scene.end(), differs)) {
    return of_scene.empty() ? "" : std::to_string(of_scene.front().second);
  }
  std::string text;
  for (const auto& [scene, threads] : of_scene) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", threads, scene);
  }
  return text;
}

/// What holds for every configuration and so is not a column.
std::vector<energy::KeyValue> common_settings(const ProfileOptions& options,
                                              const std::vector<WorkloadSpec>& specs) {
  std::vector<energy::KeyValue> settings{{"memory", options.memory},
                                         {"threads", rendering_threads(specs)}};
  if (!options.update_case.empty()) settings.push_back({"update_case", options.update_case});
  for (const std::string& setting : options.settings) settings.push_back({"set", setting});
  return settings;
}

energy::SessionInfo session_info(const ProfileOptions& options,
                                 const std::vector<WorkloadSpec>& specs) {
  energy::SessionInfo info;
  info.program = "encore " ENCORE_VERSION;
  info.command_line = energy::read_command_line();
  info.started_utc = utc_now();
  info.machine = energy::read_machine();
  info.plan.run = energy::Seconds(options.seconds);
  info.plan.warm_up = std::min(info.plan.warm_up, info.plan.run);
  info.sensor = missing_sensor(info.machine);
  info.scenes = scene_names(specs);
  info.settings = common_settings(options, specs);
  return info;
}

/// Measures configurations into a session; knows how far the whole run is.
class Profiler {
 public:
  Profiler(const energy::SessionInfo& info, const WorkloadTools& tools,
           const std::atomic<bool>& stop, Terminal& terminal, energy::SessionWriter& writer)
      : plan_(info.plan), tools_(tools), stop_(stop), terminal_(terminal), writer_(writer) {}

  /// Measures one configuration, the `index`th of `count`; its summary, if anything was measured.
  std::optional<energy::SummaryRow> measure(const WorkloadSpec& spec, std::size_t index,
                                            std::size_t count) {
    const auto workload = make_workload(spec, tools_);
    const std::string label = fmt::format("{}/{} {}", index + 1, count, workload->name());
    energy::RunObserver observer;
    observer.on_row = [&](const energy::FrameRow& row) { writer_.add(row); };
    observer.on_progress = [&](double share) {
      terminal_.progress(label, (static_cast<double>(index) + share) / static_cast<double>(count));
    };
    observer.on_progress(0.0);
    const energy::Measurement measured =
        energy::run(*workload, plan_, clock_, start_, stop_, observer);
    if (measured.rows.empty()) return std::nullopt;

    energy::SummaryRow summary = energy::summarise(measured.rows, measured.phase_counts);
    energy::PerPhase<energy::Seconds> mean{};
    for (const energy::Phase phase : energy::kPhases) {
      mean[phase] = summary.mean * summary.shares[phase].value_or(0.0);
    }
    summary.counters = workload->counters(mean);
    writer_.add(summary);
    return summary;
  }

 private:
  const energy::Plan& plan_;
  const WorkloadTools& tools_;
  const std::atomic<bool>& stop_;
  Terminal& terminal_;
  energy::SessionWriter& writer_;
  energy::SteadyClock clock_;
  energy::Seconds start_ = clock_.now();
};

/// How a session ends, as the program's exit code.
ExitCode exit_code(SessionState state) {
  switch (state) {
    case SessionState::interrupted:
      return ExitCode::interrupted;
    case SessionState::failed:
      return ExitCode::mismatch;
    default:
      return ExitCode::ok;
  }
}

/// Measures all of `specs` into `report`; how it ended.
SessionState measure_all(const std::vector<WorkloadSpec>& specs, Profiler& profiler,
                         const std::atomic<bool>& stop, Terminal& terminal, ProfileReport& report) {
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (stop) return SessionState::interrupted;
    try {
      if (auto row = profiler.measure(specs[i], i, specs.size())) {
        report.rows.push_back(std::move(*row));
      }
    } catch (const MismatchError& error) {
      terminal.progress_done();
      fmt::print(stderr, "encore: {}\n", error.what());
      return SessionState::failed;
    }
  }
  return stop ? SessionState::interrupted : SessionState::complete;
}

}  // namespace

ProfileResult run_profile(const ProfileOptions& options, const WorkloadTools& tools,
                          const std::atomic<bool>& stop, Terminal& terminal) {
  const std::vector<WorkloadSpec> specs = list_workloads(options, tools, terminal);
  const energy::SessionInfo info = session_info(options, specs);
  std::string name = info.scenes.front();
  if (info.scenes.size() > 1) name += fmt::format("-and-{}-more", info.scenes.size() - 1);

  ProfileReport report;
  report.folder = make_session_folder(options.out, info.started_utc, name);
  report.sensor = info.sensor;
  energy::SessionWriter writer(report.folder, info, {configuration_columns(), counter_columns()});
  Profiler profiler(info, tools, stop, terminal, writer);
  try {
    report.state = measure_all(specs, profiler, stop, terminal, report);
  } catch (...) {
    // Say so in the session if that is still possible; what went wrong is told by the caller.
    terminal.progress_done();
    try {
      writer.finish(SessionState::failed);
    } catch (const energy::SessionError&) {
    }
    throw;
  }
  terminal.progress_done();
  writer.finish(report.state);
  return {exit_code(report.state), options.json ? report_json(report) : report_text(report)};
}

}  // namespace encore::app
