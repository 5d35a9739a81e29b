#pragma once

#include "energy/csv.h"
#include "energy/session.h"
#include "energy/session_columns.h"
#include "energy/session_energy_columns.h"

#include <filesystem>

namespace encore::energy {

/// Writes a session folder as it is measured (docs/session-format.md). Every row is in the hands
/// of the system when add() returns, so the end of the program, however sudden, loses none of them:
/// at most the row being measured, that is 10 ms or one operation.
class SessionWriter {
 public:
  /// Writes session.toml and the headers into `folder`, which exists and is empty, or goes on with
  /// the session that lies there. Throws SessionError.
  SessionWriter(const std::filesystem::path& folder, SessionInfo info,
                const SessionColumns& columns, CsvWriter::Open open = CsvWriter::Open::create);

  /// Throw SessionError (disk full, folder gone). Each file may be written by a thread of its own.
  void add(const FrameRow& row) { frames_.write(to_record(row)); }
  void add(const SummaryRow& row) { summary_.write(to_record(row)); }
  void add(const PhaseRow& row) { phases_.write(to_record(row)); }
  void add(const WindowRow& row) { windows_.write(to_record(row)); }
  void add(const ConvergenceRow& row) { convergence_.write(to_record(row)); }
  void add(const SampleRow& row) { samples_.write(to_record(row)); }
  void add(const EventRow& row) { events_.write(to_record(row)); }

  /// Changes what session.toml says (sampling cost, settings found out later). Throws SessionError.
  void update(const SessionInfo& info);
  /// Notes in session.toml how the session ended. Throws SessionError.
  void finish(SessionState state);

 private:
  std::filesystem::path folder_;
  SessionInfo info_;
  CsvWriter samples_;
  CsvWriter frames_;
  CsvWriter summary_;
  CsvWriter phases_;
  CsvWriter windows_;
  CsvWriter convergence_;
  CsvWriter events_;
};

/// Reads a session folder back; a session that was cut off reads up to its last whole row. Throws
/// SessionError that names the file.
Session read_session(const std::filesystem::path& folder);

}  // namespace encore::energy
