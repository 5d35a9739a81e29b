#include "encore_process.h"

#include "eventually.h"
#include "tests/support/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace encore::test {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');) fields.push_back(field);
  return fields;
}

void set_environment(const EncoreProcess::Setup& setup) {
  // A person's own settings and desktop must not show through.
  for (const char* name : {"WAYLAND_DISPLAY", "XDG_SESSION_TYPE", "XDG_PICTURES_DIR",
                           "XDG_CURRENT_DESKTOP", "GDK_SCALE", "DISPLAY"}) {
    unsetenv(name);
  }
  if (!setup.display.empty()) setenv("DISPLAY", setup.display.c_str(), 1);
  const fs::path& home = setup.home;
  setenv("HOME", home.c_str(), 1);
  setenv("XDG_CONFIG_HOME", (home / ".config").c_str(), 1);
  setenv("XDG_STATE_HOME", (home / ".local/state").c_str(), 1);
  setenv("XDG_DATA_HOME", (home / ".local/share").c_str(), 1);
  setenv("XDG_CACHE_HOME", (home / ".cache").c_str(), 1);
  setenv("XDG_RUNTIME_DIR", home.c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  for (const auto& [name, value] : setup.environment) setenv(name.c_str(), value.c_str(), 1);
}

}  // namespace

const Widget* WidgetMap::find(std::string_view name) const {
  const auto found = std::find_if(widgets.begin(), widgets.end(),
                                  [name](const Widget& widget) { return widget.name == name; });
  return found == widgets.end() ? nullptr : &*found;
}

std::string WidgetMap::state(std::string_view name) const {
  const Widget* found = find(name);
  return found == nullptr ? std::string() : found->state;
}

std::string WidgetMap::states(std::string_view prefix) const {
  std::string all;
  for (const Widget& widget : widgets) {
    if (widget.name.starts_with(prefix)) all += widget.state + "\n";
  }
  return all;
}

WidgetMap read_widget_map(const fs::path& file) {
  WidgetMap map;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> fields = split(line);
    if (fields.size() >= 3 && fields[0] == "frame" && map.frame == 0) {
      map.frame = std::stoull(fields[1]);
      map.busy = fields[2] == "busy";
    } else if (fields.size() >= 5) {
      map.widgets.push_back({fields[0], std::stoi(fields[1]), std::stoi(fields[2]),
                             std::stoi(fields[3]), std::stoi(fields[4]),
                             fields.size() > 5 ? fields[5] : std::string()});
    }
  }
  return map;
}

EncoreProcess::EncoreProcess(const Setup& setup)
    : map_file_(setup.home / "widgets.tsv"),
      out_(setup.home / "out.txt"),
      err_(setup.home / "err.txt") {
  std::error_code ignored;
  fs::remove(map_file_, ignored);
  std::vector<std::string> words{ENCORE_BINARY};
  words.insert(words.end(), setup.arguments.begin(), setup.arguments.end());
  words.insert(words.end(), {"--widget-map", map_file_.string(), "--gl-debug"});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  process_ = fork();
  if (process_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  set_environment(setup);
  if (chdir(setup.home.c_str()) != 0) _exit(126);
  dup2(open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  dup2(open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  execv(argv[0], argv.data());
  _exit(127);
}

EncoreProcess::~EncoreProcess() {
  if (!running()) return;
  signal(SIGKILL);
  waitpid(process_, nullptr, 0);
}

void EncoreProcess::signal(int number) const {
  if (!code_) kill(process_, number);
}

bool EncoreProcess::running() {
  if (code_) return false;
  int status = 0;
  if (waitpid(process_, &status, WNOHANG) != process_) return true;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return false;
}

std::optional<int> EncoreProcess::wait(std::chrono::milliseconds patience) {
  eventually([this] { return !running(); }, patience);
  return code_;
}

std::string EncoreProcess::out() const {
  return contents_of(out_);
}

std::string EncoreProcess::err() const {
  return contents_of(err_);
}

}  // namespace encore::test
