#pragma once

#include "app/study_file.h"
#include "app/workloads.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// Tests of a group that are not measured, and why.
struct LeftOut {
  std::string group;
  std::size_t tests = 0;
  std::string reason;
};

/// A study spelled out.
struct StudyMatrix {
  std::vector<WorkloadSpec> tests;  ///< each once; the plan's repeats come on top
  std::vector<LeftOut> left_out;
  std::optional<GpuInfo> gpu;  ///< of the tests that draw with OpenGL, if there are any
  /// Tests that the study describes, measured or not.
  [[nodiscard]] std::size_t described() const;
};

/// Opens every scene of the study once and lists its tests, group by group. Where there is no
/// OpenGL, the tests of devices that need it are left out. Throws
/// scene::InputError that names the group's place for a scene that cannot be read.
StudyMatrix spell_out(const Study& study, const WorkloadTools& tools, Terminal& terminal);

}  // namespace encore::app
