#include "energy/sources/timed_reader.h"

#include <cerrno>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace encore::energy {

namespace {

/// What both threads share; whoever is last lets go of it.
struct Desk {
  FileReader reader;
  std::mutex mutex;
  std::condition_variable wake;
  std::optional<std::string> request;
  std::optional<FileText> answer;
  bool busy = false;
  bool closed = false;
};

void serve(const std::shared_ptr<Desk>& desk) {
  std::unique_lock lock(desk->mutex);
  while (true) {
    desk->wake.wait(lock, [&] { return desk->closed || desk->request; });
    if (desk->closed) return;
    const std::string path = *std::exchange(desk->request, std::nullopt);
    lock.unlock();
    FileText text = desk->reader(path);
    lock.lock();
    desk->answer = std::move(text);
    desk->busy = false;
    desk->wake.notify_all();
  }
}

/// Owned by the copies of the reader; the last one ends the thread, unless it hangs.
struct Counter {
  std::shared_ptr<Desk> desk;
  explicit Counter(std::shared_ptr<Desk> d) : desk(std::move(d)) {}
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;
  ~Counter() {
    const std::scoped_lock lock(desk->mutex);
    desk->closed = true;
    desk->wake.notify_all();
  }
};

}  // namespace

FileReader timed_reader(FileReader reader, std::chrono::milliseconds limit) {
  auto desk = std::make_shared<Desk>();
  desk->reader = std::move(reader);
  std::thread([desk] { serve(desk); }).detach();
  return [counter = std::make_shared<Counter>(desk), limit](std::string_view path) -> FileText {
    Desk& own = *counter->desk;
    std::unique_lock lock(own.mutex);
    if (own.busy) return {std::nullopt, ETIMEDOUT};
    own.busy = true;
    own.answer.reset();
    own.request = std::string(path);
    own.wake.notify_all();
    own.wake.wait_for(lock, limit, [&] { return own.answer.has_value(); });
    if (!own.answer) return {std::nullopt, ETIMEDOUT};
    return *std::exchange(own.answer, std::nullopt);
  };
}

}  // namespace encore::energy
