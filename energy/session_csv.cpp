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

/// Reads a file's rows with `from_record(header, record)`, and puts the place before its errors.
template <class Row, class FromRecord>
std::vector<Row> read_rows(const std::filesystem::path& path, const FromRecord& from_record) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!(file && text << file.rdbuf())) throw SessionError("cannot read " + path.string());
  const std::vector<CsvRecord> records = parse_csv(text.str());
  if (records.empty()) throw SessionError(path.string() + ": the header is missing");

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
                             const SessionColumns& columns)
    : folder_(folder),
      info_(written(folder, std::move(info))),
      samples_(folder / kSamplesFile, sample_header()),
      frames_(folder / kFramesFile, frame_header(columns)),
      summary_(folder / kSummaryFile, summary_header(columns)) {}

void SessionWriter::finish(SessionState state) {
  info_.state = state;
  write_session_toml(folder_ / kInfoFile, info_);
}

Session read_session(const std::filesystem::path& folder) {
  Session session;
  session.info = read_session_toml(folder / kInfoFile);
  session.frames = read_rows<FrameRow>(folder / kFramesFile, frame_from_record);
  session.summaries = read_rows<SummaryRow>(folder / kSummaryFile, summary_from_record);
  return session;
}

}  // namespace encore::energy
