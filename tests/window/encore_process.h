#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::test {

/// A widget of the running program, in pixels of its window.
struct Widget {
  std::string name;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::string state;

  [[nodiscard]] int center_x() const { return x + width / 2; }
  [[nodiscard]] int center_y() const { return y + height / 2; }
};

/// What the program says of the frame that it drew last.
struct WidgetMap {
  std::uint64_t frame = 0;  ///< 0: none was drawn yet
  bool busy = false;
  std::vector<Widget> widgets;

  /// The first one with this name; null if there is none.
  [[nodiscard]] const Widget* find(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
  /// Its state; empty if there is no such widget.
  [[nodiscard]] std::string state(std::string_view name) const;
  /// States of all whose name begins so, one a line.
  [[nodiscard]] std::string states(std::string_view prefix) const;
};
WidgetMap read_widget_map(const std::filesystem::path& file);

/// The program itself with a home of its own.
class EncoreProcess {
 public:
  struct Setup {
    std::string display;  ///< empty: none
    std::vector<std::string> arguments;
    std::filesystem::path home;  ///< HOME, and XDG's folders in it
    std::vector<std::pair<std::string, std::string>> environment;  ///< besides
  };
  explicit EncoreProcess(const Setup& setup);
  ~EncoreProcess();  ///< kills what still runs
  EncoreProcess(const EncoreProcess&) = delete;
  EncoreProcess& operator=(const EncoreProcess&) = delete;

  [[nodiscard]] WidgetMap map() const { return read_widget_map(map_file_); }
  void signal(int number) const;
  [[nodiscard]] bool running();
  /// Waits for the end: the exit code, 128 + the signal that ended it; nothing if it goes on.
  std::optional<int> wait(std::chrono::milliseconds patience);
  [[nodiscard]] std::string out() const;
  [[nodiscard]] std::string err() const;

 private:
  pid_t process_ = -1;
  std::optional<int> code_;
  std::filesystem::path map_file_;
  std::filesystem::path out_;
  std::filesystem::path err_;
};

}  // namespace encore::test
