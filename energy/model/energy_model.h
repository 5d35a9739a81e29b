#pragma once

#include "energy/attribution/attribution.h"
#include "energy/units.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// One kind of work in a frame: build, render, transfer, …
struct FrameWork {
  std::string name;
  Uncertain seconds;     ///< a frame
  std::size_t rate = 0;  ///< index of the rate that it runs at; kinds of work may share one
};

/// What the models need. Half-widths are 95 % ones and taken for independent of each other; a rate
/// that several kinds of work share is one uncertain number, not several.
struct ModelInput {
  std::vector<Uncertain> rates;  ///< watts
  std::vector<FrameWork> work;
};

/// What a model says about one frame.
struct ModelPrediction {
  Uncertain seconds;                      ///< a frame
  Uncertain frames_per_second;            ///< thesis: Fps
  Uncertain watts;                        ///< average discharge rate (thesis: Rate)
  Uncertain joules;                       ///< a frame
  Uncertain frames_per_joule;             ///< thesis: Fpj = Fps / Rate
  std::vector<Uncertain> joules_of_work;  ///< in the order of the input's work (thesis: Jpb, Jpr)
  /// Busy time of all work together over the frame's time: 1 if work follows work without a gap,
  /// more if it overlaps, less if the frame waits.
  double busy_share = 1.0;
  /// One sentence if the busy share is more than 5 % off 1, where the thesis' model does not hold.
  std::string warning;
};

/// The thesis' model (sections 5.3.3 and 6): kinds of work follow each other, nothing else happens,
/// and rates are those of the whole machine. With work k taking t_k at the gross rate P_k,
/// T = sum t_k, Rate = sum P_k t_k / T, Fps = 1 / T, Fpj = Fps / Rate. The CPU case is one rate for
/// build and render; the GPU case has one each for build, render and transfer.
/// Throws std::invalid_argument if a rate or time is negative or not finite, a rate's index is out
/// of range, or no time is spent at all.
ModelPrediction predict_sequential(const ModelInput& input);

/// The general model: E = P_idle T + sum dP_k t_k. The frame takes T as measured, work may overlap
/// or leave gaps, and the rates are what work draws above idle. With T = sum t_k and
/// P_k = P_idle + dP_k it is the thesis' model. `joules_of_work` is above idle. Throws as above; T
/// must be positive.
ModelPrediction predict_overlapping(Uncertain idle_watts, Uncertain frame_seconds,
                                    const ModelInput& input);

/// How many frames `capacity` joules pay for (thesis: CJ Fpj), if nothing else draws from them.
Uncertain frames_for(Uncertain capacity_joules, const ModelPrediction& prediction);

/// The rate above idle of an operation alone (thesis 5.1.6: 33.6 - IdleB).
Uncertain above_idle(Uncertain gross_watts, Uncertain idle_watts);

}  // namespace encore::energy
