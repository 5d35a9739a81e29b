#include "app/stability.h"

#include "accel/brute_force.h"
#include "accel/exact_oracle.h"
#include "accel/make_structure.h"
#include "accel/memory_bound.h"
#include "accel/parallel.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/number_text.h"
#include "app/stability_closed.h"
#include "renderer/gpu_tracer.h"
#include "renderer/trace_defines.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

namespace encore::app {

namespace {

using accel::IntersectionMode;
using accel::StabilityCase;
using accel::StructureKind;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Brute force over more triangles is the reference alone, not a structure to be looked at.
constexpr std::size_t kMostForBrute = 10'000;
/// The exact oracle is some twenty times as slow as brute force.
constexpr double kOracleCost = 20.0;

/// The frames of a moving case at which hits are looked at.
std::vector<int> checkpoints(int frames) {
  if (frames == 0) return {0};
  return {0, 1, frames / 100, frames / 10, frames / 4, frames / 2, frames};
}

/// The triangles of a case, as a tracer wants them.
struct CaseScene {
  const StabilityCase& which;
  std::vector<scene::Triangle> start;
  scene::Scene scene;
  scene::TriangleList list;
  std::uint64_t seed;

  CaseScene(const StabilityCase& c, const StabilityPlan& plan)
      : which(c), start(accel::stability_triangles(c, plan.size, plan.seed)), seed(plan.seed) {
    list.triangles = start;
    list.topology_version = 1;
    moved();
  }
  void go_to(int frame) {
    accel::frame_of(start, frame, seed, list.triangles);
    moved();
  }

 private:
  void moved() {
    ++list.version;
    list.bookkeeping.instances.resize(1);
    list.bookkeeping.instances[0].count = list.triangles.size();
    list.bookkeeping.instances[0].version = list.version;
  }
};

/// One structure over one case, in every mode and on every device.
class StructureRun {
 public:
  StructureRun(CaseScene& scene, const accel::StructureSpec& spec, const StabilityPlan& plan)
      : scene_(scene), spec_(spec), plan_(plan), structure_(accel::make_structure(spec)) {
    const auto modes = plan.modes.empty() ? accel::all_intersection_modes() : plan.modes;
    for (const IntersectionMode mode : modes) {
      if (plan.cpu) add_row(mode, "cpu");
      if (plan.gpu && renderer::has_gpu_traversal(spec.kind)) add_row(mode, "gpu");
    }
  }

  std::vector<StabilityRow> run() {
    try {
      run_frames();
    } catch (const std::bad_alloc&) {
      for (StabilityRow& row : rows_) {
        row.broken = fmt::format("out of memory over {} triangles",
                                 with_separators(scene_.list.triangles.size()));
      }
    }
    for (StabilityRow& row : rows_) judge(row);
    return std::move(rows_);
  }

 private:
  void add_row(IntersectionMode mode, const char* device) {
    StabilityRow row;
    row.name = scene_.which.name;
    row.structure = structure_->name();
    row.mode = mode;
    row.device = device;
    row.triangles = scene_.list.triangles.size();
    row.against = by_oracle(row) ? "exact oracle" : "brute";
    rows_.push_back(row);
  }

  [[nodiscard]] bool by_oracle(const StabilityRow& row) const {
    return spec_.kind == StructureKind::brute && row.mode == IntersectionMode::precise;
  }

  void run_frames() {
    const auto begun = Clock::now();
    if (scene_.which.frames > 0) scene_.go_to(0);
    structure_->build(scene_.list.triangles);
    const double build_s = seconds_since(begun);
    const accel::BuildStats built = structure_->stats();
    int frame = 0;
    double update_s = 0.0;
    const bool refits = scene_.which.frames > 0 && structure_->can_refit();
    for (const int stop : checkpoints(scene_.which.frames)) {
      if (stop > frame && !refits) {
        scene_.go_to(stop);
        structure_->build(scene_.list.triangles);
      }
      for (; frame < stop && refits && !interrupted; ++frame) {
        scene_.go_to(frame + 1);
        const auto start = Clock::now();
        structure_->update(scene_.list.triangles);
        update_s += seconds_since(start);
      }
      frame = stop;
      if (interrupted) return;
      look();
    }
    for (StabilityRow& row : rows_) {
      row.build_s = build_s;
      if (refits) row.update_s = update_s / scene_.which.frames;
      if (scene_.which.frames > 0) row.action = refits ? "refit" : "rebuild";
      row.asked_bytes = built.allocated_bytes;
    }
  }

