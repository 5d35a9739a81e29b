#include "app/accuracy/accuracy_rows.h"
#include "app/accuracy/accuracy_scatter.h"
#include "app/accuracy/configuration_tracers.h"
#include "app/accuracy/reference.h"
#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "app/profile_run.h"
#include "app/ray_options.h"
#include "app/session_input.h"
#include "scene/sample_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace encore::app {

namespace {

struct AccuracyOptions : ProfileOptions {
  std::vector<std::string> sample_counts;
  int reference_samples = 256;
};

/// Every combination to be looked at: static frames of each device, structure, mode and number of
/// samples.
std::vector<WorkloadSpec> list_configurations(AccuracyOptions options, const WorkloadTools& tools,
                                              Terminal& terminal) {
  options.tests = {std::string(to_string(TestKind::fixed))};
  if (options.intersections.empty()) {
    for (const auto mode : accel::all_intersection_modes()) {
      options.intersections.emplace_back(accel::to_string(mode));
    }
  }
  for (const std::string& name : options.devices) {
    if (const auto device = parse_device(name); device && !traces_rays(*device)) {
      throw UsageError(fmt::format(
          "--device {} traces no rays, so there are no hits to be right or wrong; use cpu or gpu",
          name));
    }
  }
  std::shared_ptr<const scene::Scene> scene;
  const SceneOpener open = [&](const std::string& name) {
    if (!scene) scene = std::make_shared<const scene::Scene>(open_scene(name, options, terminal));
    return scene;
  };
  std::vector<WorkloadSpec> all;
  for (const std::string& count : options.sample_counts) {
    options.samples = count;
    for (WorkloadSpec& spec : list_workloads(options, tools, terminal, open)) {
      spec.rays = useful_rays(*scene, spec.rays);
      all.push_back(std::move(spec));
    }
  }
  return all;
}

/// What measuring gave for a configuration: the median over its repeats, if it was reached.
void add_cost(const std::vector<energy::SummaryRow>& measured, AccuracyRow& row) {
  const auto wanted = configuration_identity(configuration_of(row.spec, 0));
  std::vector<const energy::SummaryRow*> repeats;
  for (const energy::SummaryRow& summary : measured) {
    if (configuration_identity(summary.configuration) == wanted) repeats.push_back(&summary);
  }
  if (repeats.empty()) return;
  const auto ms = [](const energy::SummaryRow* one) {
    return energy::milliseconds(one->median.value_or(one->mean));
  };
  const auto middle = repeats.begin() + static_cast<std::ptrdiff_t>(repeats.size() / 2);
  std::nth_element(repeats.begin(), middle, repeats.end(),
                   [&](const auto* a, const auto* b) { return ms(a) < ms(b); });
  const energy::SummaryRow& typical = **middle;
  row.ms = ms(&typical);
  if (typical.ci95) row.ms_ci95 = energy::milliseconds(*typical.ci95);
  if (typical.joules) row.joules = typical.joules->value;
  if (typical.joules_ci95) row.joules_ci95 = typical.joules_ci95->value;
  row.origin = typical.origin;
}

/// The errors of every configuration; false if it was interrupted.
bool compare_all(const std::vector<WorkloadSpec>& specs, const AccuracyReference& reference,
                 const WorkloadTools& tools, Terminal& terminal, std::vector<AccuracyRow>& rows) {
  ConfigurationTracers tracers(*specs.front().scene, reference.triangles(), tools, interrupted);
  for (const WorkloadSpec& spec : specs) {
    terminal.progress("comparing " + workload_name(spec),
                      static_cast<double>(rows.size()) / static_cast<double>(specs.size()));
    const auto errors = reference.errors_of(tracers.ready(spec));
    if (!errors) return false;
    AccuracyRow row;
    row.spec = spec;
    row.errors = *errors;
    rows.push_back(std::move(row));
  }
  return true;
}

ExitCode accuracy(AccuracyOptions options, const WorkloadTools& tools) {
  // Repeats in a shuffled order, so that a machine that drifts does not pass for a difference.
  if (!options.measuring.repeats) options.measuring.repeats = 2;
  if (options.measuring.order.empty()) options.measuring.order = "shuffled";
  Terminal terminal(options.quiet);
  const std::vector<WorkloadSpec> specs = list_configurations(options, tools, terminal);
  open_gpu_for(specs, tools, terminal);
  const WorkloadSpec& first = specs.front();
  AccuracyReference reference(
      {first.scene, first.rays, first.size, options.reference_samples, first.threads}, interrupted,
      [&](double share) { terminal.progress("drawing the reference", share); });
  if (!reference.complete()) return ExitCode::interrupted;

  std::vector<AccuracyRow> rows;
  if (!compare_all(specs, reference, tools, terminal, rows)) return ExitCode::interrupted;
  terminal.progress_done();
  const ProfileOutcome measured = measure_profile(options, specs, tools, interrupted, terminal);
  for (AccuracyRow& row : rows) add_cost(measured.report.rows, row);
  mark_pareto_fronts(rows);
  const std::filesystem::path& folder = measured.report.folder;
  write_accuracy_csv(folder, rows);
  write_accuracy_scatter(folder, rows, reference.own_error());

  if (options.json) {
    fmt::print("{}", accuracy_json(rows, reference.own_error()));
  } else {
    fmt::print("Energy: {} ({})\nSession: {} (with accuracy.csv and the scatter as SVG)\n",
               energy::to_string(measured.report.sensor.origin), measured.report.sensor.detail,
               folder.string());
    if (measured.report.gpu) fmt::print("GPU: {}\n", measured.report.gpu->name);
    fmt::print(
        "Reference: {} samples a pixel of other places, mode precise; its own RMSE is about "
        "{:.1e}, which errors below are not told apart from\n\n{}",
        options.reference_samples, reference.own_error().value_or(0.0), accuracy_table(rows));
  }
  std::fflush(stdout);
  return measured.code;
}

}  // namespace

