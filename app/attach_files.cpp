#include "app/attach.h"
#include "app/gpu_device.h"
#include "app/transfer_derivation.h"
#include "energy/session_csv.h"
#include "energy/sources/discovery.h"
#include "scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace encore::app {

namespace {

std::vector<energy::PhaseRow> total_phases(const energy::Session& session) {
  std::vector<energy::PhaseRow> phases;
  std::copy_if(session.phases.begin(), session.phases.end(), std::back_inserter(phases),
               [](const energy::PhaseRow& row) { return row.source == "total"; });
  return phases;
}

}  // namespace

energy::Recording open_recording(const std::string& file) {
  try {
    return energy::load_recording(file);
  } catch (const energy::SensorError& error) {
    throw scene::InputError(error.what());
  }
}

void write_attached(const std::filesystem::path& folder, const std::filesystem::path& old_folder,
                    const Attached& attached) {
  const energy::Session& session = attached.session;
  energy::SessionColumns columns;
  for (const auto& part : session.summaries.front().configuration) {
    columns.configuration.push_back(part.key);
  }
  for (const auto& counter : session.summaries.front().counters) {
    columns.counters.push_back(counter.name);
  }
  energy::SessionInfo info = session.info;
  info.state = energy::SessionState::running;
  energy::SessionWriter writer(folder, std::move(info), columns);
  const auto write = [&](const auto& rows) {
    for (const auto& row : rows) writer.add(row);
  };
  write(session.frames);
  write(session.windows);
  write(session.convergence);
  write(session.samples);
  write(session.phases);
  write(session.events);
  write(session.summaries);
  const auto log = old_folder / "machine.csv";
  if (std::filesystem::exists(log)) {
    std::error_code error;
    std::filesystem::copy_file(log, folder / "machine.csv", error);
    if (error) {
      throw energy::SessionError(
          fmt::format("cannot copy {} to {}: {}", log.string(), folder.string(), error.message()));
    }
  }
  write_transfers(folder, session.summaries, total_phases(session));
  writer.finish(session.info.state);
}

ProfileReport attach_report(const std::filesystem::path& folder, const Attached& attached) {
  ProfileReport report;
  report.folder = folder;
  report.state = attached.session.info.state;
  report.sensor = attached.session.info.sensor;
  report.rows = attached.session.summaries;
  report.notes = attached.notes;
  report.phases = total_phases(attached.session);
  report.gpu = gpu_of(attached.session.info);
  report.transfers = derive_transfers(report.rows, report.phases);
  return report;
}

}  // namespace encore::app
