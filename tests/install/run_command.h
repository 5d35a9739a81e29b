#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

namespace encore::test {

struct CommandResult {
  int exit_code = -1;
  std::string output;  ///< of both streams
};

/// Runs a command of the shell and waits for it.
inline CommandResult run_command(const std::string& command) {
  CommandResult result;
  std::FILE* pipe = popen(("{ " + command + "; } 2>&1").c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> buffer{};
  std::size_t count = 0;
  while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0) {
    result.output.append(buffer.data(), count);
  }
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

/// A word for the shell.
inline std::string shell_word(std::string_view word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// What `encore --help` prints.
inline std::string help_text() {
  return run_command(shell_word(ENCORE_BINARY) + " --help").output;
}

}  // namespace encore::test
