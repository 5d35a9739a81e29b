#include "app/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace encore::app {

Terminal::Terminal(bool quiet) : quiet_(quiet), is_terminal_(isatty(STDERR_FILENO) == 1) {}

void Terminal::info(const std::string& message) {
  progress_done();
  if (!quiet_) fmt::print(stderr, "{}\n", message);
}

void Terminal::warning(const std::string& message) {
  progress_done();
  if (!quiet_) fmt::print(stderr, "warning: {}\n", message);
}

void Terminal::progress(const std::string& label, double fraction) {
  if (quiet_ || !is_terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (!line_open_) {
    started_ = now;
    line_open_ = true;
  } else if (now - last_ < std::chrono::milliseconds(100)) {
    return;
  }
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - started_).count();
  std::string eta;
  if (fraction > 0.01) eta = fmt::format("  ETA {:.0f} s", elapsed * (1.0 / fraction - 1.0));
  fmt::print(stderr, "\r\033[K{}  {:3.0f} %{}", label, 100.0 * fraction, eta);
  std::fflush(stderr);
}

void Terminal::progress_done() {
  if (!line_open_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  line_open_ = false;
}

}  // namespace encore::app
