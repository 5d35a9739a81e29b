#pragma once

#include "energy/session_csv.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace encore::app {

/// One configuration of a written session; figures an operation.
struct WrittenRow {
  std::string structure = "bvh-median";
  std::string test = "build";
  double ms = 10.0;
  double ms_ci95 = 0.1;
  double joules = 0.3;         ///< 0: not measured
  double joules_ci95 = 0.003;  ///< of chance; the sensor's gain comes on top
  std::string repeat = "1";
  std::string triangles = "1000";
};

inline energy::SessionInfo written_info() {
  energy::SessionInfo info;
  info.program = "encore 0.1.0";
  info.started_utc = "2026-01-31T12:00:00Z";
  info.machine.cpu_model = "processor";
  info.machine.logical_cores = 8;
  info.machine.build_type = "Release";
  info.sensor = {energy::Origin::measured, "rapl"};
  energy::SessionSource source;
  source.info.name = "rapl:package-0";
  source.info.kind = energy::SourceKind::rapl;
  source.info.provenance = info.sensor;
  source.in_total = true;
  info.sources = {source};
  info.settings = {{"memory", "pool"}, {"threads", "8"}};
  return info;
}

inline energy::SummaryRow summary_of(const WrittenRow& written) {
  energy::SummaryRow row;
  const bool renders = written.test != "build";
  row.configuration = {{"scene", "toys"},
                       {"device", "cpu"},
                       {"structure", written.structure},
                       {"policy", "rebuild"},
                       {"test", written.test},
                       {"width", renders ? "256" : ""},
                       {"height", renders ? "256" : ""},
                       {"repeat", written.repeat},
                       {"triangles", written.triangles}};
  row.operations = 100;
  row.mean = energy::Seconds(written.ms / 1e3);
  row.seconds = row.mean * 100.0;
  row.phase_counts[renders ? energy::Phase::render : energy::Phase::build] = 100;
  row.shares[renders ? energy::Phase::render : energy::Phase::build] = 1.0;
  if (written.ms_ci95 > 0.0) row.ci95 = energy::Seconds(written.ms_ci95 / 1e3);
  if (written.joules > 0.0) {
    row.source = "rapl:package-0";
    row.joules = energy::Joules(written.joules);
    const double gain = 1.959963984540054 * energy::SourceInfo{}.gain_uncertainty;
    row.joules_ci95 = energy::Joules(std::hypot(written.joules_ci95, gain * written.joules));
    row.watts = *row.joules / row.mean;
    row.watts_ci95 = *row.joules_ci95 / row.mean;
    row.origin = energy::Origin::measured;
  }
  return row;
}

inline energy::Session session_of(const std::vector<WrittenRow>& rows,
                                  energy::SessionInfo info = written_info()) {
  energy::Session session;
  session.info = std::move(info);
  session.info.state = energy::SessionState::complete;
  for (const WrittenRow& row : rows) session.summaries.push_back(summary_of(row));
  return session;
}

/// Writes the session into the new folder `folder`, and returns it.
inline std::filesystem::path write_session(const std::filesystem::path& folder,
                                           const energy::Session& session) {
  std::filesystem::create_directories(folder);
  energy::SessionColumns columns;
  for (const energy::KeyValue& part : session.summaries.at(0).configuration) {
    columns.configuration.push_back(part.key);
  }
  energy::SessionWriter writer(folder, session.info, columns);
  for (const energy::FrameRow& row : session.frames) writer.add(row);
  for (const energy::SummaryRow& row : session.summaries) writer.add(row);
  for (const energy::WindowRow& row : session.windows) writer.add(row);
  writer.finish(session.info.state);
  return folder;
}

}  // namespace encore::app
