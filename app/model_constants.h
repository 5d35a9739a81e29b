#pragma once

#include "energy/phase_log.h"
#include "energy/sources/model.h"

#include <optional>
#include <string>

namespace encore::app {

/// The constants that --model states; nothing where it is empty, or states a power for full load
/// instead. Throws energy::PowerModelError for a faulty one.
std::optional<energy::PowerModel> model_constants(const std::string& model);

/// What a second of each phase costs above idle, in watts, where the model states it for every
/// phase that a policy weighs (build, update, transfer, render); an animation that is not stated
/// counts nothing, as no policy can change it.
std::optional<energy::PerPhase<double>> phase_watts(
    const std::optional<energy::PowerModel>& constants);

}  // namespace encore::app
