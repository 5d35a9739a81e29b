#pragma once

#include <atomic>

namespace encore::app {

/// Set by SIGINT and SIGTERM once install_interrupt_handler() was called. Long work polls it,
/// finishes its current operation, saves what it measured and exits with code 130. A second
/// signal ends the program at once.
extern std::atomic<bool> interrupted;

void install_interrupt_handler();

}  // namespace encore::app
