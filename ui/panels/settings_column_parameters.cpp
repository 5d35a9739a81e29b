#include "ui/panels/settings_column.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <string>
#include <variant>

namespace encore::ui {

namespace {

using accel::BvhSettings;
using accel::GridSettings;
using accel::KdTreeSettings;
using accel::Policy;
using accel::UpdateCase;
using Logarithm = KdTreeSettings::DepthLogarithm;

constexpr std::array<ValueChoice<Logarithm>, 2> kLogarithms{{
    {Logarithm::natural, "natural", "as the thesis' authors' own code has it"},
    {Logarithm::base2, "base 2", "as PBRT has it; gives deeper trees"},
}};

constexpr std::array<ValueChoice<accel::AutoRule>, 2> kRules{{
    {accel::AutoRule::cost, "cost",
     "builds where building, updating and tracing were seen to cost less that way"},
    {accel::AutoRule::quality, "quality",
     "builds where the SAH cost has grown so far: at the same frames on every machine"},
}};

constexpr std::array<ValueChoice<accel::BuildPreset>, 3> kPresets{{
    {accel::BuildPreset::fast, "fast", "along Morton codes: for scenes that are built every frame"},
    {accel::BuildPreset::balanced, "balanced", "binned surface area heuristic"},
    {accel::BuildPreset::best, "best",
     "the same with long triangles split, and optimised afterwards: dear to build, cheap to trace"},
}};

constexpr std::array<ValueChoice<UpdateCase>, 4> kCases{{
    {UpdateCase::real, "real", "those whose triangles moved"},
    {UpdateCase::best, "best", "none: every leaf is checked, nothing is written"},
    {UpdateCase::average, "average", "60 % of the leaves, drawn at random from the seed"},
    {UpdateCase::worst, "worst", "all leaves (thesis: BV-U)"},
}};

void draw_grid(const std::string& prefix, GridSettings& grid) {
  const GridSettings usual;
  number_row(NumberRow<int>{.row = {prefix + ".grid.cells_per_axis", "Cells an axis",
                                    "0: automatic, the thesis' round(cbrt(triangles)). More: fewer "
                                    "triangle tests a ray, but more steps, and memory with the "
                                    "cube. Fewer: quick steps, but many triangles in a cell. "
                                    "0 to 1024."},
                            .high = 1024,
                            .usual = usual.cells_per_axis,
                            .most_slid = 256,
                            .zero = "automatic"},
             grid.cells_per_axis);
  number_row(NumberRow<int>{.row = {prefix + ".grid.most_references", "Most references",
                                    "References a triangle, over 4,194,304 in all, at which the "
                                    "grid is made coarser. Too small: a coarse grid and many "
                                    "tests a ray. Too large: long triangles across fine cells fill "
                                    "the memory. 1 to 1,024."},
                            .low = 1,
                            .high = 1024,
                            .usual = usual.most_references,
                            .logarithmic = true},
             grid.most_references);
  if (grid.cells_per_axis != 0) return;
  number_row(NumberRow<float>{.row = {prefix + ".grid.density", "Density",
                                      "Factor on the automatic number of cells an axis. Below 1: "
                                      "fewer, fuller cells; above: more steps and, with the cube, "
                                      "memory. 0.01 to 16."},
                              .low = 0.01F,
                              .high = 16.0F,
                              .usual = usual.density,
                              .logarithmic = true},
             grid.density);
}

void draw_kd_depth(const std::string& prefix, KdTreeSettings& kd) {
  const KdTreeSettings usual;
  number_row(NumberRow<float>{.row = {prefix + ".kd.depth_offset", "Depth offset",
                                      "Depth limit = offset + factor · log(triangles). Too small: "
                                      "huge leaves. Too large: duplicated references and memory. "
                                      "0 to 60."},
                              .high = 60.0F,
                              .usual = usual.depth_offset},
             kd.depth_offset);
  number_row(NumberRow<float>{.row = {prefix + ".kd.depth_factor", "Depth factor",
                                      "Of the logarithm in the depth limit. Too small: huge leaves "
                                      "in large scenes. Too large: duplicated references and "
                                      "memory. 0 to 4."},
                              .high = 4.0F,
                              .usual = usual.depth_factor},
             kd.depth_factor);
  value_choice_row({prefix + ".kd.depth_logarithm", "Logarithm", "Of the depth limit."},
                   kd.depth_logarithm, kLogarithms);
}

void draw_kd_leaves(const std::string& prefix, KdTreeSettings& kd) {
  const KdTreeSettings usual;
  number_row(NumberRow<int>{.row = {prefix + ".kd.leaf_triangles", "Leaf size",
                                    "A node of at most so many triangles becomes a leaf; 0: "
                                    "automatic, 10, or 2 for scenes under 5,000 triangles. Too "
                                    "large: many tests a leaf. Too small: a deep tree that costs "
                                    "memory and steps. 0 to 1,048,576."},
                            .high = 1 << 20,
                            .usual = usual.leaf_triangles,
                            .most_slid = 128,
                            .zero = "automatic"},
             kd.leaf_triangles);
  number_row(NumberRow<int>{.row = {prefix + ".kd.bad_split_retries", "Bad splits",
                                    "After so many bad splits on the way down a node becomes a "
                                    "leaf. Too few: the tree ends early, with large leaves. Too "
                                    "many: nodes that divide nothing. 0 to 60."},
                            .high = 60,
                            .usual = usual.bad_split_retries},
             kd.bad_split_retries);
  number_row(NumberRow<int>{.row = {prefix + ".kd.bad_split_margin", "Split margin",
                                    "A split that leaves a child at most so many triangles fewer "
                                    "than its parent is bad. Too large: good splits count as bad, "
                                    "and the tree ends early. Too small: useless splits pass. "
                                    "0 to 1,048,576."},
                            .high = 1 << 20,
                            .usual = usual.bad_split_margin,
                            .most_slid = 64},
             kd.bad_split_margin);
}

void draw_kd_memory(const std::string& prefix, KdTreeSettings& kd) {
  const KdTreeSettings usual;
  number_row(NumberRow<int>{.row = {prefix + ".kd.most_references", "Most references",
                                    "References a triangle, over 65,536 in all, and as many nodes, "
                                    "at which the tree is ended earlier. Too small: large leaves. "
                                    "Too large: triangles across many splits fill the memory. "
                                    "2 to 1,024."},
                            .low = 2,
                            .high = 1024,
                            .usual = usual.most_references,
                            .logarithmic = true},
             kd.most_references);
}

void draw_kd_sah(const std::string& prefix, KdTreeSettings& kd) {
  const KdTreeSettings usual;
  const auto cost = [&](const char* name, const char* label, const char* tip, float& value,
                        float standard) {
    number_row(NumberRow<float>{.row = {prefix + name, label, tip},
                                .low = 0.001F,
                                .high = 1e6F,
                                .usual = standard,
                                .logarithmic = true,
                                .most_slid = 1000.0F},
               value);
  };
  cost(".kd.traversal_cost", "Step cost",
       "What the heuristic takes a traversal step to cost; only its ratio to the test cost counts. "
       "Too large: splits seem dear, leaves stay large. Too small: a deep tree. 0.001 to 1,000,000 "
       "(Pharr and Humphreys 2004: 1).",
       kd.traversal_cost, usual.traversal_cost);
  cost(".kd.intersection_cost", "Test cost",
       "What the heuristic takes a triangle test to cost. Too large: a deep tree of small leaves. "
       "Too small: large leaves. 0.001 to 1,000,000 (Pharr and Humphreys 2004: 80).",
       kd.intersection_cost, usual.intersection_cost);
  number_row(NumberRow<float>{.row = {prefix + ".kd.empty_bonus", "Empty bonus",
                                      "How much an empty child is worth: 0 nothing. Too large: "
                                      "cuts off empty space even where that divides nothing else. "
                                      "0 to 0.99."},
                              .high = 0.99F,
                              .usual = usual.empty_bonus},
             kd.empty_bonus);
}

/// 64 bits are more than a slider's.
void draw_seed(const std::string& prefix, BvhSettings& bvh) {
  const Row row{prefix + ".bvh.seed", "Seed",
                "Which leaves `average` treats as changed; the same seed gives the same leaves. "
                "Any whole number, taken with Enter."};
  begin_row(row, reset_width() + ImGui::GetStyle().ItemInnerSpacing.x);
  std::uint64_t typed = bvh.seed;
  const bool entered = ImGui::InputScalar("##seed", ImGuiDataType_U64, &typed, nullptr, nullptr,
                                          nullptr, ImGuiInputTextFlags_EnterReturnsTrue);
  if (entered) bvh.seed = typed;
  end_row(row, fmt::format("{}", bvh.seed));
  const BvhSettings usual;
  if (bvh.seed == usual.seed) return;
  ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
  if (reset_button(row.name + ".reset", fmt::format("{}", usual.seed))) bvh.seed = usual.seed;
}

void draw_update_case(const std::string& prefix, BvhSettings& bvh) {
  value_choice_row({prefix + ".bvh.update_case", "Update case",
                    "Which leaves a refit treats as changed: the real ones, or the thesis' "
                    "emulation (5.1.1) over a scene that stands still."},
                   bvh.update_case, kCases);
  if (bvh.update_case == UpdateCase::average) draw_seed(prefix, bvh);
}

void draw_preset(const std::string& prefix, BvhSettings& bvh) {
  value_choice_row({prefix + ".bvh.preset", "Preset", "How much a build spends on its tree."},
                   bvh.preset, kPresets);
}

void draw_bvh(const std::string& prefix, BvhSettings& bvh, accel::StructureKind kind,
              Policy policy) {
  const BvhSettings usual;
  if (kind == accel::StructureKind::bvh_median) draw_update_case(prefix, bvh);
  if (policy != Policy::automatic) return;
  value_choice_row({prefix + ".bvh.auto_rule", "Rule", "By what policy auto decides to build."},
                   bvh.auto_rule, kRules);
  number_row(NumberRow<float>{.row = {prefix + ".bvh.rebuild_at", "Rebuild at",
                                      "Builds when the tree's SAH cost has grown to this multiple "
                                      "of what it was after the last build; under rule cost only "
                                      "until costs are known. Near 1: almost every "
                                      "frame. Large: never, and rays get dearer. 1.001 to "
                                      "1,000,000."},
                              .low = 1.001F,
                              .high = 1e6F,
                              .format = "%.4g ×",
                              .usual = usual.rebuild_at,
                              .logarithmic = true,
                              .most_slid = 10.0F},
             bvh.rebuild_at);
}

}  // namespace

void draw_structure_parameters(const char* prefix, PaneSettings& pane, bool moves) {
  accel::StructureSpec& spec = pane.structure;
  const bool refits = moves && can_refit(spec.kind) &&
                      (pane.policy == Policy::refit || pane.policy == Policy::automatic);
  // The parameters of a hierarchy split in the middle are all about refits.
  const bool preset = spec.kind == accel::StructureKind::bvh_sah;
  if (std::holds_alternative<accel::BruteSettings>(spec.settings)) return;
  if (std::holds_alternative<BvhSettings>(spec.settings) && !refits && !preset) return;
  const bool usual = spec.settings == accel::default_spec(spec.kind).settings;
  const std::string name = std::string(prefix) + ".parameters";
  if (!begin_group(name, usual ? "Parameters" : "Parameters (changed)",
                   "Of this structure. They take effect when the mouse lets go; Ctrl and a click "
                   "type a number. A round arrow brings the usual value back.",
                   true)) {
    return;
  }
  if (auto* grid = std::get_if<GridSettings>(&spec.settings)) draw_grid(prefix, *grid);
  if (auto* kd = std::get_if<KdTreeSettings>(&spec.settings)) {
    draw_kd_depth(prefix, *kd);
    draw_kd_leaves(prefix, *kd);
    draw_kd_memory(prefix, *kd);
    if (spec.kind == accel::StructureKind::kd_sah) draw_kd_sah(prefix, *kd);
  }
  if (auto* bvh = std::get_if<BvhSettings>(&spec.settings)) {
    if (preset) draw_preset(prefix, *bvh);
    if (refits) draw_bvh(prefix, *bvh, spec.kind, pane.policy);
  }
  ImGui::TreePop();
}

}  // namespace encore::ui
