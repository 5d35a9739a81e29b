#pragma once

#include "energy/sources/model.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace encore::energy {

/// A power model with its story, as a file keeps it. In TOML, watts as numbers:
///
///   format = 1                     # of this file
///   idle_W = 19.0                  # nothing runs; the whole machine
///   relative_uncertainty = 0.03    # standard uncertainty of the watts; may be left out
///   machine = "..."                # what it was measured on; may be left out
///   measured_utc = "2026-01-31T12:00:00Z"   # may be left out
///   method = "..."                 # how, in one sentence; may be left out
///   [above_idle]                   # above idle_W while it runs; what is not known is left out
///   animate_W = 15.0
///   build_W = 14.6
///   update_W = 14.6
///   transfer_W = 9.0
///   render_W = 15.6
///   gpu_W = 21.2
struct Calibration {
  PowerModel model;
  std::string machine;
  std::string measured_utc;
  std::string method;

  friend bool operator==(const Calibration&, const Calibration&) = default;
};

/// Reads a calibration; `model.detail` names the file, machine, date and method. Throws
/// PowerModelError "file:line:column: ..." for what is wrong in it, unknown keys included, and
/// "cannot read file: ..." otherwise.
Calibration read_calibration(const std::filesystem::path& path);
/// The same from text; `file` is its name in messages.
Calibration parse_calibration(std::string_view text, const std::string& file);

/// Writes it with a comment that explains the keys; every number comes back as it was. Replaces the
/// file in one step. Throws PowerModelError "cannot write file: ..." or as check() does.
void write_calibration(const std::filesystem::path& path, const Calibration& calibration);

}  // namespace encore::energy
