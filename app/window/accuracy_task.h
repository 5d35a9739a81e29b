#pragma once

#include "app/accuracy/accuracy_rows.h"
#include "app/accuracy/configuration_tracers.h"
#include "app/accuracy/reference.h"
#include "app/window/background_task.h"
#include "energy/sources/model.h"
#include "ui/view.h"

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What the window wants to have compared.
struct AccuracyRequest {
  AccuracyReference::Plan plan;
  std::vector<WorkloadSpec> specs;  ///< every configuration; of the plan's scene and size
  /// Watts that joules are computed from; nothing: `no_joules` says why.
  std::optional<energy::PowerModel> model;
  std::string no_joules;
  std::string of;  ///< in words, for the panel
  int rounds = 5;  ///< of timing
};

/// Holds configurations to a reference and times them, on a thread of its own. Asked by the
/// window's thread, which never waits for it.
class AccuracyTask {
 public:
  struct Setup {
    /// Makes the tools, on the task's thread, which alone uses them.
    std::function<WorkloadTools()> tools;
    /// Brings everything else to rest (true) and returns once it is, or once `stop` is set; or lets
    /// it go on (false). Called on the task's thread, in pairs.
    std::function<void(bool held, const std::atomic<bool>& stop)> hold;
    std::function<void()> wake;  ///< there is news; any thread
  };
  explicit AccuracyTask(Setup setup);

  /// Begins anew, in the place of what was found. Nothing where one is still under way.
  void start(AccuracyRequest request);
  void cancel() { task_.cancel(); }
  [[nodiscard]] bool running() const { return task_.running(); }
  /// Blocks until it has ended; for tests.
  void wait() { take(task_.wait()); }
  /// Takes over how it ended, if it has.
  void poll();

  /// Whether anything has been found since the last start.
  [[nodiscard]] bool any() const;
  /// Where it stands; all but what OpenGL can do here.
  [[nodiscard]] ui::AccuracyView view() const;
  /// Writes accuracy.csv and the scatter as SVG to a new folder. Throws scene::InputError or
  /// energy::SessionError with one line.
  void save(const std::filesystem::path& folder) const;

 private:
  struct Found {
    std::vector<AccuracyRow> rows;
    std::string csv;  ///< of the rows
    std::optional<double> own_error;
    std::string doing;
    int rounds = 0;
  };
  bool run(const AccuracyRequest& request, TaskControl& control);
  bool compare(const AccuracyRequest& request, const AccuracyReference& reference,
               ConfigurationTracers& tracers, TaskControl& control);
  bool time_all(const AccuracyRequest& request, const AccuracyReference& reference,
                ConfigurationTracers& tracers, TaskControl& control);
  void finish_round(const AccuracyRequest& request,
                    const std::vector<std::vector<double>>& seconds);
  void say(std::string doing, TaskControl& control, double progress);
  void take(TaskResult<bool> result);

  Setup setup_;
  mutable std::mutex mutex_;
  Found found_;
  AccuracyRequest request_;  ///< the window's thread's
  std::string problem_;
  double began_s_ = 0.0;
  BackgroundTask<bool> task_;  ///< last: it ends before what it uses goes
};

}  // namespace encore::app
