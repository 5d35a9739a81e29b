#include "accel/settings.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

namespace encore::accel {

namespace {

template <class Enum, std::size_t N>
using Names = std::array<std::pair<Enum, std::string_view>, N>;

constexpr Names<StructureKind, 7> kStructures{{{StructureKind::brute, "brute"},
                                               {StructureKind::grid_exact, "grid-exact"},
                                               {StructureKind::grid_box, "grid-box"},
                                               {StructureKind::kd_median, "kd-median"},
                                               {StructureKind::kd_sah, "kd-sah"},
                                               {StructureKind::bvh_median, "bvh-median"},
                                               {StructureKind::bvh_sah, "bvh-sah"}}};
constexpr Names<Policy, 4> kPolicies{{{Policy::rebuild, "rebuild"},
                                      {Policy::refit, "refit"},
                                      {Policy::automatic, "auto"},
                                      {Policy::fixed, "static"}}};
constexpr Names<MemoryMode, 2> kMemoryModes{
    {{MemoryMode::fresh, "malloc"}, {MemoryMode::pool, "pool"}}};
constexpr Names<UpdateCase, 4> kUpdateCases{{{UpdateCase::real, "real"},
                                             {UpdateCase::best, "best"},
                                             {UpdateCase::average, "average"},
                                             {UpdateCase::worst, "worst"}}};
constexpr Names<AutoRule, 2> kAutoRules{{{AutoRule::cost, "cost"}, {AutoRule::quality, "quality"}}};

constexpr Names<BuildPreset, 3> kPresets{{{BuildPreset::fast, "fast"},
                                          {BuildPreset::balanced, "balanced"},
                                          {BuildPreset::best, "best"}}};
constexpr Names<RayGrouping, 2> kGroupings{
    {{RayGrouping::packets, "packets"}, {RayGrouping::single, "single"}}};

constexpr Names<IntersectionMode, 3> kIntersectionModes{
    {{IntersectionMode::precise, "precise"},
     {IntersectionMode::moller_trumbore, "moller-trumbore"},
     {IntersectionMode::watertight, "watertight"}}};

template <class Enum, std::size_t N>
std::string_view name_of(const Names<Enum, N>& names, Enum value) {
  for (const auto& [candidate, name] : names) {
    if (candidate == value) return name;
  }
  return "unknown";
}

template <class Enum, std::size_t N>
std::optional<Enum> value_of(const Names<Enum, N>& names, std::string_view text) {
  for (const auto& [value, name] : names) {
    if (name == text) return value;
  }
  return std::nullopt;
}

/// Parses the whole of `text`; nothing if any of it is left over or out of range.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Assigns a number between the limits (inclusive; NaN fails), or says what is wrong.
template <class Number>
std::string assign(Number& target, std::string_view key, std::string_view text, Number low,
                   Number high) {
  const auto value = parse_number<Number>(text);
  if (!value || !(*value >= low && *value <= high)) {
    return fmt::format("'{}' is not a value for {}; it takes a number from {} to {}", text, key,
                       low, high);
  }
  target = *value;
  return {};
}

std::string apply_grid(GridSettings& grid, std::string_view key, std::string_view value) {
  if (key == "grid.cells_per_axis") return assign(grid.cells_per_axis, key, value, 0, 1024);
  if (key == "grid.density") return assign(grid.density, key, value, 0.01F, 16.0F);
  if (key == "grid.most_references") return assign(grid.most_references, key, value, 1, 1024);
  return fmt::format("unknown setting '{}'", key);
}

std::string apply_kd(KdTreeSettings& kd, std::string_view key, std::string_view value) {
  if (key == "kd.depth_offset") return assign(kd.depth_offset, key, value, 0.0F, 60.0F);
  if (key == "kd.depth_factor") return assign(kd.depth_factor, key, value, 0.0F, 4.0F);
  if (key == "kd.leaf_triangles") return assign(kd.leaf_triangles, key, value, 0, 1 << 20);
  if (key == "kd.bad_split_retries") return assign(kd.bad_split_retries, key, value, 0, 60);
  if (key == "kd.bad_split_margin") return assign(kd.bad_split_margin, key, value, 0, 1 << 20);
  if (key == "kd.traversal_cost") return assign(kd.traversal_cost, key, value, 0.001F, 1e6F);
  if (key == "kd.intersection_cost") return assign(kd.intersection_cost, key, value, 0.001F, 1e6F);
  if (key == "kd.empty_bonus") return assign(kd.empty_bonus, key, value, 0.0F, 0.99F);
  if (key == "kd.most_references") return assign(kd.most_references, key, value, 2, 1024);
  if (key == "kd.depth_logarithm") {
    if (value == "natural") {
      kd.depth_logarithm = KdTreeSettings::DepthLogarithm::natural;
    } else if (value == "base2") {
      kd.depth_logarithm = KdTreeSettings::DepthLogarithm::base2;
    } else {
      return fmt::format("'{}' is not a value for {}; it takes natural or base2", value, key);
    }
    return {};
  }
  return fmt::format("unknown setting '{}'", key);
}

std::string apply_bvh(BvhSettings& bvh, std::string_view key, std::string_view value) {
  if (key == "bvh.update_case") {
    const auto update_case = parse_update_case(value);
    if (!update_case) {
      return fmt::format("'{}' is not a value for {}; it takes real, best, average or worst", value,
                         key);
    }
    bvh.update_case = *update_case;
    return {};
  }
  if (key == "bvh.auto") {
    const auto rule = parse_auto_rule(value);
    if (!rule) {
      return fmt::format("'{}' is not a value for {}; it takes cost or quality", value, key);
    }
    bvh.auto_rule = *rule;
    return {};
  }
  if (key == "bvh.preset") {
    const auto preset = parse_build_preset(value);
    if (!preset) {
      return fmt::format("'{}' is not a value for {}; it takes fast, balanced or best", value, key);
    }
    bvh.preset = *preset;
    return {};
  }
  if (key == "bvh.seed") {
    return assign<std::uint64_t>(bvh.seed, key, value, 0, ~std::uint64_t{0});
  }
  if (key == "bvh.rebuild_at") return assign(bvh.rebuild_at, key, value, 1.001F, 1e6F);
  return fmt::format("unknown setting '{}'", key);
}

}  // namespace

std::string_view to_string(StructureKind kind) {
  return name_of(kStructures, kind);
}
std::string_view to_string(Policy policy) {
  return name_of(kPolicies, policy);
}
std::string_view to_string(MemoryMode mode) {
  return name_of(kMemoryModes, mode);
}
std::string_view to_string(UpdateCase update_case) {
  return name_of(kUpdateCases, update_case);
}
std::string_view to_string(AutoRule rule) {
  return name_of(kAutoRules, rule);
}
std::string_view to_string(BuildPreset preset) {
  return name_of(kPresets, preset);
}
std::string_view to_string(RayGrouping grouping) {
  return name_of(kGroupings, grouping);
}
std::string_view to_string(IntersectionMode mode) {
  return name_of(kIntersectionModes, mode);
}

std::optional<StructureKind> parse_structure_kind(std::string_view name) {
  return value_of(kStructures, name);
}
std::optional<Policy> parse_policy(std::string_view name) {
  return value_of(kPolicies, name);
}
std::optional<MemoryMode> parse_memory_mode(std::string_view name) {
  return value_of(kMemoryModes, name);
}
std::optional<IntersectionMode> parse_intersection_mode(std::string_view name) {
  return value_of(kIntersectionModes, name);
}
const std::vector<IntersectionMode>& all_intersection_modes() {
  static const std::vector<IntersectionMode> kAll = {
      IntersectionMode::precise, IntersectionMode::moller_trumbore, IntersectionMode::watertight};
  return kAll;
}
std::optional<UpdateCase> parse_update_case(std::string_view name) {
  return value_of(kUpdateCases, name);
}
std::optional<AutoRule> parse_auto_rule(std::string_view name) {
  return value_of(kAutoRules, name);
}
std::optional<BuildPreset> parse_build_preset(std::string_view name) {
  return value_of(kPresets, name);
}
std::optional<RayGrouping> parse_ray_grouping(std::string_view name) {
  return value_of(kGroupings, name);
}
AutoRule auto_rule(const StructureSettings& settings) {
  const auto* bvh = std::get_if<BvhSettings>(&settings);
  return bvh != nullptr ? bvh->auto_rule : AutoRule::cost;
}

const std::vector<StructureKind>& all_structure_kinds() {
  static const std::vector<StructureKind> kinds = [] {
    std::vector<StructureKind> all;
    for (const auto& [kind, name] : kStructures) all.push_back(kind);
    return all;
  }();
  return kinds;
}

const std::vector<Policy>& all_policies() {
  static const std::vector<Policy> policies = [] {
    std::vector<Policy> all;
    for (const auto& [policy, name] : kPolicies) all.push_back(policy);
    return all;
  }();
  return policies;
}

const std::vector<std::string_view>& setting_keys() {
  static const std::vector<std::string_view> keys{"grid.cells_per_axis",
                                                  "grid.density",
                                                  "grid.most_references",
                                                  "kd.depth_offset",
                                                  "kd.depth_factor",
                                                  "kd.depth_logarithm",
                                                  "kd.leaf_triangles",
                                                  "kd.bad_split_retries",
                                                  "kd.bad_split_margin",
                                                  "kd.traversal_cost",
                                                  "kd.intersection_cost",
                                                  "kd.empty_bonus",
                                                  "kd.most_references",
                                                  "bvh.update_case",
                                                  "bvh.seed",
                                                  "bvh.rebuild_at",
                                                  "bvh.preset"};
  return keys;
}

StructureSpec default_spec(StructureKind kind) {
  StructureSpec spec{.kind = kind};
  switch (kind) {
    case StructureKind::brute:
      spec.settings = BruteSettings{};
      break;
    case StructureKind::grid_exact:
    case StructureKind::grid_box:
      spec.settings = GridSettings{};
      break;
    case StructureKind::kd_median:
    case StructureKind::kd_sah:
      spec.settings = KdTreeSettings{};
      break;
    case StructureKind::bvh_median:
    case StructureKind::bvh_sah:
      spec.settings = BvhSettings{};
      break;
  }
  return spec;
}

std::string apply_setting(StructureSpec& spec, std::string_view key, std::string_view value) {
  // Settings of other kinds are checked on a scratch copy, so that a wrong value is reported
  // whichever structure happens to be chosen.
  if (key.starts_with("grid.")) {
    GridSettings scratch;
    auto* own = std::get_if<GridSettings>(&spec.settings);
    return apply_grid(own ? *own : scratch, key, value);
  }
  if (key.starts_with("kd.")) {
    KdTreeSettings scratch;
    auto* own = std::get_if<KdTreeSettings>(&spec.settings);
    return apply_kd(own ? *own : scratch, key, value);
  }
  if (key.starts_with("bvh.")) {
    BvhSettings scratch;
    auto* own = std::get_if<BvhSettings>(&spec.settings);
    return apply_bvh(own ? *own : scratch, key, value);
  }
  return fmt::format("unknown setting '{}'", key);
}

}  // namespace encore::accel
