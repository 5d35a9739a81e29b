// Names and settings: every documented key takes, every wrong one says so.
#include "accel/settings.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace encore::accel {
namespace {

TEST(Settings, NamesRoundTrip) {
  for (const StructureKind kind : all_structure_kinds()) {
    EXPECT_EQ(parse_structure_kind(to_string(kind)), kind);
  }
  EXPECT_EQ(all_policies().size(), 4U);
  for (const Policy policy : all_policies()) {
    EXPECT_EQ(parse_policy(to_string(policy)), policy);
  }
  EXPECT_FALSE(parse_structure_kind("grid").has_value());
  EXPECT_EQ(parse_policy("auto"), Policy::automatic);
  EXPECT_FALSE(parse_policy("").has_value());
}

TEST(Settings, PresetsAndGroupingsRoundTrip) {
  for (const BuildPreset preset : {BuildPreset::fast, BuildPreset::balanced, BuildPreset::best}) {
    EXPECT_EQ(parse_build_preset(to_string(preset)), preset);
    StructureSpec spec = default_spec(StructureKind::bvh_sah);
    EXPECT_EQ(apply_setting(spec, "bvh.preset", to_string(preset)), "");
    EXPECT_EQ(std::get<BvhSettings>(spec.settings).preset, preset);
  }
  for (const RayGrouping grouping : {RayGrouping::packets, RayGrouping::single}) {
    EXPECT_EQ(parse_ray_grouping(to_string(grouping)), grouping);
  }
  EXPECT_FALSE(parse_build_preset("slow").has_value());
  EXPECT_FALSE(parse_ray_grouping("").has_value());
}

TEST(Settings, DefaultsAreTheThesis) {
  const auto kd = std::get<KdTreeSettings>(default_spec(StructureKind::kd_sah).settings);
  EXPECT_EQ(kd.depth_offset, 11.0F);
  EXPECT_EQ(kd.depth_factor, 1.3F);
  EXPECT_EQ(kd.depth_logarithm, KdTreeSettings::DepthLogarithm::natural);
  EXPECT_EQ(kd.bad_split_retries, 5);
  EXPECT_EQ(kd.bad_split_margin, 3);
}

TEST(Settings, EveryListedKeyIsKnownAndRejectsNonsense) {
  for (const StructureKind kind : all_structure_kinds()) {
    for (const std::string_view key : setting_keys()) {
      StructureSpec spec = default_spec(kind);
      const std::string problem = apply_setting(spec, key, "nonsense");
      EXPECT_NE(problem.find("nonsense"), std::string::npos) << key << ": " << problem;
      EXPECT_EQ(problem.find("unknown"), std::string::npos) << key;
    }
  }
}

TEST(Settings, ValuesArriveAndAreBounded) {
  StructureSpec spec = default_spec(StructureKind::grid_box);
  EXPECT_EQ(apply_setting(spec, "grid.cells_per_axis", "64"), "");
  EXPECT_EQ(std::get<GridSettings>(spec.settings).cells_per_axis, 64);
  EXPECT_NE(apply_setting(spec, "grid.cells_per_axis", "-1"), "");
  EXPECT_NE(apply_setting(spec, "grid.density", "nan"), "");
  EXPECT_NE(apply_setting(spec, "grid.cells_per_axis", "64 "), "");
  EXPECT_EQ(std::get<GridSettings>(spec.settings).cells_per_axis, 64);
  // Another kind's setting is checked but changes nothing here.
  EXPECT_EQ(apply_setting(spec, "kd.leaf_triangles", "4"), "");
  EXPECT_NE(apply_setting(spec, "kd.leaf_triangles", "four"), "");
  EXPECT_NE(apply_setting(spec, "grid.cell_count", "4").find("unknown"), std::string::npos);
}

TEST(Settings, AutoRebuildsAtAMultipleAboveOne) {
  StructureSpec spec = default_spec(StructureKind::bvh_median);
  EXPECT_EQ(std::get<BvhSettings>(spec.settings).rebuild_at, 1.25F);
  EXPECT_EQ(apply_setting(spec, "bvh.rebuild_at", "1.5"), "");
  EXPECT_EQ(std::get<BvhSettings>(spec.settings).rebuild_at, 1.5F);
  for (const char* wrong : {"1", "0.9", "nan", "-2"}) {
    EXPECT_NE(apply_setting(spec, "bvh.rebuild_at", wrong), "") << wrong;
  }
  EXPECT_EQ(std::get<BvhSettings>(spec.settings).rebuild_at, 1.5F);
}

TEST(Settings, AutoGoesByCostOrByQuality) {
  StructureSpec spec = default_spec(StructureKind::bvh_median);
  EXPECT_EQ(auto_rule(spec.settings), AutoRule::cost);
  EXPECT_EQ(apply_setting(spec, "bvh.auto", "quality"), "");
  EXPECT_EQ(auto_rule(spec.settings), AutoRule::quality);
  for (const char* wrong : {"", "Cost", "speed", "1"}) {
    const std::string message = apply_setting(spec, "bvh.auto", wrong);
    EXPECT_NE(message.find("bvh.auto"), std::string::npos) << wrong;
    EXPECT_NE(message.find("cost or quality"), std::string::npos) << wrong;
  }
  EXPECT_EQ(auto_rule(spec.settings), AutoRule::quality) << "what is wrong changes nothing";
  EXPECT_EQ(apply_setting(spec, "bvh.auto", "cost"), "");
  EXPECT_EQ(auto_rule(spec.settings), AutoRule::cost);
  for (const AutoRule rule : {AutoRule::cost, AutoRule::quality}) {
    EXPECT_EQ(parse_auto_rule(to_string(rule)), rule);
  }
}

TEST(Settings, TheDocumentationNamesEveryKey) {
  std::ifstream in(ENCORE_SOURCE_DIR "/docs/settings.md");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const std::string_view key : setting_keys()) {
    EXPECT_NE(text.find("| `" + std::string(key) + "` |"), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace encore::accel
