#include "app/needs_report.h"

#include "app/json_text.h"
#include "app/number_text.h"
#include "app/profile_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace encore::app {

namespace {

/// The tests of one scene that draw it with the same rays.
struct Drawn {
  const WorkloadSpec* first = nullptr;
  const WorkloadSpec* measured = nullptr;  ///< the CPU draws it standing still
  scene::RunParts parts{.cpu = false, .moves = false};
};

void add(const WorkloadSpec& spec, Drawn& drawn) {
  drawn.parts.cpu = drawn.parts.cpu || spec.device == Device::cpu;
  drawn.parts.gpu = drawn.parts.gpu || spec.device == Device::gpu;
  drawn.parts.raster = drawn.parts.raster || spec.device == Device::raster;
  drawn.parts.moves = drawn.parts.moves || spec.test == TestKind::animated;
  const bool rests = spec.device == Device::cpu && spec.test == TestKind::fixed;
  if (rests && drawn.measured == nullptr) drawn.measured = &spec;
}

std::vector<Drawn> drawn_scenes(const std::vector<WorkloadSpec>& specs) {
  std::vector<Drawn> all;
  for (const WorkloadSpec& spec : specs) {
    if (spec.test == TestKind::build) continue;
    const auto same = [&](const Drawn& drawn) {
      return drawn.first->scene == spec.scene && drawn.first->rays == spec.rays;
    };
    auto at = std::find_if(all.begin(), all.end(), same);
    if (at == all.end()) at = all.insert(all.end(), {.first = &spec});
    add(spec, *at);
  }
  return all;
}

const FeatureCost* cost_of(const SceneLeftOut& scene, const std::string& feature) {
  if (!scene.cost) return nullptr;
  for (const FeatureCost& cost : scene.cost->features) {
    if (cost.feature == feature) return &cost;
  }
  return nullptr;
}

std::string bytes_cell(std::optional<std::uint64_t> bytes) {
  return bytes ? bytes_text(*bytes) : std::string();
}

/// "0.123 (0.110 to 0.140)"; a star where the picture would be another one.
std::string ms_cell(const FeatureCost* cost) {
  if (cost == nullptr) return {};
  if (cost->below_noise()) return cost->same_picture ? "below noise" : "below noise *";
  return fmt::format("{:.3f} ({:.3f} to {:.3f}){}", cost->ms, cost->low_ms, cost->high_ms,
                     cost->same_picture ? "" : " *");
}

/// The list's bytes, or those of the queues of rays that all threads would keep.
std::optional<std::uint64_t> host_bytes(const scene::LeftOut& feature, const FeatureCost* cost) {
  if (feature.host_bytes) return feature.host_bytes;
  return cost != nullptr ? cost->worker_bytes : std::nullopt;
}

std::string measuring_note(const SceneLeftOut& scene) {
  if (!scene.cost) return {};
  const NeedsCost& cost = *scene.cost;
  std::string note = fmt::format(
      "ms: on the CPU over bvh-median at {}x{}, where a frame takes {:.3f} ms; the median "
      "difference of {}\nrounds and its 96 % interval. Below noise: the interval holds 0.\n",
      cost.size.width, cost.size.height, cost.frame_ms, kCostRounds);
  const bool another = std::any_of(cost.features.begin(), cost.features.end(),
                                   [](const FeatureCost& one) { return !one.same_picture; });
  if (another) note += "* what it would cost: the picture would be another one.\n";
  return note;
}

std::string table_of(const SceneLeftOut& scene) {
  TextTable table;
  table.add_column("left out", TextTable::Align::left);
  table.add_column("host bytes");
  table.add_column("device bytes");
  table.add_column("ms a frame");
  table.add_column("why", TextTable::Align::left);
  for (const scene::LeftOut& feature : scene.features) {
    const FeatureCost* const cost = cost_of(scene, feature.feature);
    table.add_row({feature.feature, bytes_cell(host_bytes(feature, cost)),
                   bytes_cell(feature.bytes), ms_cell(cost), feature.reason});
  }
  return table.text();
}

template <class Number>
std::string json_or_null(const std::optional<Number>& number) {
  return number ? json_number(static_cast<double>(*number)) : "null";
}

std::string json_feature(const scene::LeftOut& feature, const FeatureCost* cost) {
  const auto ms = [cost](double FeatureCost::*member) {
    return cost != nullptr ? json_number(cost->*member) : std::string("null");
  };
  std::string same = "null";
  if (cost != nullptr) same = cost->same_picture ? "true" : "false";
  return fmt::format(
      "{{\"feature\": {}, \"reason\": {}, \"host_bytes\": {}, \"device_bytes\": {}, \"ms\": {}, "
      "\"low_ms\": {}, \"high_ms\": {}, \"same_picture\": {}}}",
      json_text(feature.feature), json_text(feature.reason),
      json_or_null(host_bytes(feature, cost)), json_or_null(feature.bytes), ms(&FeatureCost::ms),
      ms(&FeatureCost::low_ms), ms(&FeatureCost::high_ms), same);
}

std::string json_scene(const SceneLeftOut& scene) {
  std::string size = "null";
  std::string frame = "null";
  if (scene.cost) {
    size = json_text(fmt::format("{}x{}", scene.cost->size.width, scene.cost->size.height));
    frame = json_number(scene.cost->frame_ms);
  }
  std::string features;
  for (const scene::LeftOut& feature : scene.features) {
    features += features.empty() ? "\n      " : ",\n      ";
    features += json_feature(feature, cost_of(scene, feature.feature));
  }
  return fmt::format(
      "{{\"scene\": {}, \"measured_size\": {}, \"frame_ms\": {}, \"features\": [{}]}}",
      json_text(scene.scene), size, frame, features);
}

}  // namespace

