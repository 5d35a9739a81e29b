#include "app/window/frame_statistics.h"

#include "app/window/steady_time.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

namespace encore::app {

namespace {

constexpr std::size_t kMostTimes = 100'000;
constexpr std::size_t kRecentTimes = 300;
constexpr double kRecent_s = 3.0;

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0;
  std::uint64_t resident = 0;
  if (!(file >> size >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

FrameStatistics::FrameStatistics() = default;

void FrameStatistics::add(double frame_s, double now_s) {
  times_ms_.push_back(frame_s * 1e3);
  ends_s_.push_back(now_s);
  if (times_ms_.size() > kMostTimes) {
    times_ms_.pop_front();
    ends_s_.pop_front();
  }
  marks_.push_back({now_s, processor_time()});
  while (marks_.size() > 2 && marks_.front().time_s < now_s - kRecent_s) marks_.pop_front();
  if (now_s - memory_at_s_ > 1.0) {
    memory_at_s_ = now_s;
    memory_bytes_ = resident_bytes();
  }
}

void FrameStatistics::write(std::ostream& out) const {
  if (times_ms_.empty()) return;
  const double shift = seconds_since_start() - steady_now();
  for (std::size_t i = 0; i < times_ms_.size(); ++i) {
    out << ends_s_[i] + shift << ' ' << times_ms_[i] << '\n';
  }
}

void FrameStatistics::fill(ui::WindowView& view) const {
  view.memory_bytes = memory_bytes_;
  if (times_ms_.empty()) return;
  view.frame_ms = times_ms_.back();
  const std::size_t count = std::min(times_ms_.size(), kRecentTimes);
  std::vector<double> recent(times_ms_.end() - static_cast<std::ptrdiff_t>(count), times_ms_.end());
  std::sort(recent.begin(), recent.end());
  view.frame_median_ms = recent[count / 2];
  view.frame_99_ms = recent[std::min(count - 1, count * 99 / 100)];
  if (marks_.size() < 2) return;
  const double seconds = marks_.back().time_s - marks_.front().time_s;
  if (!(seconds > 0.0)) return;
  view.frames_per_s = double(marks_.size() - 1) / seconds;
  view.processor_share = (marks_.back().processor_s - marks_.front().processor_s) / seconds;
}

double seconds_since_start() {
  std::ifstream file("/proc/self/stat");
  std::string text;
  std::getline(file, text);
  // The program's name, in brackets, may hold anything; the 20th value after it is the start.
  const std::size_t bracket = text.rfind(')');
  if (bracket == std::string::npos) return 0.0;
  std::istringstream rest(text.substr(bracket + 1));
  std::string word;
  for (int i = 0; i < 20; ++i) rest >> word;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const double ticks = double(sysconf(_SC_CLK_TCK));
  return double(now.tv_sec) + double(now.tv_nsec) * 1e-9 -
         std::strtod(word.c_str(), nullptr) / ticks;
}

}  // namespace encore::app
