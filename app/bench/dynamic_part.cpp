#include "accel/auto_policy.h"
#include "accel/make_structure.h"
#include "accel/update_policy.h"
#include "app/bench/bench.h"
#include "app/bench/embree_structure.h"
#include "renderer/cpu_tracer.h"
#include "scene/scene_file.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <thread>

namespace encore::app::bench {

namespace {

using accel::Policy;
using accel::UpdateAction;

constexpr double kFramesPerSecond = 30.0;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds a frame.
struct Split {
  double build = 0.0;
  double trace = 0.0;
  [[nodiscard]] double total() const { return build + trace; }
};

/// One way to follow the motion.
class Player {
 public:
  Player(std::string name, std::unique_ptr<accel::AccelerationStructure> structure, Policy policy,
         const scene::Scene& scene, const scene::TriangleList& list, int threads)
      : name_(std::move(name)),
        structure_(std::move(structure)),
        policy_(policy),
        scene_(scene),
        list_(list),
        tracer_(threads) {
    structure_->set_build_threads(threads);
    structure_->set_intersection(accel::IntersectionMode::moller_trumbore);
    // The first of a second build pays for no fresh memory any more.
    structure_->build(list_.triangles);
    const double start = now_s();
    accel::carry_out(UpdateAction::build, policy_, *structure_, list_.triangles);
    auto_.observe_build(now_s() - start);
    tracer_.init({&scene_, &list_, structure_.get()});
  }

