#pragma once

namespace encore::app {

/// Lets the window's thread go first wherever both want a processor: this thread, and those that it
/// starts from now on (of the CPU tracer, of an OpenGL driver in software), get a nice value of 5,
/// a third of the weight. On a machine with a free core nothing changes.
void yield_to_window();

}  // namespace encore::app
