#include "app/window/scene_loader.h"

#include "app/window/steady_time.h"
#include "app/window/thread_priority.h"
#include "scene/left_out.h"
#include "scene/scene_file.h"
#include "scene/triangles.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace encore::app {

SceneLoader::~SceneLoader() {
  cancel();
}

void SceneLoader::Job::run(const std::vector<std::string>& search_path,
                           const std::function<void()>& wake) {
  yield_to_window();
  Loaded outcome;
  outcome.name = name;
  try {
    const std::vector<std::filesystem::path> path(search_path.begin(), search_path.end());
    const scene::LoadScope scope(&watch);
    outcome.scene = std::make_shared<const scene::Scene>(scene::load_scene(name, path));
  } catch (const scene::LoadCancelled&) {
    outcome.problem.clear();
  } catch (const std::bad_alloc&) {
    outcome.problem = name + ": there is not enough memory for this scene";
  } catch (const std::exception& error) {
    outcome.problem = error.what();
  }
  const std::shared_ptr<const scene::Scene> scene = outcome.scene;
  {
    const std::lock_guard lock(mutex);
    result = std::move(outcome);
  }
  loaded = true;
  wake();
  if (scene && !cancel) {
    try {
      scene::TriangleList triangles;
      scene::update_triangles(*scene, 0.0, triangles);
      Described found{std::make_shared<const scene::SceneInfo>(scene::describe(*scene, triangles)),
                      scene::needs_of(*scene, triangles, scene::every_ray())};
      const std::lock_guard lock(mutex);
      described = std::move(found);
    } catch (const std::exception&) {
      // A scene that cannot be described is shown without figures.
    }
    wake();
  }
  done = true;
}

void SceneLoader::start(const std::string& name_or_path, std::vector<std::string> search_path,
                        std::function<void()> wake) {
  cancel();
  auto job = std::make_shared<Job>();
  job->name = name_or_path;
  job->since_s = steady_now();
  job->watch.cancel = &job->cancel;
  job_ = job;
  threads_.emplace_back(
      [job, path = std::move(search_path), wake = std::move(wake)] { job->run(path, wake); });
  // Those before were told to end; waiting for them here would hold up the window.
  constexpr std::size_t kMostThreads = 4;
  if (threads_.size() > kMostThreads) threads_.erase(threads_.begin());
}

void SceneLoader::cancel() {
  if (job_) job_->cancel = true;
}

std::optional<SceneLoader::Loaded> SceneLoader::take_scene() {
  if (!job_ || !job_->loaded) return std::nullopt;
  const std::lock_guard lock(job_->mutex);
  return std::exchange(job_->result, std::nullopt);
}

std::optional<SceneLoader::Described> SceneLoader::take_info() {
  if (!job_) return std::nullopt;
  const std::lock_guard lock(job_->mutex);
  return std::exchange(job_->described, std::nullopt);
}

std::string SceneLoader::doing() const {
  if (!loading()) return {};
  const std::string part = job_->watch.doing();
  return part.empty() ? "loading " + job_->name : "loading " + part;
}

double SceneLoader::progress() const {
  return job_ ? double(job_->watch.progress.load(std::memory_order_relaxed)) : 0.0;
}

double SceneLoader::elapsed_s() const {
  return job_ ? steady_now() - job_->since_s : 0.0;
}

}  // namespace encore::app
