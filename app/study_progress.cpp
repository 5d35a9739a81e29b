#include "app/study_progress.h"

#include "app/session_input.h"
#include "scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>

namespace encore::app {

std::string study_key(const std::vector<energy::KeyValue>& configuration) {
  std::string key;
  for (const energy::KeyValue& part : configuration) {
    if (part.key != "triangles") key += part.key + "=" + part.value + "\n";
  }
  return key;
}

StudyProgress read_progress(const std::filesystem::path& folder, const std::string& digest) {
  const energy::Session session = open_session(folder.string());
  StudyProgress progress;
  progress.info = session.info;
  const auto& settings = session.info.settings;
  const auto entry = std::find_if(settings.begin(), settings.end(), [](const auto& setting) {
    return setting.key == "study_digest";
  });
  if (entry == settings.end()) {
    throw scene::InputError(fmt::format("{} is not the session of a study", folder.string()));
  }
  if (entry->value != digest) {
    throw scene::InputError(fmt::format(
        "{} belongs to another version of the study: its file has changed since; start anew "
        "without --resume",
        folder.string()));
  }
  for (const energy::SummaryRow& row : session.summaries) {
    progress.done.insert(study_key(row.configuration));
  }
  const auto reach = [&](energy::Seconds time) {
    progress.reached = std::max(progress.reached, time);
  };
  for (const energy::FrameRow& row : session.frames) {
    reach(row.time + row.total() * static_cast<double>(row.operations));
  }
  if (!session.samples.empty()) reach(session.samples.back().time);
  if (!session.events.empty()) reach(session.events.back().time);
  return progress;
}

}  // namespace encore::app
