// Makes the README's pictures of the window: scripts/make-pictures.sh runs it. What a picture shows
// is set by kept settings, as of someone who has used the program before; the rest is done by hand.
#include "renderer/image_io.h"
#include "window_test.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace encore::test {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kModel{"--model",
                                      "idle=12,animate=6,build=20,update=15,transfer=8,render=45"};

std::string pane(const char* side, const char* device, const std::string& structure,
                 const char* policy = "rebuild", const char* content = "picture") {
  const std::string head = std::string("[") + side + "_pane";
  return head + "]\ndevice = \"" + device + "\"\npolicy = \"" + policy + "\"\ncontent = \"" +
         content + "\"\n" + head + ".structure]\nkind = \"" + structure + "\"\n";
}

std::string camera(const char* scene, const char* eye, const char* target, double fov) {
  return std::string("[[camera]]\nscene = \"") + scene + "\"\nnumber = 1\neye = " + eye +
         "\ntarget = " + target + "\nup = [0.0, 1.0, 0.0]\nfov = " + std::to_string(fov) +
         "\northographic_height = 0.0\n";
}

const std::string kBare = "[layout]\nleft = false\nright = false\nplots = false\n";

/// The rim of a picture is where figures and headings are.
Area middle_of(const Widget& picture, int width, int height) {
  width = std::min(width, picture.width);
  height = std::min(height, picture.height);
  return {picture.x + (picture.width - width) / 2, picture.y + (picture.height - height) / 2, width,
          height};
}

class ReadmePictures : public WindowTest {
 protected:
  void SetUp() override {
    if (std::getenv("ENCORE_PICTURES") == nullptr) {
      GTEST_SKIP() << "ENCORE_PICTURES names no folder to write pictures to";
    }
    open_display(1600, 1000);
  }

  /// What window.toml and window-state.toml hold when the program starts.
  void keep(const std::string& settings, const std::string& state) {
    write(".config/encore/window.toml", settings);
    write(".local/state/encore/window-state.toml", state);
  }

  /// The camera that is stored as 1.
  void take_camera() {
    person().see("pane.0.picture");
    person().wait_idle();
    person().key("1");
    // Until its notice is gone.
    person().wait_until([](const WidgetMap& map) { return map.states("notice").empty(); },
                        "the notices to go");
  }

  static void save(const Screenshot& shot, const std::string& name, const Area& area) {
    std::vector<std::uint8_t> rgb;
    for (int y = area.y; y < area.y + area.height; ++y) {
      rgb.insert(rgb.end(), shot.at(area.x, y), shot.at(area.x, y) + area.width * 3);
    }
    fs::create_directories(std::getenv("ENCORE_PICTURES"));
    renderer::write_png(rgb, area.width, area.height,
                        fs::path(std::getenv("ENCORE_PICTURES")) / (name + ".png"));
  }
  static void save(const Screenshot& shot, const std::string& name) {
    save(shot, name, {0, 0, shot.width(), shot.height()});
  }

  /// The 3D view and the column beside it.
  void save_view_and_column(const std::string& name) {
    const Screenshot shot = person().look_calmly();
    const Widget view = person().see("structure_view.picture");
    const int top = person().see("structure_view.pane.0").y - 6;
    save(shot, name, {view.x, top, shot.width() - view.x, view.y + view.height - top});
  }

  /// A structure over the traced scene, nothing beside it.
  void overlay_picture(const std::string& name, const std::string& structure,
                       const std::string& looks) {
    keep(structure + pane("right", "off", "kd-sah") + "[overlay]\nshow = true\n" + looks,
         kBare + camera("bunny", "[22.0, 13.0, 38.0]", "[0.5, -0.6, 0.0]", 42.0));
    start({"bunny"}, "380x500");
    take_camera();
    const Screenshot shot = person().look_calmly();
    save(shot, name, middle_of(person().see("pane.0.picture"), 350, 350));
    close();
  }

  /// In measure mode until both panes' joules are known and so many slots are over.
  void measure(double seconds) {
    person().see("pane.0.picture");
    person().wait_idle();
    person().key("space");
    person().key("m");
    person().wait_until(
        [](const WidgetMap& now) {
          return contains(now.state("pane.0.joules"), "J") &&
                 contains(now.state("pane.1.joules"), "J");
        },
        "joules a frame of both panes");
    // Where nothing is hovered.
    person().move(person().see("menu.frames").x - 300, 2);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }

  static std::vector<std::string> with_model(std::string scene) {
    std::vector<std::string> arguments = kModel;
    arguments.insert(arguments.begin(), std::move(scene));
    return arguments;
  }

 private:
  void write(const char* file, const std::string& text) const {
    const fs::path path = home().path() / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
};

}  // namespace

TEST_F(ReadmePictures, DISABLED_Window) {
  keep(pane("left", "cpu", "kd-sah") + pane("right", "gpu", "bvh-median", "refit") +
           "[measure]\nslot_s = 1.5\nidle_s = 0.6\n",
       "[layout]\nright_width = 22.0\n" +
           camera("toys", "[0.0, 8.0, 34.0]", "[0.0, -1.5, 0.0]", 55.0));
  start(with_model("toys"), "1600x1000");
  take_camera();
  measure(45.0);
  save(person().look(), "window");
  person().key("m");
  close();
}

