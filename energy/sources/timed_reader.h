#pragma once

#include "energy/sources/sensor_files.h"

#include <chrono>

namespace encore::energy {

/// Reads files on a thread of its own and gives up waiting after `limit`, for drivers that are
/// known to hang: the answer is then ETIMEDOUT, and at once so for every later read until the hung
/// one comes back. Nothing can end a hung read; the thread is left to it, and never waited for.
FileReader timed_reader(FileReader reader, std::chrono::milliseconds limit);

}  // namespace encore::energy