  /// Traces rays in all modes and on all devices as the structure now stands.
  void look() {
    const auto& triangles = scene_.list.triangles;
    const accel::BuildStats stats = structure_->stats();
    const bool brute = spec_.kind == StructureKind::brute;
    // Where boxes and cells tell nothing apart, a ray meets all references, not each triangle once.
    const double tests =
        static_cast<double>(std::max<std::uint64_t>({1, triangles.size(), stats.references}));
    const double each = plan_.reference_tests / (brute ? 8.0 * kOracleCost : 8.0) / tests;
    const std::size_t count =
        std::min(plan_.rays_per_kind, static_cast<std::size_t>(std::max(each, 4.0)));
    rays_ = accel::stability_rays(scene_.which, count, plan_.seed, triangles, *structure_);
    find_truth(brute);
    for (StabilityRow& row : rows_) {
      if (interrupted) return;
      structure_->set_intersection(row.mode);
      if (row.device == "cpu") {
        trace_on_cpu(row);
      } else {
        trace_on_gpu(row);
      }
      row.bytes = stats.bytes;
      row.references = stats.references;
      row.limited = row.limited || stats.limited;
      nodes_ = std::max(nodes_, stats.nodes);
    }
  }

  void find_truth(bool exactly) {
    const auto& triangles = scene_.list.triangles;
    accel::BruteForce brute;
    brute.build(triangles);
    truth_.resize(rays_.size());
    exact_.resize(exactly ? rays_.size() : 0);
    for_slices([&](std::size_t first, std::size_t count) {
      brute.intersect(std::span(rays_).subspan(first, count),
                      std::span(truth_).subspan(first, count));
      for (std::size_t i = first; exactly && i < first + count; ++i) {
        exact_[i] = accel::exact_nearest_hit(triangles, rays_[i]);
      }
    });
  }

  /// work(first, count) over all rays on all threads, a few rays at a time: in hostile cases one
  /// takes 50 ms. Leaves out what has not begun when interrupted; nobody looks at the rest then.
  template <class Work>
  void for_slices(const Work& work) const {
    constexpr std::size_t kSlice = 4;
    accel::Workers(0).for_parts(rays_.size(), kSlice, [&](std::size_t begin, std::size_t end) {
      if (!interrupted) work(begin, end - begin);
    });
  }

  void trace_on_cpu(StabilityRow& row) {
    found_.resize(rays_.size());
    const auto start = Clock::now();
    constexpr std::size_t kSlice = 64;
    for (std::size_t first = 0; first < rays_.size() && !interrupted; first += kSlice) {
      const std::size_t count = std::min(kSlice, rays_.size() - first);
      structure_->intersect(std::span(rays_).subspan(first, count),
                            std::span(found_).subspan(first, count));
    }
    row.trace_s = row.trace_s.value_or(0.0) + seconds_since(start);
    if (interrupted) return;

    const Exactness exactness = row.mode != IntersectionMode::precise ? Exactness::single
                                : by_oracle(row)                      ? Exactness::twice
                                                                      : Exactness::bits;
    tally(row, exactness);
    std::vector<std::uint8_t> blocked(rays_.size());
    for_slices([&](std::size_t first, std::size_t count) {
      structure_->occluded(std::span(rays_).subspan(first, count),
                           std::span(blocked).subspan(first, count));
    });
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      row.tally.wrong_occlusion += (blocked[i] != 0) != found_[i].found() ? 1 : 0;
    }
    if (spec_.kind == StructureKind::brute) return;
    std::vector<accel::TraceCounters> counters(rays_.size());
    for_slices([&](std::size_t first, std::size_t count) {
      structure_->intersect_counted(std::span(rays_).subspan(first, count),
                                    std::span(found_).subspan(first, count),
                                    std::span(counters).subspan(first, count));
    });
    std::uint64_t most = row.most_steps.value_or(0);
    for (const accel::TraceCounters& c : counters) most = std::max<std::uint64_t>(most, c.steps);
    row.most_steps = most;
  }

