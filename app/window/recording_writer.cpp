#include "app/window/recording_writer.h"

#include "app/profile_folder.h"
#include "app/window/power_set.h"
#include "app/workloads.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::app {

namespace fs = std::filesystem;

RecordingWriter::RecordingWriter(const fs::path& wanted, const std::string& name,
                                 energy::SessionInfo info, energy::Seconds session_start)
    : folder_(make_session_folder(wanted.string(), info.started_utc,
                                  name.empty() ? std::string("window") : name)),
      start_(session_start),
      info_(std::move(info)) {
  writer_ = std::make_unique<energy::SessionWriter>(
      folder_, info_, energy::SessionColumns{configuration_columns(), counter_columns()});
  machine_log_ = std::make_unique<MachineLog>(folder_, energy::CsvWriter::Open::create,
                                              energy::SensorRoot(), session_start);
}

void RecordingWriter::write(const std::vector<RecordedRow>& rows) {
  for (const RecordedRow& row : rows) {
    std::visit([this](const auto& one) { writer_->add(one); }, row);
  }
}

void RecordingWriter::check(energy::Seconds now) {
  std::error_code error;
  if (!fs::exists(folder_ / "samples.csv", error)) {
    // What is written to a file without a name vanishes: nobody else would say so.
    throw energy::SessionError(
        fmt::format("{} is gone (removed, or its disk was taken out)", folder_.string()));
  }
  machine_log_->poll(now);
}

void RecordingWriter::use(const PowerSet& power) {
  info_.sensor = power.provenance;
  for (const energy::SessionSource& source : power.sources) {
    const auto known = std::find_if(
        info_.sources.begin(), info_.sources.end(),
        [&](const energy::SessionSource& one) { return one.info.name == source.info.name; });
    if (known == info_.sources.end()) {
      info_.sources.push_back(source);
    } else {
      *known = source;
    }
  }
  writer_->update(info_);
}

void RecordingWriter::write_figures(const Figures& figures, energy::Seconds now) {
  for (const LiveFigures& one : figures.configurations) {
    for (const energy::PhaseRow& row : one.source_phases) writer_->add(row);
    for (const energy::PhaseRow& row : one.phases) writer_->add(row);
    for (const energy::ConvergenceRow& row : one.convergence) writer_->add(row);
    for (const std::string& note : one.notes) {
      writer_->add(energy::EventRow{now - start_, "", one.name + ": " + note});
    }
    writer_->add(one.summary);
  }
}

void RecordingWriter::finish(energy::SessionState state) {
  writer_->finish(state);
}

std::uint64_t RecordingWriter::bytes() const {
  std::uint64_t sum = 0;
  std::error_code error;
  for (fs::directory_iterator file(folder_, error), end; !error && file != end;
       file.increment(error)) {
    std::error_code unknown;
    const std::uintmax_t size = file->file_size(unknown);
    if (!unknown) sum += size;
  }
  return sum;
}

}  // namespace encore::app
