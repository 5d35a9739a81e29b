#pragma once

#include "energy/units.h"

#include <optional>
#include <string_view>

namespace encore::energy {

/// NVIDIA's generations as far as their power readings differ.
enum class NvidiaGeneration {
  unknown,
  maxwell,
  pascal,
  volta,
  turing,
  ga100,  ///< the data-centre chip of Ampere (A100, A30)
  ampere,
  ada,
  hopper,
  blackwell,
};

/// The generation that a product name ("NVIDIA GeForce RTX 3090") belongs to.
NvidiaGeneration generation_of(std::string_view product);

/// Whether a product is a processor and a GPU on one module (GH200, GB200): its energy counter sees
/// both.
bool is_module(std::string_view product);

/// How a power reading comes about: the mean over the last `window`, renewed each `period`.
struct NvmlTiming {
  Seconds window;
  Seconds period;
  /// Share of the time that no reading covers.
  [[nodiscard]] double unseen() const { return window < period ? 1.0 - window / period : 0.0; }
};

/// What is known of a generation's gauge, after arXiv 2312.02741. `instant`: the
/// field of that name, else nvmlDeviceGetPowerUsage, whose window depends on the driver's main
/// version (0: unknown). Nothing where it was not measured or has no closed window.
std::optional<NvmlTiming> gauge_timing(NvidiaGeneration generation, bool instant, int driver);

}  // namespace encore::energy
