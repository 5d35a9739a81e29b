#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace encore::accel {

/// Every acceleration structure of the program, by the name that the command line takes.
enum class StructureKind { brute, grid_exact, grid_box, kd_median, kd_sah, bvh_median, bvh_sah };

/// What a moving scene does to the structure each frame.
enum class Policy {
  rebuild,  ///< build afresh (thesis: BV-F)
  refit,    ///< keep the topology, fit the bounds (thesis: BV-U); structures that cannot, rebuild
  fixed,    ///< "static": nothing, whatever the scene does
  /// "auto": refit while the structure is good, rebuild when it has decayed (update_policy.h)
  automatic,
};

/// What Policy::automatic goes by (auto_policy.h).
enum class AutoRule {
  /// Rebuild when it pays back, by what building, updating and tracing were measured to cost. Other
  /// machines, and other runs, rebuild at other frames. The default.
  cost,
  /// Rebuild when the SAH cost has grown to BvhSettings::rebuild_at: the same frames on every
  /// machine and run.
  quality,
};

/// By which arithmetic a ray is held against a triangle (triangle_tester.h). All three are the same
/// in every structure and on every device.
enum class IntersectionMode {
  /// In double precision wherever single precision leaves a doubt; the definition of a hit that the
  /// others are measured by. The default.
  precise,
  /// Möller and Trumbore (1997) in single precision: what most tracers of their day used. Loses
  /// hits on edges, and more of them the farther away or the thinner the triangle.
  moller_trumbore,
  /// Woop, Benthin and Wald (2013) in single precision: no ray slips between two triangles that
  /// share an edge.
  watertight,
};

/// Where a build's memory comes from.
enum class MemoryMode {
  fresh,  ///< "malloc": every build allocates afresh and frees what the last one held
  pool,   ///< every build reuses what the last one allocated (the thesis' emulated pool)
};

/// Emulated updates of thesis 5.1.1: which leaves a refit treats as changed.
enum class UpdateCase {
  real,     ///< those whose triangles' bounds differ from the stored ones
  best,     ///< none: every leaf is checked, nothing is written
  average,  ///< a seeded random 60 % of the leaves
  worst,    ///< all
};

/// How much a build of bvh-sah spends on its tree.
enum class BuildPreset {
  fast,      ///< Morton codes: for scenes that are rebuilt every frame
  balanced,  ///< binned surface area heuristic (Wald 2007)
  best,      ///< the same with long triangles split (spatial splits) and the tree optimised after
};

/// Whether rays that go through the structure side by side share its steps.
enum class RayGrouping {
  packets,  ///< neighbouring rays of a picture go together wherever the structure can
  single,   ///< one ray after the other, as in the thesis
};

struct GridSettings {
  /// Cells along each axis; 0 chooses the thesis' round(cbrt(#T)). More cells: fewer triangle tests
  /// a ray, but more steps and memory (the cube of it).
  int cells_per_axis = 0;
  /// Factor on the automatic choice (1 = thesis).
  float density = 1.0F;
  /// Where the boxes of the triangles touch more than 2^22 + this many cells a triangle, the grid
  /// is made coarser until they no longer do. Real scenes have a few; long triangles across fine
  /// cells would fill the memory otherwise.
  int most_references = 32;

  friend bool operator==(const GridSettings&, const GridSettings&) = default;
};

