#include "app/study_run.h"

#include "app/experiment.h"
#include "app/json_text.h"
#include "app/number_text.h"
#include "app/profile_folder.h"
#include "app/profile_report.h"
#include "app/profile_run.h"
#include "app/profile_table.h"
#include "app/study_matrix.h"
#include "app/study_progress.h"
#include "app/transfer_derivation.h"
#include "energy/machine.h"
#include "energy/session_csv.h"
#include "renderer/gl/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <optional>
#include <utility>

namespace encore::app {

namespace {

using energy::SessionState;

/// What the command line says goes before the file.
void merge(MeasuringOptions& into, const MeasuringOptions& from) {
  const MeasuringOptions none;
  if (!from.plan.empty()) into.plan = from.plan;
  if (from.seconds) into.seconds = from.seconds;
  if (from.idle) into.idle = from.idle;
  if (from.warm_up) into.warm_up = from.warm_up;
  if (from.mix) into.mix = from.mix;
  if (from.cool_down) into.cool_down = from.cool_down;
  if (from.poll) into.poll = from.poll;
  if (!from.cut.empty()) into.cut = from.cut;
  if (!from.until.empty()) into.until = from.until;
  if (from.until_limit) into.until_limit = from.until_limit;
  if (from.repeats) into.repeats = from.repeats;
  if (!from.order.empty()) into.order = from.order;
  if (from.seed) into.seed = from.seed;
  if (!from.sources.empty()) into.sources = from.sources;
  if (!from.model.empty()) into.model = from.model;
  if (from.sensor_root != none.sensor_root) into.sensor_root = from.sensor_root;
}

/// All tests in the order of the plan, repeats told apart.
std::vector<WorkloadSpec> in_order(const StudyMatrix& matrix, const energy::Plan& plan) {
  std::vector<WorkloadSpec> tests;
  std::vector<std::uint32_t> repeats(matrix.tests.size(), 0);
  for (const std::size_t i : energy::measuring_order(plan, matrix.tests.size())) {
    tests.push_back(matrix.tests[i]);
    tests.back().repeat = ++repeats[i];
  }
  return tests;
}

std::string plan_text(const StudyMatrix& matrix, const energy::Plan& plan,
                      const energy::Provenance& sensor, std::size_t left) {
  TextTable table;
  table.add_column("group", TextTable::Align::left);
  for (const char* title : {"tests", "left out"}) table.add_column(title);
  table.add_column("why", TextTable::Align::left);
  std::map<std::string, std::size_t> counts;
  std::vector<std::string> names;
  const auto note = [&](const std::string& group) {
    if (counts.emplace(group, 0).second) names.push_back(group);
  };
  for (const WorkloadSpec& spec : matrix.tests) {
    note(spec.group);
    ++counts[spec.group];
  }
  for (const LeftOut& out : matrix.left_out) note(out.group);
  for (const std::string& name : names) {
    std::size_t out_count = 0;
    std::string why;
    for (const LeftOut& out : matrix.left_out) {
      if (out.group != name) continue;
      out_count += out.tests;
      if (why.find(out.reason) == std::string::npos) why += (why.empty() ? "" : "; ") + out.reason;
    }
    table.add_row({name, std::to_string(counts[name]),
                   out_count > 0 ? std::to_string(out_count) : std::string(), why});
  }
  const double each = energy::least_duration(plan).value / plan.repeats;
  return table.text() +
         fmt::format(
             "\n{} tests described, {} measured, each {}; plan {}: {} a test.\n"
             "{} runs are left: at least {}, and what building and checking takes.\nEnergy: {} "
             "({})\n",
             matrix.described(), matrix.tests.size(),
             plan.repeats == 1 ? std::string("once") : fmt::format("{} times", plan.repeats),
             plan.name, duration_text(each), left, duration_text(each * static_cast<double>(left)),
             energy::to_string(sensor.origin), sensor.detail);
}

std::string plan_json(const StudyMatrix& matrix, const energy::Plan& plan,
                      const energy::Provenance& sensor, const std::vector<WorkloadSpec>& left) {
  std::string json = fmt::format(
      "{{\n  \"described\": {},\n  \"measured\": {},\n  \"repeats\": {},\n  \"plan\": {},\n"
      "  \"runs_left\": {},\n  \"least_s\": {},\n  \"energy\": {{\"provenance\": {}, \"detail\": "
      "{}}},\n  \"runs\": [",
      matrix.described(), matrix.tests.size(), plan.repeats, json_text(plan.name), left.size(),
      energy::csv_number(energy::least_duration(plan).value / plan.repeats *
                         static_cast<double>(left.size())),
      json_text(energy::to_string(sensor.origin)), json_text(sensor.detail));
  const char* separator = "\n    ";
  for (const WorkloadSpec& spec : left) {
    json += separator + json_text(spec.group + ": " + workload_name(spec));
    separator = ",\n    ";
  }
  return json + (left.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

energy::SessionInfo session_info(const Study& study, const StudyMatrix& matrix) {
  energy::SessionInfo info;
  info.program = "encore " ENCORE_VERSION;
  info.command_line = energy::read_command_line();
  info.started_utc = utc_now();
  info.machine = energy::read_machine();
  info.scenes = scene_names(matrix.tests);
  if (std::string threads = rendering_threads(matrix.tests); !threads.empty()) {
    info.settings.push_back({"threads", std::move(threads)});
  }
  for (energy::KeyValue& setting : gpu_settings(matrix.gpu)) {
    info.settings.push_back(std::move(setting));
  }
  info.settings.insert(
      info.settings.end(),
      {{"study", study.name}, {"study_file", study.file}, {"study_digest", study.digest}});
  return info;
}

/// Measures what is left, test by test.
class StudyRun {
 public:
  StudyRun(Experiment& experiment, const std::atomic<bool>& stop, const PausePoint& pause,
           Terminal& terminal, std::size_t before)
      : experiment_(experiment), stop_(stop), pause_(pause), terminal_(terminal), before_(before) {}

  SessionState run(const std::vector<WorkloadSpec>& tests, ProfileReport& report) {
    const std::size_t all = before_ + tests.size();
    for (std::size_t i = 0; i < tests.size(); ++i) {
      if (stop_ || !pause_()) return SessionState::interrupted;
      const std::string name = tests[i].group + ": " + workload_name(tests[i]);
      const auto progress = [&](double share, std::string_view doing) {
        terminal_.progress(fmt::format("{}/{} {}: {}", before_ + i + 1, all, name, doing),
                           (static_cast<double>(i) + share) / static_cast<double>(tests.size()));
      };
      try {
        if (auto result = experiment_.measure(tests[i], progress)) {
          report.rows.push_back(std::move(result->summary));
          report.phases.insert(report.phases.end(), result->phases.begin(), result->phases.end());
          report.notes.push_back({name, std::move(result->notes)});
        }
      } catch (const MismatchError& error) {
        // A wrong structure spoils its own test, not the nights of the others.
        terminal_.progress_done();
        fmt::print(stderr, "encore: {}\n", error.what());
        failed_ = ExitCode::mismatch;
      } catch (const renderer::gl::GlError& error) {
        terminal_.progress_done();
        fmt::print(stderr, "encore: {} was not measured: {}\n", name, error.what());
        if (failed_ == ExitCode::ok) failed_ = ExitCode::failure;
      }
    }
    if (stop_) return SessionState::interrupted;
    return failed_ == ExitCode::ok ? SessionState::complete : SessionState::failed;
  }
  /// What went wrong, the worst of it.
  [[nodiscard]] ExitCode failed() const { return failed_; }

 private:
  Experiment& experiment_;
  const std::atomic<bool>& stop_;
  const PausePoint& pause_;
  Terminal& terminal_;
  std::size_t before_;
  ExitCode failed_ = ExitCode::ok;
};

/// Derives the transfers of the whole session, of which `report` has what was measured now.
std::vector<TransferFigures> write_all_transfers(const ProfileReport& report, bool resumed) {
  if (!resumed) return write_transfers(report.folder, report.rows, report.phases);
  const energy::Session session = energy::read_session(report.folder);
  return write_transfers(report.folder, session.summaries, session.phases);
}

}  // namespace

StudyResult run_study(const StudyOptions& options, const WorkloadTools& tools,
                      const std::atomic<bool>& stop, const PausePoint& pause, Terminal& terminal) {
  Study study = read_study(find_study(options.file));
  merge(study.measuring, options.measuring);
  std::optional<StudyProgress> progress;
  if (!options.resume.empty()) progress = read_progress(options.resume, study.digest);

  const StudyMatrix matrix = spell_out(study, tools, terminal);
  if (matrix.tests.empty()) throw UsageError("the study leaves nothing to measure");
  Experiment experiment({session_info(study, matrix), study.measuring, tools}, stop, terminal);
  std::vector<WorkloadSpec> left;
  for (WorkloadSpec& spec : in_order(matrix, experiment.plan())) {
    if (progress && progress->done.contains(study_key(configuration_of(spec, 0)))) continue;
    left.push_back(std::move(spec));
  }
  const std::size_t done = matrix.tests.size() * experiment.plan().repeats - left.size();
  const energy::Provenance& sensor = experiment.info().sensor;
  if (options.dry_run) {
    return {ExitCode::ok, options.json ? plan_json(matrix, experiment.plan(), sensor, left)
                                       : plan_text(matrix, experiment.plan(), sensor, left.size())};
  }
  for (const LeftOut& out : matrix.left_out) {
    terminal.warning(fmt::format("group {}: {}{}", out.group,
                                 out.tests > 0 ? fmt::format("{} tests left out: ", out.tests) : "",
                                 out.reason));
  }

  ProfileReport report;
  report.sensor = sensor;
  report.gpu = matrix.gpu;
  if (progress) {
    report.folder = options.resume;
    experiment.resume(report.folder, progress->info, progress->reached);
    terminal.info(fmt::format("{} of {} runs are done already", done, done + left.size()));
  } else {
    report.folder = make_session_folder(options.out, experiment.info().started_utc, study.name);
    experiment.open(report.folder);
  }
  terminal.info("session: " + report.folder.string());
  if (matrix.gpu) terminal.info("GPU: " + matrix.gpu->name);
  StudyRun run(experiment, stop, pause, terminal, done);
  report.state = experiment.run([&] { return run.run(left, report); });
  report.transfers = write_all_transfers(report, progress.has_value());
  report.sampling = experiment.sampling_cost();
  const ExitCode code =
      report.state == SessionState::interrupted ? ExitCode::interrupted : run.failed();
  return {code, options.json ? report_json(report) : report_text(report)};
}

}  // namespace encore::app
