#include "app/profile_run.h"

#include "app/experiment.h"
#include "app/number_text.h"
#include "app/profile_folder.h"
#include "app/profile_report.h"
#include "app/transfer_derivation.h"
#include "energy/machine.h"
#include "renderer/gl/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

namespace encore::app {

namespace {

using energy::SessionState;

/// A run that takes minutes is told of beforehand.
void tell_duration(const energy::Plan& plan, std::size_t configurations, Terminal& terminal) {
  constexpr double kWorthTelling = 60.0;
  const double all = energy::least_duration(plan).value * static_cast<double>(configurations);
  if (all < kWorthTelling) return;
  terminal.info(fmt::format(
      "plan {}: {} configuration{}, {} in all at least{}", plan.name, configurations,
      configurations == 1 ? "" : "s", duration_text(all),
      plan.name == "quick" ? "" : "; --plan quick takes seconds, --seconds sets the time"));
}

/// What holds for every configuration and so is not a column.
std::vector<energy::KeyValue> common_settings(const ProfileOptions& options,
                                              const std::vector<WorkloadSpec>& specs,
                                              const std::optional<GpuInfo>& gpu) {
  std::vector<energy::KeyValue> settings{{"memory", options.memory}};
  if (std::string threads = rendering_threads(specs); !threads.empty()) {
    settings.push_back({"threads", std::move(threads)});
  }
  for (energy::KeyValue& setting : gpu_settings(gpu)) settings.push_back(std::move(setting));
  if (options.build_on != "auto") settings.push_back({"build_on", options.build_on});
  if (!options.update_case.empty()) settings.push_back({"update_case", options.update_case});
  for (const std::string& setting : options.settings) settings.push_back({"set", setting});
  return settings;
}

energy::SessionInfo session_info(const ProfileOptions& options,
                                 const std::vector<WorkloadSpec>& specs,
                                 const std::optional<GpuInfo>& gpu) {
  energy::SessionInfo info;
  info.program = "encore " ENCORE_VERSION;
  info.command_line = energy::read_command_line();
  info.started_utc = utc_now();
  info.machine = energy::read_machine();
  info.scenes = scene_names(specs);
  info.settings = common_settings(options, specs, gpu);
  return info;
}

/// How a run ended.
struct Ending {
  SessionState state = SessionState::complete;
  ExitCode code = ExitCode::ok;
};
constexpr Ending kInterrupted{SessionState::interrupted, ExitCode::interrupted};

/// Measures all of `specs` into `report`, in the plan's order; how it ended.
Ending measure_all(const std::vector<WorkloadSpec>& specs, Experiment& experiment,
                   const std::atomic<bool>& stop, Terminal& terminal, ProfileReport& report) {
  Ending ending;
  const std::vector<std::size_t> order = energy::measuring_order(experiment.plan(), specs.size());
  std::vector<std::uint32_t> done(specs.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (stop) return kInterrupted;
    WorkloadSpec spec = specs[order[i]];
    spec.repeat = ++done[order[i]];
    const auto progress = [&](double share, std::string_view doing) {
      terminal.progress(
          fmt::format("{}/{} {}: {}", i + 1, order.size(), workload_name(spec), doing),
          (static_cast<double>(i) + share) / static_cast<double>(order.size()));
    };
    try {
      if (auto result = experiment.measure(spec, progress)) {
        report.rows.push_back(std::move(result->summary));
        report.phases.insert(report.phases.end(), result->phases.begin(), result->phases.end());
        report.notes.push_back({workload_name(spec), std::move(result->notes)});
      }
    } catch (const MismatchError& error) {
      terminal.progress_done();
      fmt::print(stderr, "encore: {}\n", error.what());
      return {SessionState::failed, ExitCode::mismatch};
    } catch (const renderer::gl::GlError& error) {
      terminal.progress_done();
      fmt::print(stderr, "encore: {} was not measured: {}\n", workload_name(spec), error.what());
      ending = {SessionState::failed, ExitCode::failure};
    }
  }
  return stop ? kInterrupted : ending;
}

}  // namespace

std::vector<std::string> scene_names(const std::vector<WorkloadSpec>& specs) {
  std::vector<std::string> names;
  for (const WorkloadSpec& spec : specs) {
    if (std::find(names.begin(), names.end(), spec.scene->name) == names.end()) {
      names.push_back(spec.scene->name);
    }
  }
  return names;
}

std::optional<GpuInfo> open_gpu_for(const std::vector<WorkloadSpec>& specs,
                                    const WorkloadTools& tools, Terminal& terminal) {
  const auto needs_it = [](const WorkloadSpec& spec) { return uses_opengl(spec.device); };
  if (std::none_of(specs.begin(), specs.end(), needs_it)) return std::nullopt;
  GpuInfo gpu = tools.open_gpu();
  terminal.info("GPU: " + gpu.name);
  return gpu;
}

std::string rendering_threads(const std::vector<WorkloadSpec>& specs) {
  std::vector<std::pair<std::string, unsigned>> of_scene;
  for (const WorkloadSpec& spec : specs) {
    if (spec.device != Device::cpu) continue;
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

ProfileOutcome measure_profile(const ProfileOptions& options,
                               const std::vector<WorkloadSpec>& specs, const WorkloadTools& tools,
                               const std::atomic<bool>& stop, Terminal& terminal) {
  const std::optional<GpuInfo> gpu = open_gpu_for(specs, tools, terminal);
  const energy::SessionInfo info = session_info(options, specs, gpu);
  std::string name = info.scenes.front();
  if (info.scenes.size() > 1) name += fmt::format("-and-{}-more", info.scenes.size() - 1);

  Experiment experiment({info, options.measuring, tools}, stop, terminal);
  ProfileOutcome outcome;
  ProfileReport& report = outcome.report;
  report.folder = make_session_folder(options.out, info.started_utc, name);
  report.sensor = experiment.info().sensor;
  report.gpu = gpu;
  experiment.open(report.folder);
  tell_duration(experiment.plan(), specs.size(), terminal);
  Ending ending;
  report.state = experiment.run([&] {
    ending = measure_all(specs, experiment, stop, terminal, report);
    return ending.state;
  });
  report.transfers = write_transfers(report.folder, report.rows, report.phases);
  report.sampling = experiment.sampling_cost();
  outcome.code = ending.code;
  return outcome;
}

ProfileResult run_profile(const ProfileOptions& options, const WorkloadTools& tools,
                          const std::atomic<bool>& stop, Terminal& terminal) {
  const std::vector<WorkloadSpec> specs = list_workloads(options, tools, terminal);
  ProfileOutcome outcome = measure_profile(options, specs, tools, stop, terminal);
  // After everything else, so that it disturbs nothing that is measured.
  if (outcome.code == ExitCode::ok) outcome.report.left_out = scenes_left_out(specs, stop);
  return {outcome.code, options.json ? report_json(outcome.report) : report_text(outcome.report)};
}

}  // namespace encore::app
