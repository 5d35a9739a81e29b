#include "energy/sampling/sampler.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

namespace encore::energy {

namespace {

Seconds read_clock(clockid_t id) {
  timespec time{};
  clock_gettime(id, &time);
  return Seconds(static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9);
}

/// More than scheduling can explain between two readings of two clocks.
constexpr Seconds kSuspend(0.5);

}  // namespace

Seconds boot_time() {
  return read_clock(CLOCK_BOOTTIME);
}

struct Sampler::Channel {
  explicit Channel(std::unique_ptr<PowerSource> from) : source(std::move(from)) {}

  std::unique_ptr<PowerSource> source;
  Trace trace;
  Seconds next;          ///< when it is due
  bool failing = false;  ///< its last reading failed: told once, not at every poll
  std::atomic<bool> lost = false;
};

Sampler::Sampler(std::vector<std::unique_ptr<PowerSource>> sources, const Clock& clock,
                 SamplerSink sink, std::function<Seconds()> boot)
    : clock_(clock), sink_(std::move(sink)), boot_(std::move(boot)), start_(clock.now()) {
  for (auto& source : sources) {
    channels_.push_back(std::make_unique<Channel>(std::move(source)));
    channels_.back()->next = start_;
  }
}

Sampler::~Sampler() = default;

bool Sampler::check_suspend(Seconds now) {
  if (!boot_) return false;
  const Seconds offset = boot_() - now;
  const bool suspended = boot_offset_ && offset - *boot_offset_ > kSuspend;
  if (suspended && sink_.on_event) {
    sink_.on_event({now, "",
                    "the machine was suspended for " +
                        std::to_string(std::lround((offset - *boot_offset_).value)) +
                        " s; this stretch is a gap"});
  }
  boot_offset_ = offset;
  return suspended;
}

void Sampler::read(Channel& channel, Seconds now, bool suspended) {
  const SourceInfo& info = channel.source->info();
  ReadResult result = channel.source->read(now);
  if (suspended && result.state == ReadState::ok) {
    result.state = ReadState::restarted;
    result.message = info.name + ": the machine was suspended";
  }
  const bool good = result.state == ReadState::ok || result.state == ReadState::restarted;
  if (good) {
    channel.trace.add(result.reading, result.state == ReadState::restarted);
  } else {
    channel.trace.add_gap();
  }
  if (sink_.on_reading) sink_.on_reading(info, result);
  const bool news = result.state == ReadState::restarted || (!good && !channel.failing);
  if (news && !suspended && sink_.on_event) sink_.on_event({now, info.name, result.message});
  channel.failing = !good;
  if (result.state == ReadState::lost) channel.lost = true;
}

Seconds Sampler::poll() {
  const std::lock_guard lock(mutex_);
  const Seconds before = read_clock(CLOCK_THREAD_CPUTIME_ID);
  const Seconds now = clock_.now();
  const bool suspended = check_suspend(now);
  Seconds next = now + Seconds(1.0);
  for (const auto& channel : channels_) {
    if (channel->lost) continue;
    if (suspended || channel->next <= now) {
      read(*channel, clock_.now(), suspended);
      // Keeps its own beat; beats missed while the machine was busy are not made up for.
      channel->next += channel->source->info().poll_period;
      if (channel->next <= now) channel->next = now + channel->source->info().poll_period;
    }
    next = std::min(next, channel->next);
  }
  ++polls_;
  processor_ += read_clock(CLOCK_THREAD_CPUTIME_ID) - before;
  return next;
}

void Sampler::read_now(Seconds slowest) {
  const std::lock_guard lock(mutex_);
  const Seconds before = read_clock(CLOCK_THREAD_CPUTIME_ID);
  const bool suspended = check_suspend(clock_.now());
  for (const auto& channel : channels_) {
    const bool slow = slowest.value > 0 && channel->source->info().update_period > slowest;
    if (channel->lost || (slow && !suspended)) continue;
    read(*channel, clock_.now(), suspended);
  }
  processor_ += read_clock(CLOCK_THREAD_CPUTIME_ID) - before;
}

const SourceInfo& Sampler::info(std::size_t source) const {
  return channels_.at(source)->source->info();
}
const Trace& Sampler::trace(std::size_t source) const {
  return channels_.at(source)->trace;
}
bool Sampler::lost(std::size_t source) const {
  return channels_.at(source)->lost;
}

SamplerCost Sampler::cost() const {
  const std::lock_guard lock(mutex_);
  return {processor_, clock_.now() - start_, polls_};
}

SamplerThread::SamplerThread(Sampler& sampler, const Clock& clock)
    : sampler_(sampler), clock_(clock), thread_([this] {
        std::unique_lock lock(mutex_);
        while (!stop_) {
          lock.unlock();
          const Seconds wait = sampler_.poll() - clock_.now();
          lock.lock();
          wake_.wait_for(lock, std::chrono::duration<double>(std::max(wait.value, 0.0)),
                         [this] { return stop_; });
        }
      }) {}

SamplerThread::~SamplerThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

}  // namespace encore::energy
