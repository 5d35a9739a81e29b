#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace encore::app {

/// What work in the background is told and tells.
struct TaskControl {
  std::atomic<bool> stop{false};      ///< set: end soon
  std::atomic<double> progress{0.0};  ///< in [0, 1]
};

/// How a task ended.
template <class Result>
struct TaskResult {
  std::optional<Result> value;
  std::string error;  ///< one line; empty if it worked or was cancelled
  bool cancelled = false;
};

/// One piece of work at a time on a thread of its own. Asked by one thread, which never waits but
/// in start() of a new task while a cancelled one still ends, and in the destructor.
template <class Result>
class BackgroundTask {
 public:
  BackgroundTask() = default;
  ~BackgroundTask() { cancel(); }  // the threads join
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Runs `work`; a task under way is cancelled first.
  void start(std::function<Result(TaskControl&)> work) {
    cancel();
    // One that was cancelled may take a while to end: nobody waits for it here.
    std::erase_if(ending_, [](const Ending& ending) { return ending.job->done.load(); });
    if (job_) ending_.push_back({job_, std::move(thread_)});
    job_ = std::make_shared<Job>();
    thread_ = std::jthread([job = job_, work = std::move(work)] { job->run(work); });
  }
  void cancel() {
    if (job_) job_->control.stop = true;
  }
  [[nodiscard]] bool running() const { return job_ && !job_->done; }
  [[nodiscard]] double progress() const { return job_ ? job_->control.progress.load() : 0.0; }
  /// How it ended, once; nothing while it runs.
  std::optional<TaskResult<Result>> take() {
    if (!job_ || !job_->done) return std::nullopt;
    thread_ = {};
    TaskResult<Result> result = std::move(job_->result);
    job_.reset();
    return result;
  }
  /// Blocks until it has ended; for tests.
  TaskResult<Result> wait() {
    if (thread_.joinable()) thread_.join();
    return take().value_or(TaskResult<Result>{});
  }

 private:
  struct Job {
    TaskControl control;
    std::atomic<bool> done{false};
    TaskResult<Result> result;

    void run(const std::function<Result(TaskControl&)>& work) {
      try {
        result.value = work(control);
      } catch (const std::exception& error) {
        if (!control.stop) result.error = error.what();
      }
      result.cancelled = control.stop;
      if (result.cancelled) result.value.reset();
      done = true;
    }
  };
  struct Ending {
    std::shared_ptr<Job> job;
    std::jthread thread;
  };
  std::vector<Ending> ending_;
  std::shared_ptr<Job> job_;
  std::jthread thread_;
};

}  // namespace encore::app