void add_accuracy_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "accuracy", "Error of the pictures and hits against time and energy, for one scene");
  const auto options = std::make_shared<AccuracyOptions>();
  const auto gl_device = std::make_shared<std::optional<int>>();
  add_scene_options(*command, *options, false);
  add_structure_options(*command, *options, true);
  command
      ->add_option("--device", options->devices,
                   "cpu, gpu, or both separated by commas (default: the scene's own, else cpu)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--rays", options->rays,
                      "Rays beyond the first, as profile takes them (default: the scene's own)");
  options->sample_counts = {"1", "4", "16"};
  command
      ->add_option("--samples", options->sample_counts,
                   "Camera rays a pixel, several separated by commas (default 1,4,16)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--depth", options->depth,
                      "Reflections and refractions one after the other, 0 to 16");
  command
      ->add_option("--reference-samples", options->reference_samples,
                   "Camera rays a pixel of the reference picture (default 256)")
      ->check(CLI::Range(2, scene::kMostSamples));
  command->add_option("--size", options->size, "Picture: a side or WIDTHxHEIGHT (default 256)");
  add_plan_options(*command, options->measuring);
  add_source_options(*command, options->measuring);
  command->add_option("--out,-o", options->out,
                      "New or empty folder for the session; default: one in "
                      "$XDG_DATA_HOME/encore/sessions (~/.local/share)");
  add_gl_device_option(*command, *gl_device);
  add_thread_option(*command, *options);
  add_output_options(*command, *options);
  command->footer(
      "Without --structure, --intersection and --samples every structure but brute is looked at "
      "in\n"
      "every mode with 1, 4 and 16 samples. Errors: root mean square over the channels of the "
      "picture\n"
      "(linear RGB) against the reference, and hits of the rays through the pixels' centres "
      "against\n"
      "mode precise. Times and energies are measured as 'encore profile' does, into a session "
      "that\n"
      "also holds accuracy.csv and accuracy-time.svg (accuracy-energy.svg where joules are "
      "known):\n"
      "error against cost, with the configurations that nothing beats in both (Pareto front).");
  command->callback([options, gl_device, &result] {
    const WorkloadTools tools = standard_tools(std::make_shared<GpuContext>(*gl_device));
    result = accuracy(*options, tools);
  });
}

}  // namespace encore::app
