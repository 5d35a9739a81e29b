// A random walk through the window, for sanitizers: scripts/tour.sh runs it. The same seed makes
// the same choices as long as the program shows the same; every step is printed before it is taken.
#include "window_test.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <random>
#include <string_view>

namespace encore::test {

namespace {

using Clock = std::chrono::steady_clock;

double number_from(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atof(text);
}

/// What ends the walk, leaves its home, or takes minutes under a sanitizer.
bool is_left_alone(std::string_view name) {
  constexpr std::array<std::string_view, 12> kExact{"menu.file.quit",
                                                    "browser.up",
                                                    "browser.path",
                                                    "browser.recent",
                                                    "menu.file.sample.buddha",
                                                    "menu.file.sample.forest",
                                                    "menu.file.sample.hall",
                                                    "settings.scene.sample.buddha",
                                                    "settings.scene.sample.forest",
                                                    "settings.scene.sample.hall",
                                                    "menu.file.recent.clear",
                                                    "menu.view.scale.300"};
  return std::find(kExact.begin(), kExact.end(), name) != kExact.end();
}

bool is_picture(std::string_view name) {
  return name.ends_with(".picture");
}

class Tour {
 public:
  Tour(Person& person, unsigned seed) : person_(person), random_(seed) {}

  void step() {
    ++number_;
    const int choice = pick(100);
    if (choice < 55) {
      click_something();
    } else if (choice < 70) {
      press_something();
    } else if (choice < 82) {
      move_a_camera();
    } else if (choice < 88) {
      drag_something();
    } else if (choice < 93) {
      turn_the_wheel();
    } else if (choice < 96) {
      resize();
    } else {
      tell("waits");
      person_.wait_frames(10);
    }
  }
  [[nodiscard]] int steps() const { return number_; }

 private:
  int pick(int below) { return int(random_() % unsigned(std::max(1, below))); }

  void tell(const std::string& what) {
    std::printf("step %d: %s\n", number_, what.c_str());
    std::fflush(stdout);
  }
  static std::string at(int x, int y) {
    return " at " + std::to_string(x) + ", " + std::to_string(y);
  }

  std::optional<Widget> something(bool picture) {
    std::vector<Widget> all = person_.map().widgets;
    std::erase_if(all, [picture](const Widget& widget) {
      return is_left_alone(widget.name) || is_picture(widget.name) != picture;
    });
    if (all.empty()) return std::nullopt;
    return all[std::size_t(pick(int(all.size())))];
  }

  void click_something() {
    const auto widget = something(pick(10) == 0);
    if (!widget) return;
    tell("clicks " + widget->name + at(widget->center_x(), widget->center_y()));
    person_.click(widget->center_x(), widget->center_y(),
                  pick(20) == 0 ? Person::right : Person::left);
  }

  void drag_something() {
    const auto widget = something(false);
    if (!widget) return;
    const int dx = pick(200) - 100;
    const int dy = pick(80) - 40;
    tell("drags " + widget->name + at(widget->center_x(), widget->center_y()) + " by " +
         std::to_string(dx) + ", " + std::to_string(dy));
    person_.drag(widget->center_x(), widget->center_y(), widget->center_x() + dx,
                 widget->center_y() + dy, Person::left, 4);
  }

  void press_something() {
    constexpr std::array kKeys{"space",
                               "r",
                               "f",
                               "o",
                               "v",
                               "b",
                               "m",
                               "Ctrl+r",
                               "Ctrl+m",
                               "Ctrl+z",
                               "Ctrl+Shift+z",
                               "Escape",
                               "Escape",
                               "Return",
                               "Right",
                               "Left",
                               "Down",
                               "F1",
                               "F5",
                               "Ctrl+s",
                               "Ctrl+o",
                               "Ctrl+c",
                               "Ctrl+v",
                               "Ctrl+1",
                               "1",
                               "2",
                               "Tab",
                               "a",
                               "7",
                               "question"};
    const char* key = kKeys[std::size_t(pick(int(kKeys.size())))];
    tell(std::string("presses ") + key);
    person_.key(key);
  }

  void move_a_camera() {
    const auto widget = something(true);
    if (!widget) return;
    const auto button = static_cast<Person::Button>(1 + pick(3));
    const int dx = pick(240) - 120;
    const int dy = pick(160) - 80;
    tell("moves the camera of " + widget->name + " by " + std::to_string(dx) + ", " +
         std::to_string(dy) + " with button " + std::to_string(int(button)));
    person_.drag(widget->center_x(), widget->center_y(), widget->center_x() + dx,
                 widget->center_y() + dy, button, 5);
  }

  void turn_the_wheel() {
    const auto widget = something(pick(2) == 0);
    if (!widget) return;
    const int notches = pick(9) - 4;
    tell("turns the wheel over " + widget->name + " by " + std::to_string(notches));
    person_.wheel(widget->center_x(), widget->center_y(), notches);
  }

  void resize() {
    const int width = 320 + pick(1280);
    const int height = 240 + pick(760);
    tell("resizes to " + std::to_string(width) + "x" + std::to_string(height));
    person_.resize(width, height);
  }

  Person& person_;
  std::mt19937 random_;
  int number_ = 0;
};

}  // namespace

TEST_F(WindowTest, DISABLED_Tour) {
  const double minutes = number_from("ENCORE_TOUR_MINUTES", 1.0);
  const auto seed = static_cast<unsigned>(number_from("ENCORE_TOUR_SEED", 1.0));
  open_display(1600, 1000);
  start({"mug", "--model", "idle=5,build=20,render=30"}, "1400x900");
  const auto end = Clock::now() + std::chrono::duration<double>(minutes * 60.0);
  Tour tour(person(), seed);
  while (Clock::now() < end) tour.step();
  std::printf("%d steps with seed %u\n", tour.steps(), seed);
  close();
}

}  // namespace encore::test