  void trace_on_gpu(StabilityRow& row) {
    renderer::GpuTracer tracer(plan_.gpu);
    tracer.init({&scene_.scene, &scene_.list, structure_.get()});
    found_.resize(rays_.size());
    const auto start = Clock::now();
    tracer.trace_rays(rays_, found_);
    row.trace_s = row.trace_s.value_or(0.0) + seconds_since(start);
    const bool precise = row.mode == IntersectionMode::precise;
    tally(row, precise ? Exactness::twice : Exactness::single);
  }

  void tally(StabilityRow& row, Exactness exactness) const {
    const std::vector<scene::Hit>& truth = by_oracle(row) ? exact_ : truth_;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      row.tally.add(scene_.list.triangles, rays_[i], truth[i], found_[i], exactness);
    }
  }

  void judge(StabilityRow& row) const {
    if (!row.broken.empty()) return;
    const StabilityTally& t = row.tally;
    const std::uint64_t limit = accel::most_bytes(spec_, row.triangles);
    if (row.mode != IntersectionMode::moller_trumbore && t.wrong() > 0) {
      row.broken = fmt::format("{} of {} rays answered wrong", t.wrong(), t.rays);
    } else if (t.wrong_occlusion > 0) {
      row.broken = fmt::format("any-hit disagrees for {} of {} rays", t.wrong_occlusion, t.rays);
    } else if (row.most_steps.value_or(0) > std::max<std::uint64_t>(nodes_, 1)) {
      row.broken =
          fmt::format("a ray took {} steps through {} nodes or cells", *row.most_steps, nodes_);
    } else if (row.bytes.value_or(0) > limit) {
      row.broken =
          fmt::format("{} where {} are allowed", bytes_text(*row.bytes), bytes_text(limit));
    }
  }

  CaseScene& scene_;
  const accel::StructureSpec& spec_;
  const StabilityPlan& plan_;
  std::unique_ptr<accel::AccelerationStructure> structure_;
  std::vector<StabilityRow> rows_;
  std::vector<scene::Ray> rays_;
  std::vector<scene::Hit> truth_;
  std::vector<scene::Hit> exact_;
  std::vector<scene::Hit> found_;
  std::uint64_t nodes_ = 0;
};

std::vector<accel::StructureSpec> structures_of(const StabilityPlan& plan) {
  if (!plan.structures.empty()) return plan.structures;
  std::vector<accel::StructureSpec> specs;
  for (const StructureKind kind : accel::all_structure_kinds()) {
    specs.push_back(accel::default_spec(kind));
  }
  return specs;
}

}  // namespace

std::vector<std::string> stability_case_names() {
  std::vector<std::string> names;
  for (const StabilityCase& c : accel::stability_cases()) names.emplace_back(c.name);
  for (std::string& name : closed_case_names()) names.push_back(std::move(name));
  return names;
}

void run_stability(const StabilityPlan& plan, const std::function<void(const StabilityRow&)>& row,
                   const std::function<void(double, const std::string&)>& progress) {
  const std::vector<std::string> known = stability_case_names();
  for (const std::string& name : plan.cases) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw UsageError(
        fmt::format("there is no stability case '{}'; there are {}", name, fmt::join(known, ", ")));
  }
  const std::vector<std::string>& names = plan.cases.empty() ? known : plan.cases;
  const auto specs = structures_of(plan);
  double done = 0.0;
  const double step = 1.0 / static_cast<double>(names.size() * specs.size());
  for (const std::string& name : names) {
    const StabilityCase* which = accel::find_stability_case(name);
    std::optional<CaseScene> scene;
    if (which != nullptr) scene.emplace(*which, plan);
    for (const accel::StructureSpec& spec : specs) {
      if (interrupted) return;
      progress(done, name);
      done += step;
      if (scene && spec.kind == StructureKind::brute && scene->start.size() > kMostForBrute) {
        continue;
      }
      const auto rows =
          scene ? StructureRun(*scene, spec, plan).run() : run_closed_case(name, spec, plan);
      if (interrupted) return;
      for (const StabilityRow& one : rows) row(one);
    }
  }
}

}  // namespace encore::app