std::vector<SceneLeftOut> scenes_left_out(const std::vector<WorkloadSpec>& specs,
                                          const std::atomic<bool>& stop) {
  std::vector<SceneLeftOut> scenes;
  for (const Drawn& drawn : drawn_scenes(specs)) {
    const scene::Scene& scene = *drawn.first->scene;
    scene::TriangleList list;
    scene::update_triangles(scene, 0.0, list);
    SceneLeftOut found;
    found.scene = scene.name;
    found.features = scene::left_out(scene, list, drawn.first->rays, drawn.parts);
    list = {};  // measuring makes its own
    if (const WorkloadSpec* spec = drawn.measured; spec != nullptr && !stop) {
      found.cost = measure_needs_cost({&scene, spec->rays, spec->size, spec->threads}, stop);
    }
    scenes.push_back(std::move(found));
  }
  return scenes;
}

std::string left_out_text(const std::vector<SceneLeftOut>& scenes) {
  std::string text;
  for (const SceneLeftOut& scene : scenes) {
    if (scene.features.empty()) continue;
    text += scenes.size() > 1 ? fmt::format("\nLeft out ({})\n", scene.scene) : "\nLeft out\n";
    text += table_of(scene) + measuring_note(scene);
  }
  return text;
}

std::string left_out_json(const std::vector<SceneLeftOut>& scenes) {
  std::string json = "[";
  for (const SceneLeftOut& scene : scenes) {
    json += (json.size() > 1 ? ",\n    " : "\n    ") + json_scene(scene);
  }
  return json + (scenes.empty() ? "]" : "\n  ]");
}

std::string needs_text(const scene::RunNeeds& needs, const scene::RunParts& parts) {
  std::string text;
  const auto add_if = [&text](bool used, std::string_view what) {
    if (used) text += fmt::format("{}{}", text.empty() ? "" : ", ", what);
  };
  const scene::Needs& picture = needs.picture;
  add_if(picture.lights, "lights");
  add_if(picture.normals, "shading normals");
  add_if(picture.colors, "vertex colours");
  add_if(picture.textures, "textures");
  add_if(picture.highlights, "highlights");
  add_if(picture.shadows, "shadow rays");
  add_if(picture.reflections, "reflected rays");
  add_if(picture.refractions, "refracted rays");
  add_if(picture.samples, "several samples a pixel");
  add_if(needs.animates(), "animation");
  add_if(parts.cpu, "device cpu");
  add_if(parts.gpu, "device gpu");
  add_if(parts.raster, "device raster");
  add_if(needs.counting, "counting");
  return text;
}

}  // namespace encore::app
