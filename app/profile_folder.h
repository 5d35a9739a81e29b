#pragma once

#include <filesystem>
#include <string>

namespace encore::app {

/// The time now in UTC, ISO 8601 to the second: "2026-01-31T23:59:59Z".
std::string utc_now();

/// Makes the folder that a session is written to and returns it.
///
/// `wanted` (--out) must not exist yet or be an empty folder, else UsageError: nothing is ever
/// overwritten. Empty: a new folder "<UTC time>-<scene>" below ${XDG_DATA_HOME}/encore/sessions,
/// or ~/.local/share if that is not set to an absolute path. Throws energy::SessionError if it
/// cannot be made.
std::filesystem::path make_session_folder(const std::string& wanted, const std::string& started_utc,
                                          const std::string& scene);

}  // namespace encore::app
