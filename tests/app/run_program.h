#pragma once

#include <string>
#include <vector>

namespace encore::app {

/// What a run of the program left behind.
struct ProgramResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built program with these arguments in an empty scratch folder (its home, too, so that
/// nothing outside is touched) and waits for it.
ProgramResult run_encore(const std::vector<std::string>& arguments);

}  // namespace encore::app
