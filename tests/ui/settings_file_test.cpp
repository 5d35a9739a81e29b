// What is kept from run to run comes back whole; damage costs only what is damaged.
#include "app/window/settings_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace {

namespace fs = std::filesystem;
using namespace encore;
using app::KeptState;
using app::KeptStateRead;

/// Every field differs from its default.
KeptState unusual() {
  KeptState kept;
  ui::PaneSettings& left = kept.settings.panes[0];
  left.device = ui::PaneDevice::raster;
  left.content = ui::PaneContent::heatmap;
  left.structure = accel::default_spec(accel::StructureKind::kd_sah);
  left.structure.memory = accel::MemoryMode::fresh;
  left.structure.settings = accel::KdTreeSettings{
      9.5F, 1.7F, accel::KdTreeSettings::DepthLogarithm::base2, 7, 6, 5, 2.0F, 44.0F, 0.25F};
  left.policy = accel::Policy::refit;
  left.build_on = accel::BuildPlace::device;
  left.size = ui::SizeChoice::custom;
  left.custom_width = 333;
  left.custom_height = 222;
  left.threads = 3;
  ui::PaneSettings& right = kept.settings.panes[1];
  right.structure.settings =
      accel::BvhSettings{accel::BuildPreset::best, accel::UpdateCase::worst, ~std::uint64_t{0}};
  right.structure.grouping = accel::RayGrouping::single;
  right.structure.intersection = accel::IntersectionMode::watertight;
  kept.settings.rays = {true, true, true, false, 7, 64, 0xFFFFFFFFU};
  kept.settings.overlay = {true,
                           ui::OverlayColor::sah,
                           ui::HiddenLines::x_ray,
                           2,
                           13,
                           false,
                           false,
                           true,
                           4,
                           3.5F,
                           999,
                           false,
                           false,
                           {false, true, false},
                           true,
                           2.25F,
                           0.35F,
                           true,
                           2,
                           0.125F,
                           true,
                           true};
  kept.settings.heatmap = {
      ui::HeatmapCost::box_tests, 1, false, 1.5F, 55.0F, true, 3.0F, 4.0F, 5.0F};
  kept.settings.animation = {true, false, 0.3F};
  kept.settings.measure = {4.5F, 2.25F, true, 0.5F, true};
  kept.settings.energy = {ui::EnergySettings::From::model, "rapl:\"package\"", 11.5F, 33.3F};
  ui::Preferences& p = kept.preferences;
  p.theme = ui::Theme::light;
  p.ui_scale = 1.25F;
  p.layout = {false, false, false, 22.0F, 23.0F, 0.41F, 0.6F, 0.7F};
  p.window_width = 1111;
  p.window_height = 777;
  p.recent_scenes = {"toys", "/a/scene with \"quotes\".toml"};
  p.recent_sessions = {"/s/1"};
  p.last_folder = "/a";
  p.up_axis = 2;
  scene::Camera camera{{1.1F, 2.2F, 3.3F}, {0.1F, 0.2F, 0.3F}, {0.0F, 0.0F, 1.0F}, 55.5F, 0.0F};
  p.bookmarks["toys"][0] = camera;
  camera.orthographic_height = 12.75F;
  p.bookmarks["a.b \"c\""][8] = camera;
  return kept;
}

KeptStateRead read_texts(const std::string& settings, const std::string& state) {
  KeptStateRead read;
  app::read_settings_text(settings, "window.toml", read);
  app::read_state_text(state, "window-state.toml", read);
  return read;
}

TEST(SettingsFile, BringsBackEveryField) {
  const KeptState kept = unusual();
  const KeptStateRead read = read_texts(app::settings_text(kept), app::state_text(kept));
  EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  EXPECT_EQ(read.kept.settings, kept.settings);
  EXPECT_EQ(read.kept.preferences, kept.preferences);
}

TEST(SettingsFile, FilesFromBeforeThereWereRaysMeanPlainOnes) {
  const KeptStateRead read =
      read_texts("[left_pane.structure]\nkind = \"kd-sah\"\n[rays]\nsamples = 0\n", "");
  EXPECT_EQ(read.warnings.size(), 1U);
  EXPECT_EQ(read.kept.settings.rays, scene::RaySettings{});
  EXPECT_EQ(read.kept.settings.panes[0].structure.intersection, accel::IntersectionMode::precise);
}

TEST(SettingsFile, BringsBackEveryStructure) {
  for (const accel::StructureKind kind : accel::all_structure_kinds()) {
    KeptState kept;
    kept.settings.panes[1].structure = accel::default_spec(kind);
    const KeptStateRead read = read_texts(app::settings_text(kept), "");
    EXPECT_TRUE(read.warnings.empty());
    EXPECT_EQ(read.kept.settings, kept.settings) << accel::to_string(kind);
  }
}

