#pragma once

#include "app/window/live_attribution.h"
#include "app/window/power_monitor.h"
#include "app/window/slots.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace encore::app {

/// What is to be recorded, and where.
struct RecordingSetup {
  std::filesystem::path folder;  ///< new or empty; no path: a new one as `encore profile` names it
  std::string name;              ///< of the automatic folder: the scene
  std::string command_line;      ///< empty: the program's own
  std::vector<std::string> scenes;
  std::vector<energy::KeyValue> settings;  ///< that hold for every configuration
};

enum class RecorderMode { off, starting, recording, paused, stopping, failed };
std::string_view to_string(RecorderMode mode);

/// For the panel; cheap to ask every frame.
struct RecorderState {
  RecorderMode mode = RecorderMode::off;
  std::filesystem::path folder;  ///< of the recording under way, or of the last one
  double seconds = 0.0;          ///< recorded, pauses left out
  std::uint64_t samples = 0;     ///< rows of samples.csv
  std::uint64_t rows = 0;        ///< rows of frames.csv
  std::uint64_t bytes = 0;       ///< of all files
  /// If failed: one line on what went wrong and what is left; else empty or how it ended.
  std::string message;
};

/// Writes what the window measures into a session folder (docs/session-format.md), with the same
/// columns as `encore profile`.
///
/// All writing is done by a thread of the recorder's own, ten times a second; being told is a push
/// to a queue. A kill at any moment loses what the queue held: at most a second. summary.csv,
/// phases.csv and convergence.csv are written by stop(); of a session that was killed they are
/// computed when it is opened (opened_session.h). A disk that is full or a folder that has gone
/// ends the recording with one line; measuring goes on.
class Recorder final : public SlotListener {
 public:
  /// Both must outlive it.
  Recorder(PowerMonitor& monitor, LiveAttribution& attribution);
  ~Recorder() override;  ///< stops
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Begins a recording; what is wrong with the folder shows in state(). Nothing if one runs.
  void start(RecordingSetup setup);
  /// While paused nothing is written; the samples behind it begin a new stretch.
  void pause();
  void resume();
  /// Writes the user's words to events.csv.
  void annotate(std::string text);
  /// Ends the recording: the rest of the queue, then the figures. Returns at once.
  void stop();
  /// Blocks until nothing more is to be written; for tests and the end of the program.
  void wait();

  [[nodiscard]] RecorderState state() const;

  /// Rows that were not measured in slots (explore mode); time on the monitor's clock.
  void add(const energy::FrameRow& row);

  void slot_began(const Slot& slot, const std::shared_ptr<const PowerSet>& power,
                  energy::Seconds now) override;
  void operation(const Operation& operation) override;
  void row(const energy::FrameRow& row) override;
  void slot_ended(energy::Seconds now) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace encore::app
