#include "ui/panels/settings_column.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <thread>
#include <utility>
#include <vector>

namespace encore::ui {

namespace {

using accel::Policy;
using accel::StructureKind;

/// Scenes of at most so many triangles may be traced without a structure.
constexpr std::uint64_t kTinyScene = 2000;
/// The largest side of a picture.
constexpr int kLargestSide = 16384;

constexpr std::array<ValueChoice<PaneDevice>, 4> kDevices{{
    {PaneDevice::off, "off", "no picture; the other pane has the room"},
    {PaneDevice::cpu, "cpu", "the processor traces rays through the structure"},
    {PaneDevice::gpu, "gpu", "the graphics device traces the same rays in compute shaders"},
    {PaneDevice::raster, "raster",
     "the graphics device draws triangles, without rays or structure"},
}};

constexpr std::array<ValueChoice<PaneContent>, 3> kContents{{
    {PaneContent::picture, "picture", "the shaded scene"},
    {PaneContent::heatmap, "heatmap", "what each pixel's ray cost; see Heatmap below"},
    {PaneContent::difference, "difference",
     "against the other pane's picture, which has to have the same size"},
}};

constexpr std::array<ValueChoice<StructureKind>, 7> kKinds{{
    {StructureKind::grid_exact, "grid-exact",
     "uniform grid; a triangle is kept in the cells that it overlaps (thesis: UG-A)"},
    {StructureKind::grid_box, "grid-box",
     "uniform grid; a triangle is kept in all cells that its box touches: quicker to build, slower "
     "to trace (thesis: UG-N)"},
    {StructureKind::kd_median, "kd-median",
     "kd-tree that halves its boxes, the axes taking turns (thesis: KD-M)"},
    {StructureKind::kd_sah, "kd-sah",
     "kd-tree that splits where the surface area heuristic expects the least cost: dear to build, "
     "cheap to trace (thesis: KD-S)"},
    {StructureKind::bvh_median, "bvh-median",
     "bounding volume hierarchy split in the middle, one triangle a leaf (thesis: BV, built BV-F, "
     "refitted BV-U)"},
    {StructureKind::bvh_sah, "bvh-sah",
     "bounding volume hierarchy of up to eight children, built by the surface area heuristic and "
     "traced with the processor's widest registers: what a tracer of today uses"},
    {StructureKind::brute, "brute",
     "no structure: every ray tests every triangle; what the others are held to"},
}};

constexpr std::array<ValueChoice<Policy>, 4> kPolicies{{
    {Policy::rebuild, "rebuild", "builds afresh before every frame (thesis: BV-F)"},
    {Policy::refit, "refit", "keeps the tree and fits its boxes (thesis: BV-U)"},
    {Policy::automatic, "auto", "refits while the tree is good, builds when it has decayed"},
    {Policy::fixed, "static", "leaves the structure as it is, whatever the scene does"},
}};

constexpr std::array<ValueChoice<accel::MemoryMode>, 2> kMemory{{
    {accel::MemoryMode::pool, "pool", "every build reuses what the last one allocated"},
    {accel::MemoryMode::fresh, "malloc",
     "every build allocates afresh and frees what the last one held"},
}};

constexpr std::array<ValueChoice<accel::IntersectionMode>, 3> kIntersections{{
    {accel::IntersectionMode::precise, "precise",
     "double precision wherever single precision leaves a doubt: the definition of a hit that the "
     "others are measured by"},
    {accel::IntersectionMode::moller_trumbore, "moller-trumbore",
     "Moller and Trumbore 1997 in single precision: may lose hits on edges, the more the farther "
     "away or the thinner the triangle"},
    {accel::IntersectionMode::watertight, "watertight",
     "Woop, Benthin and Wald 2013 in single precision: no ray slips between triangles that share "
     "an edge"},
}};

constexpr std::array<ValueChoice<accel::RayGrouping>, 2> kGroupings{{
    {accel::RayGrouping::packets, "packets",
     "neighbouring rays go through the structure together: the same hits, found sooner"},
    {accel::RayGrouping::single, "single", "one ray after the other, as in the thesis"},
}};

constexpr std::array<ValueChoice<accel::BuildPlace>, 3> kBuildPlaces{{
    {accel::BuildPlace::automatic, "auto",
     "on the graphics device, unless that is a renderer in software"},
    {accel::BuildPlace::cpu, "cpu", "on the CPU; the graphics device is sent a copy of the tree"},
    {accel::BuildPlace::device, "device",
     "on the graphics device, which is sent the triangles alone"},
}};

constexpr std::array<ValueChoice<SizeChoice>, 6> kSizes{{
    {SizeChoice::window, "window", "as many pixels as the pane has"},
    {SizeChoice::square_256, "256", "256 × 256, the thesis' low resolution"},
    {SizeChoice::square_512, "512", "512 × 512"},
    {SizeChoice::square_768, "768", "768 × 768"},
    {SizeChoice::square_1024, "1024", "1024 × 1024"},
    {SizeChoice::custom, "custom", "width and height as entered below"},
}};

const char* prefix_of(std::size_t pane) {
  return pane == 0 ? "settings.left" : "settings.right";
}

std::string title_of(std::size_t pane, PaneDevice device) {
  constexpr std::array<const char*, 4> kTitles{"off", "CPU", "GPU", "rasteriser"};
  return fmt::format("{} pane: {}", pane == 0 ? "Left" : "Right",
                     kTitles.at(static_cast<std::size_t>(device)));
}

bool trivial(const View& view) {
  return view.scene.info && view.scene.info->triangles <= kTinyScene;
}

void draw_source(const std::string& prefix, PaneSettings& pane) {
  if (value_choice_row({prefix + ".device", "Device", "Who draws this pane's picture."},
                       pane.device, kDevices) &&
      !traces(pane.device) && pane.content == PaneContent::heatmap) {
    pane.content = PaneContent::picture;
  }
  if (pane.device == PaneDevice::off) return;
  std::vector<ValueChoice<PaneContent>> contents;
  for (const auto& content : kContents) {
    if (content.value != PaneContent::heatmap || traces(pane.device)) contents.push_back(content);
  }
  value_choice_row({prefix + ".content", "Shows", "What is shown of it."}, pane.content, contents);
}

void draw_kind(const std::string& prefix, const View& view, PaneSettings& pane) {
  std::vector<ValueChoice<StructureKind>> kinds;
  for (const auto& kind : kKinds) {
    const bool brute = kind.value == StructureKind::brute;
    if (!brute || trivial(view) || pane.structure.kind == StructureKind::brute) {
      kinds.push_back(kind);
    }
  }
  StructureKind kind = pane.structure.kind;
  if (!value_choice_row({prefix + ".kind", "Structure",
                         "The acceleration structure that this pane's rays go through."},
                        kind, kinds)) {
    return;
  }
  // Kinds that have the same parameters keep them.
  const accel::StructureSpec usual = accel::default_spec(kind);
  pane.structure.kind = kind;
  if (pane.structure.settings.index() != usual.settings.index()) {
    pane.structure.settings = usual.settings;
  }
}

void draw_policy(const std::string& prefix, PaneSettings& pane) {
  const bool refits = can_refit(pane.structure.kind);
  std::vector<ValueChoice<Policy>> policies;
  for (const auto& policy : kPolicies) {
    const bool updates = policy.value == Policy::refit || policy.value == Policy::automatic;
    if (!updates || refits) policies.push_back(policy);
  }
  // A policy that this structure cannot follow builds, and comes back with one that can.
  Policy shown = pane.policy;
  if (!refits && shown != Policy::fixed) shown = Policy::rebuild;
  if (value_choice_row({prefix + ".policy", "Policy",
                        "What a moving scene does to the structure before each frame."},
                       shown, policies)) {
    pane.policy = shown;
  }
}

void draw_structure(const std::string& prefix, const ColumnContext& context, PaneSettings& pane) {
  const bool moves = scene_moves(context.view, context.state);
  draw_kind(prefix, context.view, pane);
  const bool brute = pane.structure.kind == StructureKind::brute;
  if (moves && !brute) draw_policy(prefix, pane);
  if (moves && pane.device == PaneDevice::gpu &&
      accel::device_can_build(pane.structure, pane.policy)) {
    value_choice_row({prefix + ".build_on", "Built on",
                      "Where the tree of each frame is built. Whoever looks at its nodes (the "
                      "right column, the overlay, a picked ray) gets one of the CPU's meanwhile; "
                      "measure mode keeps to what is set here."},
                     pane.build_on, kBuildPlaces);
  }
  draw_structure_parameters(prefix.c_str(), pane, moves);
  value_choice_row({prefix + ".intersection", "Intersection",
                    "By which arithmetic a ray is held against a triangle; the same on every "
                    "device. Costs time a test, but no build: the structure stays as it is."},
                   pane.structure.intersection, kIntersections);
  if (brute) return;
  if (pane.device == PaneDevice::cpu) {
    value_choice_row({prefix + ".grouping", "Rays go",
                      "Whether neighbouring rays of a picture share the structure's steps. Takes "
                      "effect at once; heat maps always count single rays."},
                     pane.structure.grouping, kGroupings);
  }
  value_choice_row({prefix + ".memory", "Memory",
                    "Where a build's memory comes from. Requests to the allocator cost time and, "
                    "the thesis asks, energy."},
                   pane.structure.memory, kMemory);
}

void draw_size(const std::string& prefix, const PaneView& shown, PaneSettings& pane) {
  value_choice_row(
      {prefix + ".size", "Resolution",
       fmt::format(
           "Pixels of the picture, and so rays from the eye a frame.{}",
           shown.width > 0 ? " Now " + size_text(shown.width, shown.height) + "." : std::string())},
      pane.size, kSizes);
  if (pane.size != SizeChoice::custom) return;
  const auto side = [&](const char* name, const char* label, int& value) {
    number_row(NumberRow<int>{.row = {prefix + name, label,
                                      "Pixels, 1 to 16,384; taken with Enter or on leaving."},
                              .low = 1,
                              .high = kLargestSide,
                              .typed = true},
               value);
  };
  side(".width", "Width", pane.custom_width);
  side(".height", "Height", pane.custom_height);
}

void draw_threads(const std::string& prefix, PaneSettings& pane) {
  const int all = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const std::string zero = fmt::format("all {}", all);
  number_row(NumberRow<int>{.row = {prefix + ".threads", "Threads",
                                    fmt::format("Of the CPU that trace at once; 0: all {} that "
                                                "this machine has.",
                                                all)},
                            .high = std::max(all, pane.threads),
                            .usual = 0,
                            .zero = zero.c_str()},
             pane.threads);
}

void draw_work(const std::string& prefix, const ColumnContext& context, std::size_t pane) {
  const PaneView& shown = context.view.panes.at(pane);
  if (shown.work.active) {
    if (progress_row(prefix + ".work", shown.work)) context.commands.push_back(CancelWork{pane});
  }
  problem_line(shown.problem);
  if (!shown.device.empty()) {
    figure_row({prefix + ".runs_on", "Runs on", "What draws this picture, as its driver names it."},
               shown.device);
  }
  if (context.view.scene.scene && traces(context.state.settings.panes.at(pane).device)) {
    if (text_button({prefix + ".rebuild", "Build again",
                     "Builds though nothing changed, or goes on after a cancel."})) {
      context.commands.push_back(Rebuild{pane});
    }
  }
}

}  // namespace

void draw_pane_section(const ColumnContext& context, std::size_t pane) {
  const std::string prefix = prefix_of(pane);
  PaneSettings& settings = context.state.settings.panes.at(pane);
  if (!section(prefix, title_of(pane, settings.device),
               "Who draws this picture, through which structure, and how large.")) {
    return;
  }
  draw_source(prefix, settings);
  if (settings.device == PaneDevice::off) return;
  if (traces(settings.device)) draw_structure(prefix, context, settings);
  draw_size(prefix, context.view.panes.at(pane), settings);
  if (settings.device == PaneDevice::cpu) draw_threads(prefix, settings);
  draw_work(prefix, context, pane);
}

void draw_copy_structure(const ColumnContext& context) {
  PaneSettings& left = context.state.settings.panes[0];
  PaneSettings& right = context.state.settings.panes[1];
  if (!traces(left.device) || !traces(right.device)) return;
  if (left.structure == right.structure && left.policy == right.policy) return;
  if (!section("settings.copy", "Same structure in both panes",
               "So that only the devices differ, or only the structures.")) {
    return;
  }
  const auto copy = [](const PaneSettings& from, PaneSettings& to) {
    to.structure = from.structure;
    to.policy = from.policy;
  };
  if (text_button({"settings.copy.to_right", "Left to right",
                   "The right pane takes the left one's structure, parameters and policy."})) {
    copy(left, right);
  }
  if (text_button_beside({"settings.copy.to_left", "Right to left",
                          "The left pane takes the right one's structure, parameters and "
                          "policy."})) {
    copy(right, left);
  }
  if (text_button_beside({"settings.copy.swap", "Swap",
                          "Each pane takes the other's structure, parameters and policy."})) {
    std::swap(left.structure, right.structure);
    std::swap(left.policy, right.policy);
  }
}

}  // namespace encore::ui
