#include "app/model_constants.h"

#include "energy/sources/model_spec.h"

#include <variant>

namespace encore::app {

std::optional<energy::PowerModel> model_constants(const std::string& model) {
  if (model.empty()) return std::nullopt;
  const energy::ModelSpec spec = energy::parse_model_spec(model);
  if (const auto* constants = std::get_if<energy::PowerModel>(&spec)) return *constants;
  return std::nullopt;
}

std::optional<energy::PerPhase<double>> phase_watts(
    const std::optional<energy::PowerModel>& constants) {
  if (!constants) return std::nullopt;
  energy::PerPhase<double> watts{};
  for (const energy::Phase phase : energy::kPhases) {
    const std::optional<energy::Watts>& above_idle = constants->delta[phase];
    if (!above_idle && phase != energy::Phase::animate) return std::nullopt;
    if (above_idle) watts[phase] = above_idle->value;
  }
  return watts;
}

}  // namespace encore::app
