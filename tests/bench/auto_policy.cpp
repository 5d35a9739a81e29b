// encore_bench_auto: policy auto against every fixed rebuild period, on moving scenes.
//
//   encore_bench_auto [LOOPS [SIZE [SCENE...]]]
//
// All contestants play the same frames side by side, each with a hierarchy of its own and in an
// order that turns from frame to frame, on one thread; costs are processor time of the process. One
// line a scene and size: milliseconds a frame of always building, of always updating, of the best
// period in hindsight and of auto, medians over the loops, and auto's cost over the others'.
// "name!" flies apart: every part of scene `name` explodes and comes together again in 4 s.
#include "accel/auto_policy.h"

#include "accel/make_structure.h"
#include "accel/update_policy.h"
#include "renderer/cpu_tracer.h"
#include "scene/scene_file.h"
#include "scene/triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::bench {
namespace {

using accel::Policy;
using accel::UpdateAction;
using scene::TriangleChange;

constexpr double kFramesPerSecond = 30.0;
constexpr std::uint64_t kNever = ~std::uint64_t{0};

double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

scene::Scene load(const std::string& name) {
  if (!name.ends_with('!')) return scene::load_scene(name);
  scene::Scene scene = scene::load_scene(name.substr(0, name.size() - 1));
  scene::Deformer burst;
  burst.kind = scene::Deformer::Kind::explode;
  burst.amplitude = 8.0F;
  burst.frequency_hz = 0.25F;
  for (scene::Instance& instance : scene.instances) instance.motion = burst;
  scene.name = name;
  scene.mark_changed();
  return scene;
}

/// One way to follow the motion: rebuild every `period` frames, or by AutoPolicy.
class Contestant {
 public:
  Contestant(const scene::Scene& scene, const scene::TriangleList& list, int size,
             std::optional<std::uint64_t> period)
      : scene_(scene), list_(list), size_(size), period_(period) {
    structure_->build(list_.triangles);
    structure_->build(list_.triangles);  // the first one pays for fresh memory
    tracer_.init({&scene_, &list_, structure_.get()});
    tracer_.draw(scene_.camera, size_, size_);
    const double start = processor_s();
    accel::carry_out(UpdateAction::build, policy(), *structure_, list_.triangles);
    auto_.observe_build(processor_s() - start);
  }

  /// One frame; returns its cost without the animation.
  double frame(std::uint64_t number, TriangleChange change) {
    const double start = processor_s();
    const UpdateAction action = next(number, change);
    accel::carry_out(action, policy(), *structure_, list_.triangles);
    const double ready = processor_s();
    tracer_.refresh();
    tracer_.draw(scene_.camera, size_, size_);
    const double end = processor_s();
    if (action == UpdateAction::build) auto_.observe_build(ready - start);
    if (action == UpdateAction::update) auto_.observe_update(ready - start);
    auto_.observe_frame(end - ready, structure_->assessed_cost());
    builds_ += action == UpdateAction::build ? 1 : 0;
    return end - start;
  }

  [[nodiscard]] bool automatic() const { return !period_; }
  [[nodiscard]] std::uint64_t period() const { return period_.value_or(0); }
  [[nodiscard]] std::uint64_t builds() const { return builds_; }
  [[nodiscard]] const accel::AutoPolicy& costs() const { return auto_; }

 private:
  [[nodiscard]] Policy policy() const { return period_ ? Policy::refit : Policy::automatic; }
  [[nodiscard]] UpdateAction next(std::uint64_t number, TriangleChange change) const {
    if (!period_) return accel::decide(Policy::automatic, *structure_, change, auto_);
    return accel::decide(number % *period_ == 0 ? Policy::rebuild : Policy::refit, *structure_,
                         change);
  }

  const scene::Scene& scene_;
  const scene::TriangleList& list_;
  int size_;
  std::optional<std::uint64_t> period_;
  std::unique_ptr<accel::AccelerationStructure> structure_ =
      accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  renderer::CpuTracer tracer_{1};
  accel::AutoPolicy auto_;
  std::uint64_t builds_ = 0;
};

std::string period_name(std::uint64_t period) {
  return period == kNever ? "never" : fmt::format("{}", period);
}

void compete(const std::string& name, int size, int loops) {
  const scene::Scene scene = load(name);
  scene::TriangleList list;
  scene::update_triangles(scene, 0.5 / kFramesPerSecond, list);
  std::vector<std::unique_ptr<Contestant>> all;
  all.push_back(std::make_unique<Contestant>(scene, list, size, std::nullopt));
  for (const std::uint64_t period : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64}) {
    all.push_back(std::make_unique<Contestant>(scene, list, size, period));
  }
  all.push_back(std::make_unique<Contestant>(scene, list, size, kNever));

  const auto frames =
      static_cast<std::uint64_t>(std::lround(scene.duration_s() * kFramesPerSecond));
  if (frames == 0) {
    throw std::invalid_argument(
        fmt::format("{} does not move; try {}!, which flies apart", name, name));
  }
  std::vector<std::vector<double>> totals(all.size());
  std::uint64_t number = 0;
  for (int loop = 0; loop < loops; ++loop) {
    for (auto& row : totals) row.push_back(0.0);
    for (std::uint64_t i = 0; i < frames; ++i) {
      ++number;
      const auto change = scene::update_triangles(
          scene, (static_cast<double>(number) + 0.5) / kFramesPerSecond, list);
      for (std::size_t k = 0; k < all.size(); ++k) {
        const std::size_t turn = (k + number) % all.size();
        totals[turn].back() += all[turn]->frame(number, change);
      }
    }
  }
  std::vector<double> ms;
  for (const auto& row : totals) ms.push_back(1e3 * median(row) / static_cast<double>(frames));
  const auto best =
      static_cast<std::size_t>(std::min_element(ms.begin() + 1, ms.end()) - ms.begin());
  fmt::print(
      "{:<10} {:>4} {:>7} {:>9.3f} {:>9.3f} {:>9.3f} {:>6} {:>9.3f} {:>7.3f} {:>8.3f} {:>7.1f} "
      "{:>6.2f}\n",
      scene.name, size, list.triangles.size(), ms[1], ms.back(), ms[best],
      period_name(all[best]->period()), ms[0], ms[0] / ms[best], ms[0] / ms[1],
      static_cast<double>(number) /
          static_cast<double>(std::max<std::uint64_t>(1, all[0]->builds())),
      all[0]->costs().slope());
  std::fflush(stdout);
}

int run(int count, char** arguments) {
  const int loops = count > 1 ? std::stoi(arguments[1]) : 5;
  std::vector<int> sizes{128, 256, 512};
  if (count > 2 && std::stoi(arguments[2]) > 0) sizes = {std::stoi(arguments[2])};
  std::vector<std::string> names(arguments + std::min(count, 3), arguments + count);
  if (names.empty()) names = {"wave", "cow!", "bunny!", "toys", "metaballs"};
  fmt::print("{:<10} {:>4} {:>7} {:>9} {:>9} {:>9} {:>6} {:>9} {:>7} {:>8} {:>7} {:>6}\n", "scene",
             "size", "#T", "rebuild", "refit", "best", "period", "auto", "/best", "/rebuild",
             "frames", "slope");
  for (const std::string& name : names) {
    for (const int size : sizes) compete(name, size, loops);
  }
  return 0;
}

}  // namespace
}  // namespace encore::bench

int main(int count, char** arguments) {
  try {
    return encore::bench::run(count, arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "encore_bench_auto: {}\n", error.what());
    return 1;
  }
}