struct KdTreeSettings {
  enum class DepthLogarithm { natural, base2 };
  /// Depth limit = depth_offset + depth_factor * log(#T). Too small: huge leaves. Too large:
  /// duplicated references and memory.
  float depth_offset = 11.0F;
  float depth_factor = 1.3F;
  DepthLogarithm depth_logarithm = DepthLogarithm::natural;
  /// A node of at most this many triangles becomes a leaf; 0 chooses the thesis' 10, or 2 for
  /// scenes under 5,000 triangles.
  int leaf_triangles = 0;
  /// After this many bad splits on the way down a node becomes a leaf.
  int bad_split_retries = 5;
  /// A split that leaves a child at most this many triangles fewer than its parent is bad.
  int bad_split_margin = 3;
  /// SAH only: cost of one traversal step and of one triangle test (PBRT 2004: 1 and 80), and how
  /// much an empty child is worth (0 = nothing).
  float traversal_cost = 1.0F;
  float intersection_cost = 80.0F;
  float empty_bonus = 0.5F;
  /// No more than 65,536 + this many references a triangle; and as many nodes. Where that is not
  /// enough the tree is built anew with each node's share of it fixed by its triangles.
  int most_references = 16;

  friend bool operator==(const KdTreeSettings&, const KdTreeSettings&) = default;
};

struct BvhSettings {
  /// bvh-sah only.
  BuildPreset preset = BuildPreset::balanced;
  /// bvh-median only.
  UpdateCase update_case = UpdateCase::real;
  /// Seed of UpdateCase::average.
  std::uint64_t seed = 1;
  /// "auto": what Policy::automatic goes by.
  AutoRule auto_rule = AutoRule::cost;
  /// AutoRule::quality, and AutoRule::cost until costs are known: rebuild when the SAH cost has
  /// grown to this multiple of what it was after the last build. Near 1: almost every frame.
  /// Large: never.
  float rebuild_at = 1.25F;

  friend bool operator==(const BvhSettings&, const BvhSettings&) = default;
};

struct BruteSettings {
  friend bool operator==(const BruteSettings&, const BruteSettings&) = default;
};

using StructureSettings = std::variant<BruteSettings, GridSettings, KdTreeSettings, BvhSettings>;

/// Everything that make_structure needs.
struct StructureSpec {
  StructureKind kind = StructureKind::bvh_median;
  StructureSettings settings = BvhSettings{};
  MemoryMode memory = MemoryMode::pool;
  IntersectionMode intersection = IntersectionMode::precise;
  RayGrouping grouping = RayGrouping::packets;

  friend bool operator==(const StructureSpec&, const StructureSpec&) = default;
};

/// The names, exactly as the command line, files and tables use them.
std::string_view to_string(StructureKind kind);
std::string_view to_string(Policy policy);
std::string_view to_string(MemoryMode mode);
std::string_view to_string(UpdateCase update_case);
std::string_view to_string(AutoRule rule);
std::string_view to_string(BuildPreset preset);
std::string_view to_string(RayGrouping grouping);
std::string_view to_string(IntersectionMode mode);
std::optional<StructureKind> parse_structure_kind(std::string_view name);
std::optional<Policy> parse_policy(std::string_view name);
std::optional<MemoryMode> parse_memory_mode(std::string_view name);
std::optional<UpdateCase> parse_update_case(std::string_view name);
std::optional<AutoRule> parse_auto_rule(std::string_view name);
std::optional<BuildPreset> parse_build_preset(std::string_view name);
std::optional<RayGrouping> parse_ray_grouping(std::string_view name);
/// What these settings say of Policy::automatic; the default for kinds that have no such setting.
AutoRule auto_rule(const StructureSettings& settings);
std::optional<IntersectionMode> parse_intersection_mode(std::string_view name);
const std::vector<IntersectionMode>& all_intersection_modes();
/// All policies, in the order of the documentation.
const std::vector<Policy>& all_policies();
const std::vector<StructureKind>& all_structure_kinds();

/// A spec with the documented defaults of that kind.
StructureSpec default_spec(StructureKind kind);

/// The dotted names that apply_setting knows.
const std::vector<std::string_view>& setting_keys();

/// Sets one setting by its dotted name ("grid.cells_per_axis", "kd.leaf_triangles", …). Returns an
/// empty string if it was applied or belongs to another kind, else what is wrong with it.
std::string apply_setting(StructureSpec& spec, std::string_view key, std::string_view value);

}  // namespace encore::accel
