#pragma once

#include "energy/sources/model.h"
#include "energy/sources/utilisation_model.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace encore::energy {

/// A model as a user asks for it.
using ModelSpec = std::variant<PowerModel, UtilisationModel>;

/// Reads what a user typed, one of
///   "idle=12,render=20,build=18"  watts: idle, and above idle each phase that runs ("busy" stands
///                                 for every phase that is not named, "gpu" for a busy GPU);
///                                 "uncertainty=10%" says how well they are known
///   "idle=12,max=45"              watts at 0 and at 100 % processor load: an estimate from load
///   "thesis-laptop"               a named preset, also with changes: "thesis-laptop,transfer=10"
///   "laptop.toml"                 a calibration file (calibration.h)
/// Throws PowerModelError that quotes the part that is wrong.
ModelSpec parse_model_spec(std::string_view text);

/// Names that parse_model_spec() knows.
std::vector<std::string> model_presets();
/// The constants of a preset. Throws PowerModelError that lists the names for any other name.
PowerModel model_preset(std::string_view name);

}  // namespace encore::energy
