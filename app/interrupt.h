#pragma once

#include <atomic>

namespace encore::app {

/// Set by SIGINT and SIGTERM once install_interrupt_handler() was called. Long work polls it,
/// finishes its current operation, saves what it measured and exits with code 130. A second
/// signal ends the program at once.
extern std::atomic<bool> interrupted;

void install_interrupt_handler();

/// From now on Ctrl+Z (SIGTSTP) does not stop the program at once: pause_if_asked() does, between
/// two measurements, so that none is torn.
void install_pause_handler();
class Terminal;
/// Stops the program here if Ctrl+Z was pressed, until it is told to go on. False if it was
/// interrupted meanwhile.
bool pause_if_asked(Terminal& terminal);

}  // namespace encore::app
