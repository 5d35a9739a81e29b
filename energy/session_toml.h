#pragma once

#include "energy/session.h"

#include <filesystem>

namespace encore::energy {

/// Writes session.toml; the old file stays whole until the new one is. Throws SessionError.
void write_session_toml(const std::filesystem::path& path, const SessionInfo& info);

/// Reads it back. Throws SessionError that names file and key.
SessionInfo read_session_toml(const std::filesystem::path& path);

}  // namespace encore::energy
