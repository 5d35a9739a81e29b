#include "run_program.h"

#include "tests/support/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace encore::app {

ProgramResult run_encore(const std::vector<std::string>& arguments) {
  const test::TemporaryFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  const std::string out = folder / "out.txt";
  const std::string err = folder / "err.txt";

  std::vector<char*> argv{const_cast<char*>(ENCORE_BINARY)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    setenv("HOME", folder.c_str(), 1);
    unsetenv("XDG_DATA_HOME");
    if (chdir(folder.c_str()) != 0) _exit(126);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), test::contents_of(out),
          test::contents_of(err)};
}

}  // namespace encore::app
