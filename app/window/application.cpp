#include "app/window/application.h"

#include "app/common_options.h"
#include "app/window/engine.h"
#include "app/window/frame_statistics.h"
#include "app/window/glfw_window.h"
#include "app/window/picture_file.h"
#include "app/window/screen.h"
#include "app/window/settings_file.h"
#include "app/window/steady_time.h"
#include "app/window/widget_map_file.h"
#include "scene/sample_scenes.h"
#include "ui/panels/panels.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>
#include <variant>

namespace encore::app {

namespace {

/// A frame at least so often while something moves, and where only plots grow; nothing at all
/// otherwise, but for the clock in the status line.
constexpr double kMoving_s = 1.0 / 60.0;
constexpr double kWorking_s = 1.0 / 15.0;
constexpr double kPlots_s = 0.1;
/// Tooltips come after a moment, so frames go on for a while after the last input.
constexpr double kAfterInput_s = 0.7;
constexpr double kAfterInputStep_s = 1.0 / 25.0;
constexpr double kMeasuring_s = 0.25;
constexpr double kIdle_s = 0.5;
/// After something came in, so many frames follow: menus and tooltips take a few to settle.
constexpr int kFramesAfterInput = 3;
constexpr double kSaveAfter_s = 2.0;

ImageSize window_size(const WindowOptions& options, const ui::Preferences& preferences) {
  if (options.size) return parse_size(*options.size);
  return {preferences.window_width, preferences.window_height};
}

class Application {
 public:
  Application(const WindowOptions& options, const std::atomic<bool>& stop, KeptState kept,
              std::vector<std::string> warnings)
      : options_(options),
        stop_(stop),
        kept_(std::move(kept)),
        window_({window_size(options, kept_.preferences).width,
                 window_size(options, kept_.preferences).height, options.gl_debug}),
        context_(renderer::gl::adopt_current_context()),
        screen_(context_),
        engine_({options.gl_device, options.measuring, options.search_path, GlfwWindow::wake,
                 options.threads}) {
    state_.settings = kept_.settings;
    state_.preferences = kept_.preferences;
    for (const std::string& warning : warnings) ui::tell(state_, warning, true);
    ui::enable_widget_map(!options.widget_map.empty());
    engine_.open_scene(options.scene.empty() ? std::string(scene::kDefaultSceneName)
                                             : options.scene);
    if (state_.settings.energy.from != ui::EnergySettings::From::automatic &&
        options.measuring.sources.empty() && options.measuring.model.empty()) {
      engine_.execute(ui::ApplyEnergy{}, state_);
    }
  }

  ExitCode run();

 private:
  void frame();
  void wait();
  [[nodiscard]] double frame_interval() const;
  void apply_look();
  void take_drops();
  void carry_out(const ui::Commands& commands);
  void save_picture(const ui::SavePicture& save);
  void save_text(const ui::SaveText& save);
  void keep_settings(bool now);
  void note_first_pictures();
  [[nodiscard]] ui::Rect within_window(const ui::Rect& area) const;

  const WindowOptions& options_;
  const std::atomic<bool>& stop_;
  KeptState kept_;
  GlfwWindow window_;
  std::shared_ptr<renderer::gl::Context> context_;  ///< the window's
  Screen screen_;
  Engine engine_;
  ui::View view_;
  ui::UiState state_;
  FrameStatistics statistics_;
  double start_s_ = steady_now();
  double last_frame_s_ = 0.0;
  double last_input_s_ = 0.0;
  int frames_due_ = kFramesAfterInput;
  std::optional<ui::Theme> theme_;
  float scale_ = 0.0F;
  double changed_s_ = 0.0;  ///< when settings were last seen to differ from what is kept
  std::string title_;
  std::optional<ui::SavePicture> capture_;  ///< of the next frame
  std::uint64_t frame_number_ = 0;
  std::optional<double> first_picture_s_;  ///< since the program was started
  std::optional<double> all_pictures_s_;
};

void Application::apply_look() {
  const float scale = ui::ui_scale(state_.preferences, window_.content_scale());
  if (theme_ == state_.preferences.theme && scale == scale_) return;
  if (scale != scale_) {
    ui::rebuild_fonts(scale);
    GlfwWindow::fonts_changed();
  }
  ui::apply_style(state_.preferences.theme, scale);
  theme_ = state_.preferences.theme;
  scale_ = scale;
}

void Application::take_drops() {
  for (const std::string& path : window_.take_dropped()) {
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::path(path) / "session.toml", error)) {
      engine_.execute(ui::OpenSession{path}, state_);
    } else {
      engine_.open_scene(path);
    }
  }
}