TEST(SettingsFile, AWrongValueCostsOnlyItself) {
  const KeptStateRead read = read_texts(
      "theme = \"pink\"\nup_axis = 7\nui_scale = 1.5\nnew_key = 3\n"
      "[overlay]\nopacity = \"much\"\nfilled = true\n"
      "[left_pane]\ndevice = 3\nthreads = 2\n[left_pane.structure]\nkind = \"kd-median\"\n"
      "leaf_triangles = -4\n[measure]\nslot_s = nan\n",
      "recent_scenes = [\"a\", 3]\nlayout = 4\nwindow_width = 900\n");
  EXPECT_EQ(read.kept.preferences.theme, ui::Theme::dark);
  EXPECT_EQ(read.kept.preferences.up_axis, 1);
  EXPECT_EQ(read.kept.preferences.ui_scale, 1.5F);
  EXPECT_EQ(read.kept.preferences.window_width, 900);
  EXPECT_TRUE(read.kept.preferences.recent_scenes.empty());
  EXPECT_EQ(read.kept.settings.overlay.opacity, 0.8F);
  EXPECT_TRUE(read.kept.settings.overlay.filled);
  EXPECT_EQ(read.kept.settings.measure.slot_s, 3.0F);
  EXPECT_EQ(read.kept.settings.panes[0].threads, 2);
  EXPECT_EQ(read.kept.settings.panes[0].structure.kind, accel::StructureKind::kd_median);
  ASSERT_EQ(read.warnings.size(), 8U);
  for (const char* key :
       {"theme", "up_axis", "overlay.opacity", "left_pane.device",
        "left_pane.structure.leaf_triangles", "measure.slot_s", "recent_scenes", "layout"}) {
    const bool named =
        std::any_of(read.warnings.begin(), read.warnings.end(), [&](const std::string& warning) {
          return warning.find(std::string(": ") + key + ": ") != std::string::npos &&
                 warning.find('\n') == std::string::npos;
        });
    EXPECT_TRUE(named) << key;
  }
}

TEST(SettingsFile, DamagedFilesGiveDefaults) {
  const std::string whole = app::settings_text(unusual());
  for (std::size_t length = 1; length < whole.size(); length += 37) {
    KeptStateRead read;
    app::read_settings_text(whole.substr(0, length), "f", read);
    for (const std::string& warning : read.warnings) EXPECT_EQ(warning.find("f:"), 0U) << warning;
  }
  for (const char* text : {"[[[", "a = ", "\xff\xfe", "theme = {", "x = 1\nx = 2"}) {
    const KeptStateRead read = read_texts(text, text);
    EXPECT_EQ(read.kept, KeptState{}) << text;
    EXPECT_EQ(read.warnings.size(), 2U) << text;
  }
}

TEST(SettingsFile, LeavesOutStoredCamerasThatAreNone) {
  const KeptStateRead read =
      read_texts("",
                 "[[camera]]\nscene = \"toys\"\nnumber = 12\neye = [1, 2, 3]\n"
                 "[[camera]]\nscene = \"toys\"\nnumber = 2\neye = [1, 2]\n"
                 "[[camera]]\nnumber = 2\neye = [1, 2, 3]\n"
                 "[[camera]]\nscene = \"toys\"\nnumber = 3\neye = [1, 2, 3]\n");
  EXPECT_EQ(read.warnings.size(), 3U);
  const auto& cameras = read.kept.preferences.bookmarks.at("toys");
  EXPECT_FALSE(cameras[1]);
  ASSERT_TRUE(cameras[2]);
  EXPECT_EQ(cameras[2]->eye.z, 3.0F);
}

class SettingsFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("encore_kept_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    files_ = {folder_ / "config/encore/window.toml", folder_ / "state/encore/window-state.toml"};
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
  app::SettingsFiles files_;
};

TEST_F(SettingsFolder, IsMadeWrittenReadAndForgotten) {
  EXPECT_EQ(app::read_kept_state(files_).kept, KeptState{});
  EXPECT_TRUE(app::read_kept_state(files_).warnings.empty());
  const KeptState kept = unusual();
  EXPECT_TRUE(app::write_kept_state(files_, kept).empty());
  EXPECT_EQ(app::read_kept_state(files_).kept, kept);
  // Nothing half-written stays beside them.
  for (const fs::path& file : {files_.settings, files_.state}) {
    EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
  }
  app::forget_kept_state(files_);
  EXPECT_EQ(app::read_kept_state(files_).kept, KeptState{});
}

TEST_F(SettingsFolder, TellsWhatCannotBeWritten) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "config") << "in the way";
  const auto problems = app::write_kept_state(files_, {});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("window.toml"), std::string::npos);
  EXPECT_TRUE(fs::exists(files_.state));
}

TEST_F(SettingsFolder, AFolderInTheFilesPlaceIsTold) {
  fs::create_directories(files_.settings);
  const KeptStateRead read = app::read_kept_state(files_);
  EXPECT_EQ(read.warnings.size(), 1U);
  EXPECT_EQ(read.kept, KeptState{});
}

TEST(SettingsFiles, FollowTheXdgRules) {
  ::setenv("XDG_CONFIG_HOME", "/c", 1);
  ::setenv("XDG_STATE_HOME", "relative", 1);
  ::setenv("HOME", "/home/someone", 1);
  const app::SettingsFiles files = app::settings_files();
  EXPECT_EQ(files.settings, "/c/encore/window.toml");
  EXPECT_EQ(files.state, "/home/someone/.local/state/encore/window-state.toml");
}

}  // namespace
