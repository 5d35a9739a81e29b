#include "app/window/thread_priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace encore::app {

void yield_to_window() {
  constexpr int kNice = 5;
  // On Linux a nice value belongs to a thread. If it is refused, things are as before.
  const int before = getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
  if (before < kNice) setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
}

}  // namespace encore::app
