#include "app/needs_cost.h"

#include "accel/make_structure.h"
#include "energy/statistics.h"
#include "renderer/cpu_tracer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

namespace encore::app {

namespace {

using scene::Needs;

/// Where a frame takes longer than that, pictures are drawn smaller.
constexpr double kDrawingMs = 500.0;
constexpr int kLeastSide = 32;
/// Not 0, and yet below the last bit of whatever it is added to.
constexpr float kTooDarkToSee = 1e-30F;

/// The data of the triangles that a variant puts in; whatever the scene has itself stays there.
struct Forced {
  bool normals = false;
  bool colors = false;
  bool texcoords = false;
};

/// What is drawn of a variant.
enum class Output { picture, hits, counters };

/// One way to draw the scene.
struct Variant {
  std::string feature;
  bool same_picture = true;
  scene::Scene scene;
  scene::RaySettings rays;
  Forced forced;
  Output output = Output::picture;
  std::vector<double> times_ms{};  ///< a round
};

/// The variants of a scene, and everything that drawing them takes.
class CostRun {
 public:
  explicit CostRun(const NeedsCostCase& what)
      : what_(what), size_(what.size), tracer_(what.threads) {
    scene::update_triangles(*what.scene, 0.0, list_);
    if (list_.triangles.empty()) return;
    structure_ = accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
    structure_->build(list_.triangles);
    needs_ = scene::needs_of(*what.scene, list_, what.rays);
    could_ = needs_of_everything();
    add("", true);
    if (needs_.lights) add_surfaces();
    add_rays();
    // Counting goes with hits, which are not shaded: it is held against those.
    add("", true).output = Output::hits;
    add("counting", true).output = Output::counters;
  }

  [[nodiscard]] bool empty() const { return variants_.empty(); }

  /// False if it was stopped.
  bool measure(const std::atomic<bool>& stop) {
    fit_size();
    // The first round warms up: memory, caches, threads.
    for (int round = -1; round < kCostRounds; ++round) {
      // Another one comes first each time: what was drawn before leaves its traces in caches.
      for (std::size_t i = 0; i < variants_.size(); ++i) {
        if (stop) return false;
        const auto first = static_cast<std::size_t>(round + 1);
        Variant& variant = variants_[(first + i) % variants_.size()];
        const double ms = draw_ms(variant);
        if (round >= 0) variant.times_ms.push_back(ms);
      }
    }
    return true;
  }

  [[nodiscard]] NeedsCost result() {
    NeedsCost cost;
    cost.size = size_;
    cost.frame_ms = energy::median(variants_.front().times_ms).value_or(0.0);
    const Variant* without = nullptr;
    for (const Variant& variant : variants_) {
      if (variant.feature.empty()) {
        without = &variant;
      } else {
        cost.features.push_back(cost_of(variant, *without));
      }
    }
    return cost;
  }

 private:
  [[nodiscard]] Needs needs_of_everything() const {
    scene::RaySettings all = what_.rays;
    all.shadows = all.reflections = all.refractions = true;
    all.depth = std::max(all.depth, 1);
    return scene::needs_of(*what_.scene, list_, all);
  }

  Variant& add(std::string feature, bool same_picture) {
    variants_.push_back({std::move(feature), same_picture, *what_.scene, what_.rays, {}});
    return variants_.back();
  }

  void add_surfaces() {
    if (!needs_.normals) add("shading normals", true).forced.normals = true;
    if (!needs_.colors) add("vertex colours", true).forced.colors = true;
    if (!needs_.textures) add_textures();
    if (!needs_.highlights) {
      for (scene::Material& material : add("highlights", true).scene.materials) {
        material.specular = glm::vec3(kTooDarkToSee);
      }
    }
  }

  void add_textures() {
    Variant& variant = add("texture coordinates", true);
    variant.rays.textures = true;
    const bool own = !list_.texcoords.empty();
    variant.same_picture = !own;
    if (own) return;
    variant.forced.texcoords = true;
    auto white = std::make_shared<scene::Texture>();
    white->name = "white";
    white->width = white->height = 1;
    white->texels = {0xFFFFFFFFU};
    for (scene::Material& material : variant.scene.materials) material.diffuse_texture = white;
  }

  void add_rays() {
    if (!needs_.shadows && could_.shadows) add("shadow rays", false).rays.shadows = true;
    if (!needs_.reflections) {
      add_bounces("reflected rays", could_.reflections).rays.reflections = true;
    }
    if (!needs_.refractions) {
      add_bounces("refracted rays", could_.refractions).rays.refractions = true;
    }
    if (!needs_.samples) add("sample places", false).rays.samples = 2;
  }

