#pragma once

#include "app/window/background_task.h"

#include <cstdint>
#include <filesystem>

namespace encore::app {

/// What was copied.
struct ExportResult {
  std::filesystem::path folder;
  std::uint64_t files = 0;
  std::uint64_t bytes = 0;
};

/// Copies a session folder (all its CSV and TOML files) to `to`, which must not exist yet or be an
/// empty folder. The copy is made beside it as "<to>.partial" and gets its name when it is whole,
/// so that what was interrupted never looks like a session; a stop removes it. Throws
/// energy::SessionError with one line.
ExportResult export_session(const std::filesystem::path& from, const std::filesystem::path& to,
                            TaskControl& control);

using SessionExporter = BackgroundTask<ExportResult>;

}  // namespace encore::app
