#include "app/window/opened_session.h"

#include "app/session_input.h"
#include "app/window/session_stream.h"
#include "energy/session_columns.h"
#include "energy/session_energy_columns.h"
#include "energy/session_toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace encore::app {

namespace {

namespace fs = std::filesystem;
using energy::CsvRecord;

constexpr const char* kFiles[] = {"frames.csv",      "summary.csv", "phases.csv", "windows.csv",
                                  "convergence.csv", "samples.csv", "events.csv"};

void check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw energy::SessionError(
        fmt::format("{} is no folder; open a session folder", folder.string()));
  }
  if (!fs::exists(folder / "session.toml", error)) {
    throw energy::SessionError(
        fmt::format("{} is no session: it has no session.toml; open a folder that this window or "
                    "'encore profile' wrote",
                    folder.string()));
  }
}

std::uint64_t bytes_of(const fs::path& folder) {
  std::uint64_t sum = 0;
  for (const char* file : kFiles) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(folder / file, error);
    if (!error) sum += size;
  }
  return sum;
}

/// The columns of frames.csv with the configuration that its header has.
CsvRecord frame_columns(const CsvRecord& header) {
  energy::SessionColumns columns;
  const auto end = std::find(header.begin(), header.end(), "operations");
  if (end != header.end() && end != header.begin()) {
    columns.configuration.assign(std::next(header.begin()), end);
  }
  return energy::frame_header(columns);
}

template <class Row, class FromRecord>
void read_rows(SessionStream& stream, const fs::path& file, std::vector<Row>& rows,
               const FromRecord& from_record) {
  stream.read(file, [&](const CsvRecord& header, const CsvRecord& record) {
    rows.push_back(from_record(header, record));
  });
}

/// Puts each reading into the series of its source.
class SeriesReader {
 public:
  explicit SeriesReader(OpenedSession& opened) : opened_(opened) {
    for (const energy::SessionSource& source : opened.session.info.sources) {
      opened_.series.push_back({source.info.name, source.info.provenance, source.in_total, {}});
    }
  }
  void add(const energy::SampleRow& row) {
    SourceSeries& series = series_of(row);
    PowerPoint point;
    point.time_s = row.time.value;
    if (row.watts) point.watts = row.watts->value;
    if (row.joules) point.joules = row.joules->value;
    point.changed = row.changed;
    point.gap = row.restarted || series.points.empty();
    series.points.push_back(point);
  }

 private:
  SourceSeries& series_of(const energy::SampleRow& row) {
    if (last_ < opened_.series.size() && opened_.series[last_].name == row.source) {
      return opened_.series[last_];
    }
    const auto known =
        std::find_if(opened_.series.begin(), opened_.series.end(),
                     [&](const SourceSeries& one) { return one.name == row.source; });
    last_ = static_cast<std::size_t>(known - opened_.series.begin());
    if (known == opened_.series.end()) {
      opened_.series.push_back({row.source, {row.origin, "session.toml does not tell"}, false, {}});
    }
    return opened_.series[last_];
  }

  OpenedSession& opened_;
  std::size_t last_ = 0;
};

void read_files(const fs::path& folder, SessionStream& stream, OpenedSession& opened) {
  energy::Session& session = opened.session;
  std::optional<CsvRecord> columns;
  stream.read(folder / "frames.csv", [&](const CsvRecord& header, const CsvRecord& record) {
    if (!columns) columns = frame_columns(header);
    if (header != *columns) {
      throw energy::SessionError(
          "its columns are not those that this version of the program knows; a newer version wrote "
          "it, and opens it");
    }
    session.frames.push_back(energy::frame_from_record(header, record));
  });
  read_rows(stream, folder / "summary.csv", session.summaries, energy::summary_from_record);
  read_rows(stream, folder / "phases.csv", session.phases, energy::phase_from_record);
  read_rows(stream, folder / "windows.csv", session.windows, energy::window_from_record);
  read_rows(stream, folder / "convergence.csv", session.convergence,
            energy::convergence_from_record);
  SeriesReader series(opened);
  stream.read(folder / "samples.csv", energy::sample_header(),
              [&](const CsvRecord& header, const CsvRecord& record) {
                series.add(energy::sample_from_record(header, record));
              });
  stream.read(folder / "events.csv", energy::event_header(),
              [&](const CsvRecord& header, const CsvRecord& record) {
                session.events.push_back(energy::event_from_record(header, record));
              });
}

