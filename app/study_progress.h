#pragma once

#include "energy/session.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace encore::app {

/// What an interrupted study has already done.
struct StudyProgress {
  energy::SessionInfo info;
  std::set<std::string> done;  ///< keys of configurations that have a summary
  energy::Seconds reached;     ///< the latest time in its files
};

/// What tells a test of a study from all others: its configuration without the number of
/// triangles, which is only known once it was measured.
std::string study_key(const std::vector<energy::KeyValue>& configuration);

/// Reads the session folder of a study. Throws scene::InputError if it is none, or of another
/// study than the one with this digest.
StudyProgress read_progress(const std::filesystem::path& folder, const std::string& digest);

}  // namespace encore::app
