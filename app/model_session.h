#pragma once

#include "energy/model/model_fit.h"
#include "energy/session.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// A session as energy models see it: its configurations as observations, of which those of the
/// build and static tests calibrate and those of the dynamic test are held back.
struct ModelData {
  std::vector<std::string> rates;  ///< names: "build", "render (cpu)", …
  std::vector<energy::ModelObservation> observations;
  /// Of each observation, its configuration; repeats stand for themselves.
  std::vector<std::vector<energy::KeyValue>> configurations;
  std::vector<double> measured_watts;  ///< mean power, of each observation
};

/// Which kinds of work share a rate.
enum class RateGrouping {
  processor,  ///< thesis, section 6: one rate for all work on the CPU (cpuJ), one each for
              ///< rendering on a GPU (gpuJ) and for transfer (tranJ)
  phase,      ///< section 5.3.3: build and render have rates of their own; so have update, if the
              ///< session has a test of it alone, and transfer. Animation, which no test isolates,
              ///< counts as build: both are work on the CPU over the same triangles
};

/// The configurations of a session that have joules. Half-widths leave out the sensor's gain error,
/// which all have in common.
ModelData model_data(const energy::Session& session, RateGrouping grouping);

/// Mean idle power of the session's baselines, without the gain error; nothing if it took none.
std::optional<energy::Uncertain> idle_watts(const energy::Session& session);

/// Section 5.3's own prediction of a dynamic configuration: its build (or update) time at the mean
/// power of its own build test, and its render time at that of its own static test, same scene,
/// structure, device and size. The rest of its time is taken at the mean power of these two.
struct OwnTests {
  std::size_t observation = 0;
  double joules = 0.0;
  double watts = 0.0;
  double error = 0.0;  ///< predicted over measured joules, minus 1
  /// The measured mean power lies outside that of both tests: no mix of them gives it.
  bool outside = false;
};
/// Of every dynamic configuration that has both tests.
std::vector<OwnTests> predict_from_own_tests(const ModelData& data);
energy::ModelErrors errors_of(const std::vector<OwnTests>& predictions);

}  // namespace encore::app
