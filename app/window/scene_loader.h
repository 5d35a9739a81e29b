#pragma once

#include "scene/load_watch.h"
#include "scene/needs.h"
#include "scene/scene.h"
#include "scene/scene_info.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace encore::app {

/// Loads scenes and describes them, on a thread of its own. Asked by one thread, which never waits
/// but while a load that was cancelled ends.
class SceneLoader {
 public:
  SceneLoader() = default;
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  /// Begins to load; a load under way is cancelled. `wake` is called when there is news.
  void start(const std::string& name_or_path, std::vector<std::string> search_path,
             std::function<void()> wake);
  void cancel();

  /// A scene that was loaded, or why it was not; each once.
  struct Loaded {
    std::string name;                           ///< as it was asked for
    std::shared_ptr<const scene::Scene> scene;  ///< null if it failed
    std::string problem;                        ///< one line; empty if it was cancelled
  };
  std::optional<Loaded> take_scene();
  /// What is known of the last scene, once it is there.
  struct Described {
    std::shared_ptr<const scene::SceneInfo> info;
    scene::Needs could_use;  ///< with every kind of ray
  };
  std::optional<Described> take_info();

  [[nodiscard]] bool loading() const { return job_ && !job_->loaded.load(); }
  [[nodiscard]] std::string doing() const;
  [[nodiscard]] double progress() const;
  [[nodiscard]] double elapsed_s() const;

 private:
  struct Job {
    std::string name;
    std::atomic<bool> cancel{false};
    std::atomic<bool> loaded{false};
    std::atomic<bool> done{false};
    scene::LoadWatch watch;
    double since_s = 0.0;
    std::mutex mutex;
    std::optional<Loaded> result;
    std::optional<Described> described;

    void run(const std::vector<std::string>& search_path, const std::function<void()>& wake);
  };
  std::shared_ptr<Job> job_;
  std::vector<std::jthread> threads_;  ///< cancelled ones may still be ending
};

}  // namespace encore::app
