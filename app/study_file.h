#pragma once

#include "app/measuring_options.h"
#include "app/profile_options.h"
#include "scene/diagnostics.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace encore::app {

/// A part of a study: every combination of its lists is a test.
struct StudyGroup {
  std::string name;
  std::string place;                 ///< "file:line:column"
  std::vector<std::string> devices;  ///< "cpu", "gpu", "raster"
  std::vector<std::string> scenes;
  std::vector<std::string> structures;
  std::vector<std::string> policies;
  std::vector<std::string> tests;
  std::vector<std::string> sizes;          ///< "256" or "640x480"
  std::vector<std::string> memory;         ///< "pool", "malloc"
  std::vector<std::string> update_cases;   ///< empty: real
  std::vector<std::string> settings;       ///< "key=value"
  std::vector<std::string> intersections;  ///< names of modes; empty: the scene's own
  std::vector<std::string> presets;        ///< of bvh-sah; empty: what `set` says
  std::string build_on = "auto";           ///< as --build-on takes it
  std::vector<std::string> groupings;      ///< of rays; empty: packets
  std::vector<std::string> rays;           ///< each as --rays takes it; {""}: the scene's own
  std::vector<std::string> samples;        ///< likewise
  std::string depth;                       ///< likewise
  int threads = 0;
};

/// A study as its file describes it: what the thesis' description files and batch files held.
struct Study {
  std::string name;
  std::string file;
  std::string digest;  ///< of the file's text: a study that is gone on with must be the same
  MeasuringOptions measuring;
  std::vector<std::string> search_path;  ///< where scenes look for models
  std::vector<StudyGroup> groups;
};

/// The file itself, or else the study of that name that ships with the program (assets/studies).
/// Throws scene::InputError that lists those.
std::filesystem::path find_study(const std::string& name_or_path);

/// Reads a study (docs/studies.md tells the keys). Every word is checked. Throws scene::InputError
/// "file:line:column: ..."; unknown keys are errors, too, since a study may run for days.
Study read_study(const std::filesystem::path& file);
Study parse_study(std::string_view text, const std::string& file);

}  // namespace encore::app
