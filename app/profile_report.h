#pragma once

#include "app/gpu_device.h"
#include "app/needs_report.h"
#include "app/transfer_derivation.h"
#include "energy/provenance.h"
#include "energy/sampling/sampler.h"
#include "energy/session.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What `encore profile` prints when it is done.
struct ProfileReport {
  std::filesystem::path folder;
  energy::SessionState state = energy::SessionState::complete;
  energy::Provenance sensor;
  std::optional<GpuInfo> gpu;  ///< that the devices gpu and raster draw with, if they take part
  std::vector<energy::SummaryRow> rows;
  std::vector<energy::PhaseRow> phases;  ///< of the total, all configurations
  /// For each configuration its name and what was found out about its figures.
  struct Notes {
    std::string name;
    std::vector<std::string> sentences;
  };
  std::vector<Notes> notes;
  std::vector<TransferFigures> transfers;  ///< derive_transfers() of the session
  std::vector<SceneLeftOut> left_out;      ///< what the scenes did without
  std::optional<energy::SamplerCost> sampling;
};

/// For people: where the joules come from, where the session lies, what the graphics device is, and
/// tables of the builds, the frames, the transfers and what was left out, each only if there are
/// any.
std::string report_text(const ProfileReport& report);

/// The same as one JSON object. Each result has the columns of summary.csv by name; numbers are
/// numbers, what does not apply is null, what could not be measured "unavailable".
std::string report_json(const ProfileReport& report);

/// "12.345 ± 0.012": a value and the half-width of its interval, which shows two digits and so
/// decides how many the value shows. Without an interval "12.35 ± ?".
std::string with_uncertainty(double value, std::optional<double> half_width);

}  // namespace encore::app