double Application::frame_interval() const {
  const bool used = last_frame_s_ - last_input_s_ < kAfterInput_s;
  if (state_.measuring || view_.accuracy.work.active) return used ? kPlots_s : kMeasuring_s;
  const bool plays = state_.settings.animation.playing && view_.scene.animated;
  if (plays || state_.camera_moving) return kMoving_s;
  if (used) return kAfterInputStep_s;
  if (engine_.busy()) return kWorking_s;
  const bool live = view_.power.origin != energy::Origin::unavailable && !view_.plots.power.empty();
  if (live || !state_.notices.empty()) return kPlots_s;
  return kIdle_s;
}

void Application::wait() {
  // Until it is time for the next frame, or something came in. News from workers come as empty
  // events: they are shown at once, but no more often than the screen can.
  for (;;) {
    const double now = steady_now();
    const double since = now - last_frame_s_;
    const bool input = window_.take_input();
    if (input) {
      frames_due_ = kFramesAfterInput;
      last_input_s_ = now;
    }
    const double shortest = kMoving_s;
    if (frames_due_ > 0 && since >= shortest) {
      --frames_due_;
      return;
    }
    const double interval = frames_due_ > 0 ? shortest : frame_interval();
    if (since >= interval || stop_.load(std::memory_order_relaxed)) return;
    window_.wait_events(interval - since);
    const bool event = steady_now() - now < interval - since - 1e-3;
    if (window_.should_close()) return;
    if (event && !state_.measuring && frames_due_ == 0) frames_due_ = 1;
  }
}

void Application::save_picture(const ui::SavePicture& save) {
  static constexpr const char* kNames[] = {"pane-1", "pane-2", "structure",
                                           "plots",  "window", "accuracy"};
  try {
    const auto what = static_cast<std::size_t>(save.what);
    ui::SavePicture named = save;
    if (named.file.empty()) named.file = new_picture_file(kNames[what]);
    const bool of_window = save.what == ui::PictureOf::plots ||
                           save.what == ui::PictureOf::window ||
                           save.what == ui::PictureOf::accuracy;
    if (of_window) {
      capture_ = std::move(named);
      frames_due_ = std::max(frames_due_, 1);
      return;
    }
    screen_.save(what, named.file);
    ui::tell(state_, "saved " + named.file.string());
  } catch (const std::exception& error) {
    ui::tell(state_, error.what(), true);
  }
}

void Application::save_text(const ui::SaveText& save) {
  std::ofstream file(save.file, std::ios::binary);
  file << save.text;
  file.close();
  if (file) {
    ui::tell(state_, "saved " + save.file.string());
  } else {
    ui::tell(state_, fmt::format("cannot write {}: choose another folder", save.file.string()),
             true);
  }
}

void Application::carry_out(const ui::Commands& commands) {
  for (const ui::Command& command : commands) {
    if (engine_.execute(command, state_)) continue;
    if (const auto* save = std::get_if<ui::SavePicture>(&command)) {
      save_picture(*save);
    } else if (const auto* text = std::get_if<ui::SaveText>(&command)) {
      save_text(*text);
    } else if (const auto* copy = std::get_if<ui::CopyText>(&command)) {
      window_.copy_text(copy->text);
      if (!copy->told.empty()) ui::tell(state_, copy->told);
    } else if (const auto* pick = std::get_if<ui::PickNode>(&command)) {
      state_.selected_node = screen_.node_at(pick->x, pick->y);
    } else if (std::holds_alternative<ui::ToggleFullScreen>(command)) {
      window_.toggle_full_screen();
    } else if (std::holds_alternative<ui::Quit>(command)) {
      window_.close();
    }
  }
}

void Application::keep_settings(bool now) {
  if (options_.fresh) return;
  state_.preferences.window_width = std::max(window_.width(), 320);
  state_.preferences.window_height = std::max(window_.height(), 240);
  if (state_.settings == kept_.settings && state_.preferences == kept_.preferences) {
    changed_s_ = 0.0;
    return;
  }
  const double time = steady_now();
  if (changed_s_ == 0.0) changed_s_ = time;
  if (!now && time - changed_s_ < kSaveAfter_s) return;
  kept_ = {state_.settings, state_.preferences};
  for (const std::string& problem : write_kept_state(settings_files(), kept_)) {
    ui::tell(state_, problem, true);
  }
  changed_s_ = 0.0;
}

