#include "run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace encore::app {

namespace {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

ProgramResult run_encore(const std::vector<std::string>& arguments) {
  std::string pattern = (std::filesystem::temp_directory_path() / "encore-test-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
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
  ProgramResult result{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                       read_file(out), read_file(err)};
  std::filesystem::remove_all(folder);
  return result;
}

}  // namespace encore::app
