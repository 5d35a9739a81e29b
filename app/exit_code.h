#pragma once

#include <stdexcept>

namespace encore::app {

/// Exit codes of the program (documented in --help and README).
enum class ExitCode : int {
  ok = 0,
  failure = 1,
  usage = 2,
  bad_input = 3,
  no_sensor = 4,
  no_display = 5,
  mismatch = 6,
  regression = 7,
  interrupted = 130,
};

/// A wrong option or value that only shows after parsing. what() is the whole message for the user.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace encore::app
