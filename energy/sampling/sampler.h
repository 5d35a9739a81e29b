#pragma once

#include "energy/clock.h"
#include "energy/sampling/trace.h"
#include "energy/sources/power_source.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace encore::energy {

/// Something worth a line while sampling: a gap, a counter reset, a sensor that vanished, a
/// suspend.
struct SamplerEvent {
  Seconds time;
  std::string source;  ///< empty: the machine
  std::string message;
};

/// What the sampler tells; any may be empty. Called on the thread that sampled, one at a time.
struct SamplerSink {
  /// Every reading, for samples.csv.
  std::function<void(const SourceInfo&, const ReadResult&)> on_reading;
  std::function<void(const SamplerEvent&)> on_event;
};

/// What sampling itself cost.
struct SamplerCost {
  Seconds processor;  ///< processor time of all polls
  Seconds elapsed;    ///< since the start
  std::uint64_t polls = 0;
  /// Share of one core, 0.005 is 0.5 %.
  [[nodiscard]] double share() const { return elapsed.value > 0 ? processor / elapsed : 0.0; }
};

/// Tells a suspended machine from a running one: seconds that pass during suspend, too
/// (CLOCK_BOOTTIME). Tests put their own in its place.
Seconds boot_time();

/// Reads each source at its own poll period into its trace. Without a thread it is driven by
/// poll(); SamplerThread drives it in the program.
class Sampler {
 public:
  /// Takes the sources over. `boot` is asked at every poll.
  Sampler(std::vector<std::unique_ptr<PowerSource>> sources, const Clock& clock,
          SamplerSink sink = {}, std::function<Seconds()> boot = boot_time);
  ~Sampler();

  /// Reads every source whose poll period has passed; the time of the next one that is due.
  Seconds poll();
  /// Reads every source that still lives right now, whatever its period: at the edges of windows.
  /// `slowest` limits that to sources whose update period is at most so long (0: all).
  void read_now(Seconds slowest = Seconds(0));

  [[nodiscard]] std::size_t source_count() const { return channels_.size(); }
  [[nodiscard]] const SourceInfo& info(std::size_t source) const;
  [[nodiscard]] const Trace& trace(std::size_t source) const;
  [[nodiscard]] bool lost(std::size_t source) const;
  [[nodiscard]] SamplerCost cost() const;

 private:
  struct Channel;
  void read(Channel& channel, Seconds now, bool suspended);
  bool check_suspend(Seconds now);

  std::vector<std::unique_ptr<Channel>> channels_;
  const Clock& clock_;
  SamplerSink sink_;
  std::function<Seconds()> boot_;
  mutable std::mutex mutex_;
  Seconds start_;
  std::optional<Seconds> boot_offset_;
  Seconds processor_;
  std::uint64_t polls_ = 0;
};

/// Polls a sampler on a thread of its own from construction to destruction.
class SamplerThread {
 public:
  explicit SamplerThread(Sampler& sampler, const Clock& clock);
  ~SamplerThread();
  SamplerThread(const SamplerThread&) = delete;
  SamplerThread& operator=(const SamplerThread&) = delete;

 private:
  Sampler& sampler_;
  const Clock& clock_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace encore::energy
