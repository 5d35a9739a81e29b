#pragma once

#include <chrono>
#include <string>

namespace encore::app {

/// Messages for people, on standard error; data goes to standard output.
class Terminal {
 public:
  explicit Terminal(bool quiet);

  /// A line of information; silent with --quiet.
  void info(const std::string& message);
  /// "warning: ..."; silent with --quiet.
  void warning(const std::string& message);
  /// Rewrites one progress line: "label  42 %  ETA 12 s". Only on a terminal, at most ten times a
  /// second, never with --quiet. `fraction` in [0, 1].
  void progress(const std::string& label, double fraction);
  /// Clears the progress line.
  void progress_done();

 private:
  bool quiet_;
  bool is_terminal_;
  bool line_open_ = false;
  std::chrono::steady_clock::time_point started_{};
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace encore::app
