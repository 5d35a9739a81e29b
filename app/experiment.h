#pragma once

#include "app/machine_log.h"
#include "app/measuring_options.h"
#include "app/power_sources.h"
#include "app/terminal.h"
#include "app/workloads.h"
#include "energy/runner.h"
#include "energy/sampling/sampler.h"
#include "energy/session_csv.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// A session that is being measured: its power sources, their sampler, its folder. Configurations
/// are measured one after the other; everything is written as it is measured.
class Experiment {
 public:
  struct Setup {
    energy::SessionInfo info;  ///< all but plan, sensor and sources, which open() fills in
    MeasuringOptions measuring;
    WorkloadTools tools;
  };

  /// Opens the power sources; nothing is written yet. Throws as open_power_sources and make_plan.
  Experiment(Setup setup, const std::atomic<bool>& stop, Terminal& terminal);
  ~Experiment();

  [[nodiscard]] const energy::Plan& plan() const { return info_.plan; }
  [[nodiscard]] const energy::SessionInfo& info() const { return info_; }

  /// Begins the session in `folder`. Sampling starts. Throws energy::SessionError.
  void open(const std::filesystem::path& folder) { open(folder, energy::CsvWriter::Open::create); }

  /// Goes on with the session in `folder` that `before` tells of; its clock goes on after
  /// `reached`. Throws energy::SessionError.
  void resume(const std::filesystem::path& folder, const energy::SessionInfo& before,
              energy::Seconds reached);

  /// What one configuration gave.
  struct Result {
    energy::SummaryRow summary;
    std::vector<energy::PhaseRow> phases;  ///< of the total
    std::vector<std::string> notes;        ///< sentences about how far to trust it
  };
  /// Measures one configuration; nothing if it was stopped before its first operation. `progress`
  /// is told the share of it that is done and what is going on. Throws what the workload throws,
  /// energy::SessionError.
  std::optional<Result> measure(const WorkloadSpec& spec,
                                const std::function<void(double, std::string_view)>& progress);

  /// Runs `measure_all` (which calls measure()), then ends sampling and notes how the session
  /// ended, also if that throws: the exception passes on. Returns what it returned. Throws
  /// energy::SessionError.
  energy::SessionState run(const std::function<energy::SessionState()>& measure_all);
  /// What sampling cost; nothing if there was no source.
  [[nodiscard]] std::optional<energy::SamplerCost> sampling_cost() const;

 private:
  void finish(energy::SessionState state);
  void open(const std::filesystem::path& folder, energy::CsvWriter::Open how);
  energy::SamplerSink sink();
  /// Writes a sentence to events.csv.
  void note(const std::string& sentence);
  /// Throws what the sampler's thread could not: that a file takes no more.
  void check_writing();
  void write_windows(const energy::Measurement& measured,
                     const std::vector<energy::KeyValue>& configuration);
  void attribute_energy(const energy::Measurement& measured, Result& result);

  energy::SessionInfo info_;
  WorkloadTools tools_;
  const std::atomic<bool>& stop_;
  Terminal& terminal_;
  std::string sensor_root_;
  energy::SteadyClock clock_;
  energy::Seconds start_;
  energy::LiveBusyTime live_;
  PowerSources sources_;  ///< its sources belong to the sampler once that runs
  /// Policy::automatic weighs joules where these are known, else seconds.
  std::optional<energy::PerPhase<double>> phase_watts_;
  std::string source_name_;  ///< of the total
  std::mutex failure_mutex_;
  std::string failure_;            ///< of writing on the sampler's thread
  std::vector<std::string> news_;  ///< from the sampler's thread, not yet told
  std::unique_ptr<energy::SessionWriter> writer_;
  // The sampler's thread uses all of the above and these: they outlive it, however this ends.
  std::unique_ptr<energy::Sampler> sampler_;
  std::unique_ptr<MachineLog> machine_log_;
  std::unique_ptr<energy::SamplerThread> thread_;
};

}  // namespace encore::app