double length_of(const OpenedSession& opened) {
  double end = 0.0;
  for (const energy::FrameRow& row : opened.session.frames) {
    end = std::max(end, (row.time + row.total() * static_cast<double>(row.operations)).value);
  }
  for (const energy::WindowRow& row : opened.session.windows) end = std::max(end, row.to.value);
  for (const energy::EventRow& row : opened.session.events) end = std::max(end, row.time.value);
  for (const SourceSeries& one : opened.series) {
    if (!one.points.empty()) end = std::max(end, one.points.back().time_s);
  }
  return end;
}

std::string card_of(const energy::SessionInfo& info) {
  const energy::Machine& machine = info.machine;
  std::string text;
  const auto line = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) text += fmt::format("{}: {}\n", name, value);
  };
  line("program", info.program);
  line("started", info.started_utc);
  line("command", info.command_line);
  line("processor", machine.cpu_model.value_or(""));
  if (machine.logical_cores) {
    line("cores", machine.physical_cores ? fmt::format("{} ({} threads)", *machine.physical_cores,
                                                       *machine.logical_cores)
                                         : fmt::format("{} threads", *machine.logical_cores));
  }
  if (machine.memory_bytes) {
    line("memory",
         fmt::format("{:.1f} GiB", static_cast<double>(*machine.memory_bytes) / 1073741824.0));
  }
  for (const std::string& gpu : machine.gpus) line("graphics", gpu);
  line("system", machine.operating_system.value_or(""));
  line("kernel", machine.kernel.value_or(""));
  line("governor", machine.governor.value_or(""));
  if (machine.virtual_machine) line("virtual machine", *machine.virtual_machine ? "yes" : "no");
  line("container", machine.container.value_or(""));
  line("power supply", machine.power_supply.value_or(""));
  line("compiler", machine.compiler + ", " + machine.build_type);
  line("energy", fmt::format("{}: {}", energy::to_string(info.sensor.origin), info.sensor.detail));
  for (const energy::KeyValue& setting : info.settings) line(setting.key, setting.value);
  return text;
}

}  // namespace

OpenedSession read_opened_session(const fs::path& folder, TaskControl& control) {
  check_folder(folder);
  OpenedSession opened;
  opened.folder = folder;
  opened.session.info = energy::read_session_toml(folder / "session.toml");
  SessionStream stream(control, bytes_of(folder));
  read_files(folder, stream, opened);
  opened.remarks = stream.remarks();
  energy::Session& session = opened.session;
  opened.cut_off = session.info.state == energy::SessionState::running;
  if (opened.cut_off) {
    opened.remarks.emplace_back(
        "the session was cut off (its program was killed, or still records); its rows are good");
  }
  if (session.summaries.empty() && !session.frames.empty()) {
    recompute_figures(session, opened.series);
    opened.recomputed = true;
    opened.remarks.emplace_back("its figures were computed now, from its frames and samples");
  }
  if (control.stop) throw energy::SessionError("reading was cancelled");
  opened.bars = bars_of(session.summaries, session.phases, session.info.sensor);
  opened.machine_card = card_of(session.info);
  opened.seconds = length_of(opened);
  control.progress = 1.0;
  return opened;
}

std::shared_ptr<const OpenedSession> open_for_window(const fs::path& folder, TaskControl& control) {
  return std::make_shared<const OpenedSession>(read_opened_session(folder, control));
}

}  // namespace encore::app