TEST_F(ReadmePictures, DISABLED_LightWindow) {
  keep("theme = \"light\"\n" + pane("left", "cpu", "grid-exact") +
           pane("right", "cpu", "bvh-median", "refit") + "[measure]\nslot_s = 1.2\nidle_s = 0.5\n",
       "[layout]\nright = false\n" + camera("wave", "[8.0, 15.0, 36.0]", "[0.0, -2.0, 0.0]", 46.0));
  start(with_model("wave"), "1280x800");
  take_camera();
  person().key("Ctrl+r");
  measure(30.0);
  save(person().look(), "window-light");
  person().key("Ctrl+r");
  person().key("m");
  close();
}

TEST_F(ReadmePictures, DISABLED_Overlays) {
  overlay_picture("overlay-grid", pane("left", "cpu", "grid-exact") + "cells_per_axis = 14\n",
                  "color = \"leaf-size\"\nline_pixels = 1.2\n");
  overlay_picture("overlay-kd", pane("left", "cpu", "kd-sah"),
                  "last_depth = 8\nplanes = false\nline_pixels = 1.2\n");
  overlay_picture("overlay-bvh", pane("left", "cpu", "bvh-median"),
                  "first_depth = 3\nlast_depth = 6\nline_pixels = 1.2\n");
}

TEST_F(ReadmePictures, DISABLED_StructureIn3D) {
  keep(pane("left", "cpu", "bvh-median") + pane("right", "off", "bvh-median") +
           "[overlay]\nfirst_depth = 4\nlast_depth = 7\nsection = true\nsection_axis = 0\n"
           "section_position = 0.55\n",
       "[layout]\nleft = false\nright = true\nplots = false\nright_width = 24.0\n"
       "pane_split = 0.3\n" +
           camera("cow", "[-16.0, 9.0, 36.0]", "[0.0, 0.0, 0.0]", 38.0));
  start({"cow"}, "1200x560");
  take_camera();
  person().key("v");
  const Widget view = person().see("structure_view.picture");
  person().wait_idle();
  person().wheel(view.center_x(), view.center_y(), 1);
  person().wait_idle();
  person().click("structure.tab.tree");
  person().see("tree.list");
  person().click(view.center_x() - 30, view.center_y());
  person().wait_idle();
  save_view_and_column("structure-3d");
  close();
}

TEST_F(ReadmePictures, DISABLED_RayPath) {
  keep(pane("left", "cpu", "kd-sah") + pane("right", "off", "kd-sah") +
           "[overlay]\nlast_depth = 1\nplanes = false\n",
       "[layout]\nleft = false\nright = true\nplots = false\nright_width = 37.0\n" +
           camera("cow", "[-4.0, 4.0, 36.0]", "[0.0, 0.0, 0.0]", 42.0));
  start({"cow"}, "1560x600");
  take_camera();
  person().key("v");
  const Widget view = person().see("structure_view.picture");
  person().wait_idle();
  const Widget picture = person().see("pane.0.picture");
  person().click(picture.center_x() + 60, picture.center_y() - 20);
  person().see("ray.step");
  for (int i = 0; i < 12; ++i) person().key("Right");
  person().wheel(view.center_x(), view.center_y(), 1);
  save_view_and_column("ray-path");
  close();
}

TEST_F(ReadmePictures, DISABLED_Heatmap) {
  keep(pane("left", "cpu", "kd-sah", "rebuild", "heatmap") + pane("right", "off", "kd-sah"),
       kBare + camera("dragon", "[16.0, 9.0, 34.0]", "[-2.0, -2.0, 0.0]", 37.0));
  start({"dragon"}, "720x560");
  take_camera();
  const Screenshot shot = person().look_calmly();
  const Widget head = person().see("pane.0.device");
  const Widget picture = person().see("pane.0.picture");
  save(shot, "heatmap", {0, head.y - 6, shot.width(), picture.y + picture.height - head.y + 6});
  close();
}

TEST_F(ReadmePictures, DISABLED_Plots) {
  keep(pane("left", "cpu", "kd-sah") + pane("right", "cpu", "bvh-median", "refit") +
           "[measure]\nslot_s = 1.5\nidle_s = 0.6\n",
       "[layout]\nleft = false\nright = false\nplots_share = 0.55\n");
  start(with_model("wave"), "1600x760");
  measure(20.0);
  person().choose({"pane.0.structure", "pane.0.structure.grid-exact"});
  person().move(person().see("menu.frames").x - 300, 2);
  std::this_thread::sleep_for(std::chrono::seconds(25));
  const Widget title = person().see("power.title");
  const Widget status = person().see("status.text");
  const Screenshot shot = person().look();
  save(shot, "plots", {0, title.y - 8, shot.width(), status.y - title.y});
  person().key("m");
  close();
}

}  // namespace encore::test
