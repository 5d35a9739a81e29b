#pragma once

#include "app/machine_log.h"
#include "app/window/slot_book.h"
#include "energy/session_csv.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <variant>
#include <vector>

namespace encore::app {

/// A row that waits to be written.
using RecordedRow =
    std::variant<energy::SampleRow, energy::FrameRow, energy::WindowRow, energy::EventRow>;

/// The files of a recording. Used by one thread.
class RecordingWriter {
 public:
  /// Makes the folder and begins the session in it; `session_start`: the clock's time that rows
  /// count from. Throws energy::SessionError or UsageError.
  RecordingWriter(const std::filesystem::path& wanted, const std::string& name,
                  energy::SessionInfo info, energy::Seconds session_start);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// Writes rows, each handed to the system by itself. Throws energy::SessionError.
  void write(const std::vector<RecordedRow>& rows);
  /// Once a second or so: reads the machine, and checks that the folder is still there. Throws
  /// energy::SessionError.
  void check(energy::Seconds now);
  /// Puts what is read now into session.toml: sources that are new are added to those before.
  void use(const PowerSet& power);
  /// The figures, at the end, and a word in events.csv for each note.
  void write_figures(const Figures& figures, energy::Seconds now);
  void finish(energy::SessionState state);
  /// Size of all files.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  std::filesystem::path folder_;
  energy::Seconds start_;
  energy::SessionInfo info_;
  std::unique_ptr<energy::SessionWriter> writer_;
  std::unique_ptr<MachineLog> machine_log_;
};

}  // namespace encore::app
