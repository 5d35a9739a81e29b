#include "app/window/recorder.h"

#include "app/profile_folder.h"
#include "app/window/recording_queue.h"
#include "app/window/recording_writer.h"
#include "energy/machine.h"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace encore::app {

namespace {

using energy::Seconds;

constexpr std::chrono::milliseconds kWriteEvery(100);
constexpr Seconds kCheckEvery(1.0);

/// The window lets configurations take turns for as long as the user likes: it has no plan.
energy::Plan window_plan() {
  energy::Plan plan;
  plan.name = "window";
  plan.warm_up = plan.run = Seconds(0);
  plan.warm_up_operations = plan.min_operations = 0;
  return plan;
}

energy::SessionInfo info_of(const RecordingSetup& setup) {
  energy::SessionInfo info;
  info.program = "encore " ENCORE_VERSION;
  info.command_line = setup.command_line.empty() ? energy::read_command_line() : setup.command_line;
  info.started_utc = utc_now();
  info.machine = energy::read_machine();
  info.plan = window_plan();
  info.sensor.detail = "no power source was open yet";
  info.scenes = setup.scenes;
  info.settings = setup.settings;
  return info;
}

}  // namespace

std::string_view to_string(RecorderMode mode) {
  switch (mode) {
    case RecorderMode::off:
      return "off";
    case RecorderMode::starting:
      return "starting";
    case RecorderMode::recording:
      return "recording";
    case RecorderMode::paused:
      return "paused";
    case RecorderMode::stopping:
      return "stopping";
    case RecorderMode::failed:
      return "failed";
  }
  return "";
}

struct Recorder::Impl {
  Impl(Recorder& me, PowerMonitor& from, LiveAttribution& live)
      : self(me), monitor(from), attribution(live) {}

  /// The whole of a recording, on a thread of its own.
  void record(const RecordingSetup& setup);
  void write_until_stopped(RecordingWriter& writer);
  /// Writes what the queue holds.
  void flush(RecordingWriter& writer);
  void look_around(RecordingWriter& writer, Seconds now);
  void begin_hearing();
  void end_hearing();

  void set_mode(RecorderMode mode, std::string message = {}) {
    const std::lock_guard lock(mutex);
    state.mode = mode;
    if (!message.empty()) state.message = std::move(message);
  }

  Recorder& self;
  PowerMonitor& monitor;
  LiveAttribution& attribution;
  RecordingQueue queue;
  mutable std::mutex mutex;  ///< of what follows
  std::condition_variable wake;
  RecorderState state;
  bool stop = false;
  std::uint64_t generation = 0;  ///< of the sources that session.toml tells of
  std::optional<Seconds> checked;
  std::thread thread;
};

void Recorder::Impl::begin_hearing() {
  energy::SamplerSink sink;
  sink.on_reading = [this](const auto& info, const auto& result) { queue.reading(info, result); };
  sink.on_event = [this](const auto& event) { queue.event(event); };
  monitor.set_sink(std::move(sink));
  attribution.tell(&self);
}

void Recorder::Impl::end_hearing() {
  attribution.tell(nullptr);
  monitor.set_sink({});
}

void Recorder::Impl::flush(RecordingWriter& writer) {
  const std::vector<RecordedRow> rows = queue.take();
  writer.write(rows);
  std::uint64_t samples = 0;
  std::uint64_t frames = 0;
  for (const RecordedRow& row : rows) {
    samples += std::holds_alternative<energy::SampleRow>(row) ? 1 : 0;
    frames += std::holds_alternative<energy::FrameRow>(row) ? 1 : 0;
  }
  const std::lock_guard lock(mutex);
  state.samples += samples;
  state.rows += frames;
  state.seconds = queue.seconds(monitor.clock().now()).value;
}

void Recorder::Impl::look_around(RecordingWriter& writer, Seconds now) {
  if (checked && now - *checked < kCheckEvery) return;
  checked = now;
  writer.check(now);
  const std::uint64_t bytes = writer.bytes();
  const std::lock_guard lock(mutex);
  state.bytes = bytes;
}

