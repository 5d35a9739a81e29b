// Which structures a command line asks for: kinds by modes by groupings, and bvh-sah by presets.
#include "app/common_options.h"
#include "app/workloads.h"
#include "scene/sample_scenes.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace encore::app {
namespace {

using accel::BuildPreset;
using accel::RayGrouping;
using accel::StructureKind;

BuildPreset preset_of(const accel::StructureSpec& spec) {
  return std::get<accel::BvhSettings>(spec.settings).preset;
}

TEST(StructureOptions, PresetsAreOfTheHierarchyThatHasThem) {
  const scene::Scene scene = *scene::make_sample_scene("triangle");
  CommonOptions options;
  options.structures = {"bvh-median", "bvh-sah"};
  options.presets = {"fast", "best", "fast"};
  const auto specs = chosen_structures(options, scene);
  ASSERT_EQ(specs.size(), 3U);
  EXPECT_EQ(specs[0].kind, StructureKind::bvh_median);
  EXPECT_EQ(specs[1].kind, StructureKind::bvh_sah);
  EXPECT_EQ(preset_of(specs[1]), BuildPreset::fast);
  EXPECT_EQ(preset_of(specs[2]), BuildPreset::best);
}

TEST(StructureOptions, ThePresetOfTheSettingsHoldsUnlessOneIsNamed) {
  const scene::Scene scene = *scene::make_sample_scene("triangle");
  CommonOptions options;
  options.structures = {"bvh-sah"};
  options.settings = {"bvh.preset=fast"};
  EXPECT_EQ(preset_of(chosen_structures(options, scene).front()), BuildPreset::fast);
  options.presets = {"best"};
  EXPECT_EQ(preset_of(chosen_structures(options, scene).front()), BuildPreset::best);
}

TEST(StructureOptions, GroupingsMultiplyAllStructures) {
  const scene::Scene scene = *scene::make_sample_scene("triangle");
  CommonOptions options;
  options.structures = {"grid-box", "bvh-sah"};
  EXPECT_EQ(chosen_structures(options, scene).front().grouping, RayGrouping::packets);
  options.groupings = {"single", "packets"};
  const auto specs = chosen_structures(options, scene);
  ASSERT_EQ(specs.size(), 4U);
  EXPECT_EQ(specs[0].grouping, RayGrouping::single);
  EXPECT_EQ(specs[1].grouping, RayGrouping::packets);
}

TEST(StructureOptions, SessionsTellPresetAndGrouping) {
  WorkloadSpec spec;
  spec.scene = std::make_shared<const scene::Scene>(*scene::make_sample_scene("triangle"));
  spec.test = TestKind::fixed;
  spec.structure = accel::default_spec(StructureKind::bvh_sah);
  spec.structure.grouping = RayGrouping::single;
  const auto workload = make_workload(spec, standard_tools());
  const auto value = [&](const std::string& key) {
    for (const energy::KeyValue& part : workload->configuration()) {
      if (part.key == key) return part.value;
    }
    return std::string("none of that name");
  };
  EXPECT_EQ(value("preset"), "balanced");
  EXPECT_EQ(value("grouping"), "single");
  EXPECT_EQ(value("update_case"), "");
}

}  // namespace
}  // namespace encore::app
