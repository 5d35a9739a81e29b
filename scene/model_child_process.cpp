#include "scene/model_child_process.h"

#include "scene/load_watch.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <new>

namespace encore::scene {

namespace {

using Clock = std::chrono::steady_clock;

// What the child leaves at the front of the shared file once everything else is in it. Exit codes
// alone would not do: a host that ignores SIGCHLD never sees them.
enum class Mark : std::uint64_t { nothing = 0, finished = 0x656E636F72653031, no_memory };

class FileHandle {
 public:
  explicit FileHandle(int number) : number_(number) {}
  FileHandle(const FileHandle&) = delete;
  FileHandle& operator=(const FileHandle&) = delete;
  ~FileHandle() {
    if (number_ >= 0) close(number_);
  }
  [[nodiscard]] int get() const { return number_; }

 private:
  int number_;
};

bool write_all(int file, const char* bytes, std::size_t size, off_t at) {
  while (size > 0) {
    const ssize_t written = pwrite(file, bytes, size, at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool read_all(int file, char* bytes, std::size_t size, off_t at) {
  while (size > 0) {
    const ssize_t count = pread(file, bytes, size, at);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    at += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

std::uint64_t mapped_bytes() {
  unsigned long long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void lower_limit(__rlimit_resource resource, std::uint64_t value) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min<std::uint64_t>(limit.rlim_max, value);
  setrlimit(resource, &limit);
}

// A crash must end the child at once and silently, whatever handlers the host has set.
void prepare_child(const ChildLimits& limits, std::uint64_t mapped) {
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGTERM, SIGINT}) {
    std::signal(number, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere >= 0) {
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  lower_limit(RLIMIT_CORE, 0);
  lower_limit(RLIMIT_CPU, limits.cpu_seconds);
  if (mapped > 0) lower_limit(RLIMIT_AS, mapped + limits.memory_bytes);
}

[[noreturn]] void run_child(const std::function<std::string()>& work, int file) {
  Mark mark = Mark::nothing;
  LoadScope::leave_all();
  try {
    const std::string bytes = work();
    mark = Mark::finished;
    if (!write_all(file, bytes.data(), bytes.size(), sizeof(Mark))) mark = Mark::no_memory;
  } catch (const std::bad_alloc&) {
    mark = Mark::no_memory;
  } catch (...) {
    _exit(1);
  }
  write_all(file, reinterpret_cast<const char*>(&mark), sizeof(mark), 0);
  // No destructors or exit handlers of the host: its threads and devices are not ours here.
  _exit(0);
}

enum class Waited { ended, too_long, cancelled };

bool load_cancelled() {
  try {
    check_load();
  } catch (const LoadCancelled&) {
    return true;
  }
  return false;
}

// Waits until the child has ended, `deadline` has passed or the loading is to end.
Waited wait_until(pid_t child, Clock::time_point deadline, int& status) {
  constexpr std::int64_t kLookEvery = 20;  // ms
  const FileHandle handle(static_cast<int>(syscall(SYS_pidfd_open, child, 0)));
  while (true) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno == ECHILD)) return Waited::ended;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return Waited::too_long;
    if (load_cancelled()) return Waited::cancelled;
    pollfd waiting{handle.get(), POLLIN, 0};
    // Kernels without process handles: look again every millisecond.
    const bool has_handle = handle.get() >= 0;
    const std::int64_t wait = std::min<std::int64_t>(left.count(), kLookEvery);
    poll(&waiting, has_handle ? 1 : 0, has_handle ? static_cast<int>(wait) : 1);
  }
}

ChildResult collect(int file, int status) {
  using Outcome = ChildResult::Outcome;
  ChildResult result;
  result.outcome = Outcome::crashed;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) result.outcome = Outcome::out_of_time;
  Mark mark = Mark::nothing;
  if (!read_all(file, reinterpret_cast<char*>(&mark), sizeof(mark), 0)) return result;
  if (mark == Mark::no_memory) result.outcome = Outcome::out_of_memory;
  if (mark != Mark::finished) return result;

  struct stat information {};
  if (fstat(file, &information) != 0) return result;
  result.bytes.resize(static_cast<std::size_t>(information.st_size) - sizeof(Mark));
  if (read_all(file, result.bytes.data(), result.bytes.size(), sizeof(Mark))) {
    result.outcome = Outcome::finished;
  }
  return result;
}

}  // namespace

ChildResult run_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  const FileHandle file(memfd_create("encore-model", MFD_CLOEXEC));
  if (file.get() < 0) return {};
  const std::uint64_t mapped = mapped_bytes();
  const auto deadline = Clock::now() + std::chrono::seconds(limits.wall_seconds);
  const pid_t child = fork();
  if (child < 0) return {};
  if (child == 0) {
    prepare_child(limits, mapped);
    run_child(work, file.get());
  }

  int status = 0;
  const Waited waited = wait_until(child, deadline, status);
  if (waited != Waited::ended) {
    kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    ChildResult killed;
    killed.outcome = waited == Waited::cancelled ? ChildResult::Outcome::cancelled
                                                 : ChildResult::Outcome::out_of_time;
    return killed;
  }
  return collect(file.get(), status);
}

}  // namespace encore::scene