void Application::note_first_pictures() {
  if (all_pictures_s_) return;
  bool any = false;
  bool all = true;
  for (const ui::PaneView& pane : view_.panes) {
    const bool shown = pane.texture != 0 && pane.state == ui::PaneState::ready;
    any = any || shown;
    all = all && (shown || pane.state == ui::PaneState::off);
  }
  if (any && !first_picture_s_) first_picture_s_ = seconds_since_start();
  if (any && all) all_pictures_s_ = seconds_since_start();
}

ui::Rect Application::within_window(const ui::Rect& area) const {
  const float x = std::max(area.x, 0.0F);
  const float y = std::max(area.y, 0.0F);
  return {x, y, std::min(area.right(), float(window_.width())) - x,
          std::min(area.bottom(), float(window_.height())) - y};
}

void Application::frame() {
  const double began = steady_now();
  apply_look();
  take_drops();
  engine_.apply(state_, began - start_s_);
  engine_.fill(view_, state_);
  screen_.update({engine_.output(0), engine_.output(1)}, state_, view_);
  statistics_.fill(view_.window);
  view_.window.opengl = window_.renderer_name();
  view_.window.opengl_software = context_->capabilities().software;
  view_.window.monitor_scale = window_.content_scale();

  ui::clear_widget_map();
  window_.begin_frame();
  ui::Commands commands;
  ui::draw_window(view_, state_, commands);
  const std::optional<ui::SavePicture> capture = std::exchange(capture_, std::nullopt);
  std::vector<unsigned char> pixels;
  window_.end_frame(capture ? &pixels : nullptr);
  if (capture) {
    try {
      const int width = window_.width();
      if (capture->what != ui::PictureOf::window) {
        const bool plots = capture->what == ui::PictureOf::plots;
        const ui::Rect area = within_window(plots ? state_.plots_area : state_.accuracy.area);
        write_rgb_png(capture->file, pixels, width, int(area.x), int(area.y), int(area.width),
                      int(area.height));
      } else {
        write_rgb_png(capture->file, pixels, width, 0, 0, width, window_.height());
      }
      ui::tell(state_, "saved " + capture->file.string());
    } catch (const std::exception& error) {
      ui::tell(state_, error.what(), true);
    }
  }
  carry_out(commands);
  if (!commands.empty()) frames_due_ = kFramesAfterInput;
  ++frame_number_;
  if (ui::widget_map_enabled()) {
    write_widget_map(options_.widget_map, frame_number_, engine_.busy());
  }
  const std::string title =
      view_.scene.scene ? fmt::format("{} - ENCORE", view_.scene.scene->name) : "ENCORE";
  if (title != title_) window_.set_title(title_ = title);
  keep_settings(false);
  note_first_pictures();
  const double ended = steady_now();
  last_frame_s_ = began;
  statistics_.add(ended - began, ended);
}

ExitCode Application::run() {
  while (!window_.should_close() && !stop_.load(std::memory_order_relaxed)) {
    wait();
    if (window_.should_close()) break;
    window_.wait_events(0.0);
    if (window_.visible()) {
      frame();
    } else {
      engine_.apply(state_, steady_now() - start_s_);
      last_frame_s_ = steady_now();
    }
  }
  engine_.shut_down();
  keep_settings(true);
  if (!options_.timings.empty()) {
    std::ofstream file(options_.timings);
    file << fmt::format("# first picture after {:.2f} s, all panes after {:.2f} s\n",
                        first_picture_s_.value_or(NAN), all_pictures_s_.value_or(NAN));
    statistics_.write(file);
  }
  if (window_.gl_errors() > 0) {
    fmt::print(stderr, "encore: {} OpenGL errors, the first: {}\n", window_.gl_errors(),
               window_.first_gl_error());
    return ExitCode::failure;
  }
  return ExitCode::ok;
}

}  // namespace

ExitCode run_window(const WindowOptions& options, const std::atomic<bool>& stop) {
  KeptStateRead kept;
  if (!options.fresh) kept = read_kept_state(settings_files());
  Application application(options, stop, std::move(kept.kept), std::move(kept.warnings));
  return application.run();
}

}  // namespace encore::app
