#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace encore::test {

/// Whether this machine gives pseudo terminals out.
inline bool has_pseudo_terminals() {
  const int line = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (line < 0) return false;
  const bool works = ::grantpt(line) == 0 && ::unlockpt(line) == 0 && ::ptsname(line) != nullptr;
  ::close(line);
  return works;
}

/// A meter at the other end of a pseudo terminal: what it is asked goes to a function, and the
/// pieces that this returns go back one by one. Questions end with a line break; single bytes
/// without one are questions of their own.
class PseudoMeter {
 public:
  using Answer = std::function<std::vector<std::string>(const std::string& asked)>;

  explicit PseudoMeter(Answer answer) : answer_(std::move(answer)) {
    line_ = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (line_ < 0 || ::grantpt(line_) != 0 || ::unlockpt(line_) != 0) {
      throw std::runtime_error("no pseudo terminal");
    }
    device_ = ::ptsname(line_);
    // Keeps the line up while nobody has it open, and from echoing what comes early.
    other_end_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY);
    termios settings{};
    ::tcgetattr(other_end_, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(other_end_, TCSANOW, &settings);
    thread_ = std::thread([this] { serve(); });
  }
  ~PseudoMeter() {
    stop();
    ::close(other_end_);
    ::close(line_);
  }
  PseudoMeter(const PseudoMeter&) = delete;
  PseudoMeter& operator=(const PseudoMeter&) = delete;

  [[nodiscard]] const std::string& device() const { return device_; }

  /// Returns once so many questions were answered (or met with silence) and the last answer can be
  /// read: a pseudo terminal passes bytes on in its own time. CONF commands do not count.
  void wait_for_answers(int count) {
    std::unique_lock lock(mutex_);
    answered_changed_.wait(lock, [&] { return answered_ >= count; });
    for (int ready = 0; ready < last_size_; ::ioctl(other_end_, FIONREAD, &ready)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  void serve() {
    std::string pending;
    while (!stop_) {
      pollfd state{line_, POLLIN, 0};
      if (::poll(&state, 1, 5) <= 0) continue;
      std::array<char, 256> buffer{};
      const ssize_t got = ::read(line_, buffer.data(), buffer.size());
      if (got <= 0) continue;
      pending.append(buffer.data(), static_cast<std::size_t>(got));
      reply(pending);
    }
  }

  void reply(std::string& pending) {
    while (!pending.empty()) {
      const std::size_t end = pending.find('\n');
      const bool line = end != std::string::npos;
      if (!line && pending.size() > 1) return;
      const std::string asked = line ? pending.substr(0, end + 1) : pending;
      if (!line && asked != "\xf0" && asked != "?") return;
      pending.erase(0, asked.size());
      int size = 0;
      for (const std::string& piece : answer_(asked)) {
        if (::write(line_, piece.data(), piece.size()) < 0) return;
        size += static_cast<int>(piece.size());
      }
      const std::lock_guard lock(mutex_);
      last_size_ = size;
      if (asked.find("CONF") == std::string::npos) ++answered_;
      answered_changed_.notify_all();
    }
  }

  Answer answer_;
  int line_ = -1;
  int other_end_ = -1;
  std::string device_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable answered_changed_;
  int answered_ = 0;
  int last_size_ = 0;
  std::thread thread_;
};

}  // namespace encore::test
