#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace encore::accel {

/// Every acceleration structure of the program, by the name that the command line takes.
enum class StructureKind { brute, grid_exact, grid_box, kd_median, kd_sah, bvh_median };

/// What a moving scene does to the structure each frame.
enum class Policy {
  rebuild,  ///< build afresh (thesis: BV-F)
  refit,    ///< keep the topology, fit the bounds (thesis: BV-U); structures that cannot, rebuild
  fixed,    ///< "static": nothing, whatever the scene does
  /// "auto": refit while the structure is good, rebuild when it has decayed (update_policy.h)
  automatic,
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

struct GridSettings {
  /// Cells along each axis; 0 chooses the thesis' round(cbrt(#T)). More cells: fewer triangle tests
  /// a ray, but more steps and memory (the cube of it).
  int cells_per_axis = 0;
  /// Factor on the automatic choice (1 = thesis).
  float density = 1.0F;

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

  friend bool operator==(const KdTreeSettings&, const KdTreeSettings&) = default;
};

struct BvhSettings {
  UpdateCase update_case = UpdateCase::real;
  /// Seed of UpdateCase::average.
  std::uint64_t seed = 1;
  /// Policy::automatic: rebuild when the SAH cost has grown to this multiple of what it was after
  /// the last build. Near 1: almost every frame. Large: never.
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

  friend bool operator==(const StructureSpec&, const StructureSpec&) = default;
};

/// The names, exactly as the command line, files and tables use them.
std::string_view to_string(StructureKind kind);
std::string_view to_string(Policy policy);
std::string_view to_string(MemoryMode mode);
std::string_view to_string(UpdateCase update_case);
std::optional<StructureKind> parse_structure_kind(std::string_view name);
std::optional<Policy> parse_policy(std::string_view name);
std::optional<MemoryMode> parse_memory_mode(std::string_view name);
std::optional<UpdateCase> parse_update_case(std::string_view name);
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