void Recorder::Impl::write_until_stopped(RecordingWriter& writer) {
  std::unique_lock lock(mutex);
  while (!stop) {
    lock.unlock();
    const auto power = monitor.current();
    if (power && power->generation != generation) {
      generation = power->generation;
      writer.use(*power);
    }
    flush(writer);
    look_around(writer, monitor.clock().now());
    lock.lock();
    wake.wait_for(lock, kWriteEvery, [this] { return stop; });
  }
}

void Recorder::Impl::record(const RecordingSetup& setup) {
  std::unique_ptr<RecordingWriter> writer;
  try {
    const Seconds start = monitor.clock().now();
    writer = std::make_unique<RecordingWriter>(setup.folder, setup.name, info_of(setup), start);
    {
      const std::lock_guard lock(mutex);
      state.folder = writer->folder();
    }
    queue.begin(start);
    begin_hearing();
    set_mode(RecorderMode::recording);
    write_until_stopped(*writer);
    set_mode(RecorderMode::stopping);
    end_hearing();
    flush(*writer);
    const Seconds now = monitor.clock().now();
    writer->write_figures(queue.book().compute(now), now);
    checked.reset();
    look_around(*writer, now);
    writer->finish(energy::SessionState::complete);
    set_mode(RecorderMode::off, "recorded");
  } catch (const std::exception& error) {
    end_hearing();
    const std::string kept =
        writer ? fmt::format("; what was recorded before is kept in {}", writer->folder().string())
               : std::string();
    try {
      if (writer) writer->finish(energy::SessionState::failed);
    } catch (const std::exception&) {
      // A disk that is full takes no such word either: the state stays `running`, as of a kill.
    }
    set_mode(RecorderMode::failed, fmt::format("recording stopped: {}{}", error.what(), kept));
  }
  queue.end();
}

Recorder::Recorder(PowerMonitor& monitor, LiveAttribution& attribution)
    : impl_(std::make_unique<Impl>(*this, monitor, attribution)) {}

Recorder::~Recorder() {
  stop();
  wait();
}

void Recorder::start(RecordingSetup setup) {
  const RecorderMode mode = state().mode;
  if (mode != RecorderMode::off && mode != RecorderMode::failed) return;
  // The thread of the one before has told its end: joining it takes no time.
  wait();
  impl_->state = {};
  impl_->state.mode = RecorderMode::starting;
  impl_->stop = false;
  impl_->generation = 0;
  impl_->checked.reset();
  impl_->thread =
      std::thread([impl = impl_.get(), setup = std::move(setup)] { impl->record(setup); });
}

void Recorder::pause() {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->state.mode != RecorderMode::recording) return;
  impl_->queue.pause(impl_->monitor.clock().now());
  impl_->state.mode = RecorderMode::paused;
}

void Recorder::resume() {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->state.mode != RecorderMode::paused) return;
  impl_->queue.resume(impl_->monitor.clock().now());
  impl_->state.mode = RecorderMode::recording;
}

void Recorder::annotate(std::string text) {
  impl_->queue.note(impl_->monitor.clock().now(), std::move(text));
}

void Recorder::stop() {
  {
    const std::lock_guard lock(impl_->mutex);
    const RecorderMode mode = impl_->state.mode;
    if (mode == RecorderMode::off || mode == RecorderMode::failed) return;
    impl_->stop = true;
    if (mode != RecorderMode::starting) impl_->state.mode = RecorderMode::stopping;
  }
  impl_->wake.notify_all();
}

void Recorder::wait() {
  if (impl_->thread.joinable()) impl_->thread.join();
}

RecorderState Recorder::state() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->state;
}

void Recorder::add(const energy::FrameRow& row) {
  impl_->queue.frame(row);
}
void Recorder::slot_began(const Slot& slot, const std::shared_ptr<const PowerSet>& power,
                          Seconds now) {
  impl_->queue.slot_began(slot, power, now);
}
void Recorder::operation(const Operation& operation) {
  impl_->queue.operation(operation);
}
void Recorder::row(const energy::FrameRow& row) {
  impl_->queue.row(row);
}
void Recorder::slot_ended(Seconds now) {
  impl_->queue.slot_ended(now);
}

}  // namespace encore::app