  Variant& add_bounces(std::string feature, bool possible) {
    Variant& variant = add(std::move(feature), !possible);
    variant.rays.depth = std::max(variant.rays.depth, 1);
    if (!possible) {
      // No triangle is made of it, unless it names a material that does not exist.
      scene::Material glass;
      glass.reflectivity = 0.5F;
      glass.opacity = 0.5F;
      variant.scene.materials.resize(variant.scene.materials.size() + 1);
      variant.scene.materials.push_back(glass);
    }
    return variant;
  }

  /// Lets a variant's data change places with the list's own.
  void exchange(const Forced& forced) {
    if (forced.normals) std::swap(list_.normals, normals_);
    if (forced.colors) std::swap(list_.colors, colors_);
    if (forced.texcoords) std::swap(list_.texcoords, texcoords_);
  }

  /// What variants put in, as large as the list.
  void make_data() {
    const std::size_t count = list_.triangles.size();
    const auto wanted = [&](bool Forced::*what) {
      return std::any_of(variants_.begin(), variants_.end(),
                         [&](const Variant& variant) { return variant.forced.*what; });
    };
    if (wanted(&Forced::normals)) normals_.assign(count, {});
    constexpr glm::vec3 kWhite(1.0F);
    if (wanted(&Forced::colors)) colors_.assign(count, {kWhite, kWhite, kWhite});
    if (wanted(&Forced::texcoords)) texcoords_.assign(count, {});
  }

  void draw(const Variant& variant) {
    const scene::Camera& camera = variant.scene.camera;
    switch (variant.output) {
      case Output::picture:
        return tracer_.draw(camera, size_.width, size_.height);
      case Output::hits:
        return tracer_.trace_hits(camera, size_.width, size_.height, hits_);
      case Output::counters:
        return tracer_.trace_counters(camera, size_.width, size_.height, counters_);
    }
  }

  double draw_ms(const Variant& variant) {
    exchange(variant.forced);
    tracer_.set_rays(variant.rays);
    tracer_.init({&variant.scene, &list_, structure_.get()});
    const auto begin = std::chrono::steady_clock::now();
    draw(variant);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - begin;
    exchange(variant.forced);
    return ms.count();
  }

  /// Makes pictures so small that all of them take about kDrawingMs.
  void fit_size() {
    make_data();
    draw_ms(variants_.front());
    const double all = draw_ms(variants_.front()) * static_cast<double>(variants_.size()) *
                       (kCostRounds + 1) * 1.5;  // shadows and samples take twice as long
    if (all <= kDrawingMs) return;
    const double factor = std::sqrt(kDrawingMs / all);
    const auto smaller = [&](int side) {
      return std::min(side, std::max(kLeastSide, static_cast<int>(side * factor)));
    };
    size_ = {smaller(size_.width), smaller(size_.height)};
  }

  FeatureCost cost_of(const Variant& variant, const Variant& without) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < variant.times_ms.size(); ++i) {
      differences.push_back(variant.times_ms[i] - without.times_ms[i]);
    }
    std::sort(differences.begin(), differences.end());
    constexpr std::size_t kTail = 3;
    static_assert(kCostRounds == 15, "FeatureCost says how sure the interval is");
    FeatureCost cost{variant.feature, variant.same_picture,
                     energy::median(differences).value_or(0.0), differences[kTail],
                     differences[differences.size() - 1 - kTail]};
    exchange(variant.forced);
    const Needs needs = scene::needs_of(variant.scene, list_, variant.rays);
    if (needs.paths() && !needs_.paths()) {
      renderer::CpuPaths paths;
      paths.prepare({&variant.scene, &list_, structure_.get()}, needs, variant.rays,
                    tracer_.threads());
      cost.worker_bytes = paths.bytes();
    }
    exchange(variant.forced);
    return cost;
  }

  NeedsCostCase what_;
  ImageSize size_;
  renderer::CpuTracer tracer_;
  scene::TriangleList list_;
  std::unique_ptr<accel::AccelerationStructure> structure_;
  Needs needs_;
  Needs could_;
  std::vector<Variant> variants_;  ///< those without a name come before what they are held against
  std::vector<scene::Hit> hits_;
  std::vector<std::array<glm::vec3, 3>> normals_;
  std::vector<std::array<glm::vec3, 3>> colors_;
  std::vector<std::array<glm::vec2, 3>> texcoords_;
  std::vector<accel::TraceCounters> counters_;
};

}  // namespace

std::optional<NeedsCost> measure_needs_cost(const NeedsCostCase& what,
                                            const std::atomic<bool>& stop) {
  CostRun run(what);
  if (run.empty() || !run.measure(stop)) return std::nullopt;
  return run.result();
}

}  // namespace encore::app