  /// One frame at the list's present state.
  Split frame(scene::TriangleChange change, int side) {
    const double start = now_s();
    const UpdateAction action = policy_ == Policy::automatic
                                    ? accel::decide(policy_, *structure_, change, auto_)
                                    : accel::decide(policy_, *structure_, change);
    accel::carry_out(action, policy_, *structure_, list_.triangles);
    const double ready = now_s();
    tracer_.refresh();
    tracer_.draw(scene_.camera, side, side);
    const double end = now_s();
    if (policy_ == Policy::automatic) {
      if (action == UpdateAction::build) auto_.observe_build(ready - start);
      if (action == UpdateAction::update) auto_.observe_update(ready - start);
      auto_.observe_frame(end - ready, structure_->assessed_cost());
    }
    return {ready - start, end - ready};
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Policy policy() const { return policy_; }

 private:
  std::string name_;
  std::unique_ptr<accel::AccelerationStructure> structure_;
  Policy policy_;
  const scene::Scene& scene_;
  const scene::TriangleList& list_;
  renderer::CpuTracer tracer_;
  accel::AutoPolicy auto_;
};

struct Stage {
  scene::Scene scene;
  scene::TriangleList list;
  std::vector<std::unique_ptr<Player>> players;  ///< the peers first
  std::size_t peers = 0;
};

void add_players(const Bench& bench, Stage& stage, int threads, EmbreeDevice* embree) {
  const auto add = [&](const std::string& name,
                       std::unique_ptr<accel::AccelerationStructure> structure, Policy policy) {
    stage.players.push_back(std::make_unique<Player>(name, std::move(structure), policy,
                                                     stage.scene, stage.list, threads));
  };
  if (embree != nullptr) {
    const EmbreeSettings rebuilt{.quality = EmbreeQuality::low, .dynamic = true};
    const EmbreeSettings refitted{.quality = EmbreeQuality::low, .compact = true, .refit = true};
    add(embree_name(rebuilt), std::make_unique<EmbreeStructure>(*embree, rebuilt), Policy::rebuild);
    add(embree_name(refitted), std::make_unique<EmbreeStructure>(*embree, refitted), Policy::refit);
  }
  stage.peers = stage.players.size();
  for (const Contestant& contestant : contestants(bench.plan)) {
    for (const Policy policy : {Policy::rebuild, Policy::refit, Policy::automatic}) {
      auto structure = accel::make_structure(contestant.spec);
      if (policy != Policy::rebuild && !accel::updates(policy, *structure)) continue;
      add(fmt::format("{}, {}", contestant.name, to_string(policy)), std::move(structure), policy);
    }
  }
}

/// Splits[player][round]: means of the frames of a round, which everybody plays side by side.
std::vector<std::vector<Split>> play(Bench& bench, Stage& stage) {
  std::vector<std::vector<Split>> splits(stage.players.size());
  std::uint64_t number = 0;
  for (int round = -1; round < bench.plan.rounds; ++round) {
    std::vector<Split> sums(stage.players.size());
    for (int i = 0; i < bench.plan.frames; ++i) {
      ++number;
      const auto change = scene::update_triangles(
          stage.scene, static_cast<double>(number) / kFramesPerSecond, stage.list);
      for (std::size_t k = 0; k < stage.players.size(); ++k) {
        const std::size_t turn = (k + number) % stage.players.size();
        const Split one = stage.players[turn]->frame(change, bench.plan.side);
        sums[turn].build += one.build / bench.plan.frames;
        sums[turn].trace += one.trace / bench.plan.frames;
        if (bench.cancelled()) return splits;
      }
    }
    // The round before the first warms up.
    for (std::size_t k = 0; round >= 0 && k < sums.size(); ++k) splits[k].push_back(sums[k]);
  }
  return splits;
}

std::vector<double> totals(const std::vector<Split>& splits) {
  std::vector<double> result;
  for (const Split& split : splits) result.push_back(split.total());
  return result;
}

Split median(const std::vector<Split>& splits) {
  std::vector<double> build;
  std::vector<double> trace;
  for (const Split& split : splits) {
    build.push_back(split.build);
    trace.push_back(split.trace);
  }
  return {spread_of(build).median, spread_of(trace).median};
}

std::string split_note(const Split& split) {
  return fmt::format("{:.2f} ms build, {:.2f} ms trace", 1e3 * split.build, 1e3 * split.trace);
}

void add_rows(Bench& bench, const Stage& stage, const std::vector<std::vector<Split>>& splits,
              int threads) {
  for (std::size_t k = stage.peers; k < stage.players.size(); ++k) {
    const Player& player = *stage.players[k];
    BenchRow row{.part = "dynamic",
                 .scene = stage.scene.name,
                 .triangles = stage.list.triangles.size(),
                 .threads = threads,
                 .operation = "frames",
                 .ours = player.name(),
                 .unit = "fps"};
    const std::vector<double> ours = totals(splits[k]);
    const Spread spread = spread_of(ours);
    row.our_value = 1.0 / spread.median;
    row.repeats = ours.size();
    row.noise = spread.max / spread.min;
    row.note = split_note(median(splits[k]));
    if (stage.peers > 0) {
      const std::size_t peer = player.policy() == Policy::rebuild ? 0 : 1;
      const std::vector<double> theirs = totals(splits[peer]);
      row.peer = stage.players[peer]->name();
      row.peer_value = 1.0 / spread_of(theirs).median;
      row.ratio = speed_ratio(ours, theirs);
      row.note += fmt::format("; peer {}", split_note(median(splits[peer])));
    }
    bench.report.add(row);
  }
}

}  // namespace

void bench_dynamic(Bench& bench) {
  if (bench.cancelled()) return;
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (const std::string& name : bench.plan.moving) {
    bench.progress("playing " + name);
    Stage stage{scene::load_scene(name), {}, {}, 0};
    if (!stage.scene.animated()) {
      bench.report.say(fmt::format("\n{} does not move: left out of the part dynamic", name));
      continue;
    }
    scene::update_triangles(stage.scene, 0.0, stage.list);
    const auto embree = EmbreeDevice::open(threads);
    add_players(bench, stage, threads, embree.get());
    const auto splits = play(bench, stage);
    if (!splits.empty() && !splits.front().empty()) add_rows(bench, stage, splits, threads);
    stage.players.clear();  // before the device
    if (bench.cancelled()) return;
  }
}

}  // namespace encore::app::bench
