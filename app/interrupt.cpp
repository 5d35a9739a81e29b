#include "app/interrupt.h"

#include "app/terminal.h"

#include <csignal>

namespace encore::app {

std::atomic<bool> interrupted{false};

namespace {

extern "C" void on_signal(int signal) {
  interrupted.store(true);
  // The next one of its kind takes the default way out.
  std::signal(signal, SIG_DFL);
}

std::atomic<bool> pause_asked{false};

extern "C" void on_pause(int) {
  pause_asked.store(true);
}

}  // namespace

void install_interrupt_handler() {
  static_assert(std::atomic<bool>::is_always_lock_free, "used inside a signal handler");
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

void install_pause_handler() {
  std::signal(SIGTSTP, on_pause);
}

bool pause_if_asked(Terminal& terminal) {
  if (pause_asked.exchange(false)) {
    terminal.progress_done();
    terminal.info("paused between two tests; 'fg' goes on");
    std::raise(SIGSTOP);
  }
  return !interrupted;
}

}  // namespace encore::app
