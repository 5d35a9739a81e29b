#include "app/interrupt.h"

#include <csignal>

namespace encore::app {

std::atomic<bool> interrupted{false};

namespace {

extern "C" void on_signal(int signal) {
  interrupted.store(true);
  // The next one of its kind takes the default way out.
  std::signal(signal, SIG_DFL);
}

}  // namespace

void install_interrupt_handler() {
  static_assert(std::atomic<bool>::is_always_lock_free, "used inside a signal handler");
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

}  // namespace encore::app
