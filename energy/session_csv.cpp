#include "energy/session_csv.h"

#include "energy/session_toml.h"

#include <fstream>
#include <sstream>

namespace encore::energy {

namespace {

constexpr const char* kInfoFile = "session.toml";
constexpr const char* kSamplesFile = "samples.csv";
constexpr const char* kFramesFile = "frames.csv";
constexpr const char* kSummaryFile = "summary.csv";
constexpr const char* kPhasesFile = "phases.csv";
constexpr const char* kWindowsFile = "windows.csv";
constexpr const char* kConvergenceFile = "convergence.csv";
constexpr const char* kEventsFile = "events.csv";

/// Every row gets its header's names: longer ones would make much of a small file.
constexpr std::size_t kLongestColumnName = 256;

/// Reads a file's rows with `from_record(header, record)`, and puts the place before its errors.
template <class Row, class FromRecord>
std::vector<Row> read_rows(const std::filesystem::path& path, const FromRecord& from_record) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!(file && text << file.rdbuf())) throw SessionError("cannot read " + path.string());
  const std::vector<CsvRecord> records = parse_csv(text.str());
  if (records.empty()) throw SessionError(path.string() + ": the header is missing");
  for (const std::string& name : records.front()) {
    if (name.size() <= kLongestColumnName) continue;
    throw SessionError(path.string() + ": a column's name is longer than " +
                       std::to_string(kLongestColumnName) + " characters");
  }

  std::vector<Row> rows;
  for (std::size_t i = 1; i < records.size(); ++i) {
    try {
      rows.push_back(from_record(records.front(), records[i]));
    } catch (const SessionError& error) {
      throw SessionError(path.string() + ", row " + std::to_string(i) + ": " + error.what());
    }
  }
  return rows;
}

/// So that session.toml is there before the first row is.
SessionInfo written(const std::filesystem::path& folder, SessionInfo info) {
  write_session_toml(folder / kInfoFile, info);
  return info;
}

}  // namespace

SessionWriter::SessionWriter(const std::filesystem::path& folder, SessionInfo info,
                             const SessionColumns& columns, CsvWriter::Open open)
    : folder_(folder),
      info_(written(folder, std::move(info))),
      samples_(folder / kSamplesFile, sample_header(), open),
      frames_(folder / kFramesFile, frame_header(columns), open),
      summary_(folder / kSummaryFile, summary_header(columns), open),
      phases_(folder / kPhasesFile, phase_header(columns), open),
      windows_(folder / kWindowsFile, window_header(columns), open),
      convergence_(folder / kConvergenceFile, convergence_header(columns), open),
      events_(folder / kEventsFile, event_header(), open) {}

void SessionWriter::update(const SessionInfo& info) {
  info_ = info;
  write_session_toml(folder_ / kInfoFile, info_);
}

void SessionWriter::finish(SessionState state) {
  info_.state = state;
  write_session_toml(folder_ / kInfoFile, info_);
}

Session read_session(const std::filesystem::path& folder) {
  Session session;
  session.info = read_session_toml(folder / kInfoFile);
  session.frames = read_rows<FrameRow>(folder / kFramesFile, frame_from_record);
  session.summaries = read_rows<SummaryRow>(folder / kSummaryFile, summary_from_record);
  session.phases = read_rows<PhaseRow>(folder / kPhasesFile, phase_from_record);
  session.windows = read_rows<WindowRow>(folder / kWindowsFile, window_from_record);
  session.convergence =
      read_rows<ConvergenceRow>(folder / kConvergenceFile, convergence_from_record);
  session.samples = read_rows<SampleRow>(folder / kSamplesFile, sample_from_record);
  session.events = read_rows<EventRow>(folder / kEventsFile, event_from_record);
  return session;
}

}  // namespace encore::energy
