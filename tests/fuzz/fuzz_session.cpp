// Feeds arbitrary bytes to the reader of session folders, as one file of a good folder: '0'
// session.toml, '1' frames.csv, and so on in the order of kFiles. A session of finite numbers that
// can be written again, or SessionError.
#include "energy/session_csv.h"
#include "energy/session_toml.h"
#include "tests/fuzz/check_text.h"
#include "tests/support/files.h"

#include <array>
#include <map>

namespace {

using namespace encore;
using namespace encore::energy;

constexpr std::array kFiles = {"session.toml", "frames.csv",      "summary.csv", "phases.csv",
                               "windows.csv",  "convergence.csv", "samples.csv", "events.csv"};

/// A folder with one row of each kind.
class GoodSession {
 public:
  GoodSession() {
    SessionInfo info;
    info.program = "encore";
    info.started_utc = "2026-01-31T23:59:59Z";
    info.scenes = {"toys"};
    info.settings = {{"memory", "pool"}};
    info.sources.emplace_back();
    SessionWriter writer(folder_.path(), info, {{"scene"}, {"nodes"}});
    const std::vector<KeyValue> configuration{{"scene", "toys"}};
    FrameRow frame;
    frame.configuration = configuration;
    writer.add(frame);
    SummaryRow summary;
    summary.configuration = configuration;
    summary.counters.push_back({"nodes", 7.0, false});
    writer.add(summary);
    PhaseRow phase;
    phase.configuration = configuration;
    writer.add(phase);
    WindowRow window;
    window.configuration = configuration;
    writer.add(window);
    ConvergenceRow convergence;
    convergence.configuration = configuration;
    writer.add(convergence);
    writer.add(SampleRow{});
    writer.add(EventRow{});
    writer.finish(SessionState::complete);
    for (const char* file : kFiles) originals_[file] = test::contents_of(folder_.path() / file);
    // The seed of every other input must be good itself.
    (void)read_session(folder_.path());
  }

  /// Reads the folder with one file replaced.
  [[nodiscard]] Session read_with(const std::string& file, std::string_view text) {
    if (!changed_.empty() && changed_ != file) folder_.write(changed_, originals_.at(changed_));
    changed_ = file;
    folder_.write(file, text);
    return read_session(folder_.path());
  }
  [[nodiscard]] std::filesystem::path scratch() const { return folder_.path() / "again.toml"; }

 private:
  test::TemporaryFolder folder_;
  std::map<std::string, std::string> originals_;
  std::string changed_;
};

void check_finite(const Session& session) {
  for (const FrameRow& row : session.frames) {
    fuzz::require_finite(row.time);
    fuzz::require_finite(row.operation_joules);
  }
  for (const SummaryRow& row : session.summaries) {
    fuzz::require_finite(row.seconds);
    fuzz::require_finite(row.watts);
    for (const Counter& counter : row.counters) fuzz::require_finite(counter.value);
  }
  for (const SampleRow& row : session.samples) {
    fuzz::require_finite(row.time);
    fuzz::require_finite(row.joules);
  }
  for (const ConvergenceRow& row : session.convergence) fuzz::require_finite(row.mean);
  fuzz::require_finite(session.info.plan.run);
  for (const SessionSource& source : session.info.sources) {
    fuzz::require_finite(source.info.gain_uncertainty);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static GoodSession good;
  const auto input = fuzz::choice_of(data, size, kFiles.size());
  if (!input) return 0;
  fuzz::check_parser<SessionError>([&] {
    const Session session = good.read_with(kFiles.at(input->which), input->text);
    check_finite(session);
    for (const FrameRow& row : session.frames) (void)to_record(row);
    for (const SummaryRow& row : session.summaries) (void)to_record(row);
    if (input->which != 0) return;
    write_session_toml(good.scratch(), session.info);
    fuzz::require(read_session_toml(good.scratch()) == session.info);
  });
  return 0;
}
