#include "virtual_display.h"

#include <X11/Xlib.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace encore::test {

namespace {

constexpr int kStart_ms = 60'000;

/// Errors about windows that went away meanwhile must not end the tests.
int ignore_error(Display* /*display*/, XErrorEvent* /*event*/) {
  return 0;
}

/// The display's number, which the server writes once it listens; empty if it ended instead.
std::string read_number(int pipe) {
  std::string number;
  for (;;) {
    pollfd waiting{pipe, POLLIN, 0};
    if (poll(&waiting, 1, kStart_ms) <= 0) return {};
    char letter = 0;
    const ssize_t got = read(pipe, &letter, 1);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return {};
    if (letter == '\n') return number;
    number += letter;
  }
}

}  // namespace

VirtualDisplay::VirtualDisplay(int width, int height) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to the X server");
  const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
  const std::string out = std::to_string(ends[1]);
  server_ = fork();
  if (server_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(ends[0]);
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execlp("Xvfb", "Xvfb", "-displayfd", out.c_str(), "-screen", "0", screen.c_str(), "-nolisten",
           "tcp", "-noreset", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  const std::string number = read_number(ends[0]);
  close(ends[0]);
  if (!number.empty()) {
    name_ = ":" + number;
    XSetErrorHandler(ignore_error);
    connection_ = XOpenDisplay(name_.c_str());
  }
  if (connection_ == nullptr) {
    kill(server_, SIGKILL);
    waitpid(server_, nullptr, 0);
    throw std::runtime_error("Xvfb does not start; install the package xvfb");
  }
}

VirtualDisplay::~VirtualDisplay() {
  XCloseDisplay(connection_);
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

std::unique_ptr<VirtualDisplay> try_virtual_display(int width, int height, std::string& why) {
  try {
    return std::make_unique<VirtualDisplay>(width, height);
  } catch (const std::runtime_error& error) {
    why = error.what();
    return nullptr;
  }
}

}  // namespace encore::test
