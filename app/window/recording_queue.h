#pragma once

#include "app/window/power_point.h"
#include "app/window/recording_writer.h"
#include "app/window/slot_book.h"
#include "energy/sampling/sampler.h"

#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace encore::app {

/// What is to be recorded, from all threads, until the recorder's own writes it. Turns the clock's
/// times into those of the session, leaves out pauses, and keeps a book for the figures at the end.
class RecordingQueue {
 public:
  RecordingQueue();
  ~RecordingQueue();

  /// Forgets everything and takes what comes from now on.
  void begin(energy::Seconds session_start);
  /// Takes nothing any more.
  void end();
  void pause(energy::Seconds now);
  void resume(energy::Seconds now);
  /// Recorded so far, pauses left out.
  [[nodiscard]] energy::Seconds seconds(energy::Seconds now) const;

  void reading(const energy::SourceInfo& info, const energy::ReadResult& result);
  void event(const energy::SamplerEvent& event);
  void note(energy::Seconds now, std::string text);
  void frame(const energy::FrameRow& row);

  void slot_began(const Slot& slot, const std::shared_ptr<const PowerSet>& power,
                  energy::Seconds now);
  void operation(const Operation& operation);
  void row(const energy::FrameRow& row);
  void slot_ended(energy::Seconds now);

  /// The rows since the last call. Throws energy::SessionError if they were more than memory is
  /// set aside for: the disk does not keep up.
  std::vector<RecordedRow> take();
  [[nodiscard]] SlotBook& book() { return *book_; }

 private:
  [[nodiscard]] bool takes() const { return open_ && !paused_since_; }
  void push(RecordedRow row);
  void close_slot(energy::Seconds now);
  void open_slot(energy::Seconds now);
  void push_window(const std::vector<energy::KeyValue>& configuration, const char* kind,
                   const energy::Window& window);

  mutable std::mutex mutex_;
  bool open_ = false;
  energy::Seconds start_;
  energy::Seconds pauses_;
  std::optional<energy::Seconds> paused_since_;
  std::vector<RecordedRow> rows_;
  bool overflowed_ = false;
  PowerPoints points_;
  std::set<std::string> continued_;  ///< sources whose last reading was recorded, too

  /// The slot under way, as it was told; paused it goes on without being recorded.
  std::optional<Slot> slot_;
  std::shared_ptr<const PowerSet> power_;
  std::optional<energy::Seconds> slot_start_;  ///< of the part that is recorded
  std::vector<energy::KeyValue> last_measured_;
  std::optional<energy::Window> idle_before_;  ///< an idle slot that the next configuration shares
  std::unique_ptr<SlotBook> book_;
};

}  // namespace encore::app
