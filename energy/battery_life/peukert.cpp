#include "energy/battery_life/peukert.h"

#include <cmath>

namespace encore::energy {

std::optional<Seconds> peukert_time(double coulombs, const PeukertParameters& peukert,
                                    double amperes) {
  if (!(amperes > 0.0)) return std::nullopt;
  const double rated_s = peukert.rated_hours * 3600.0;
  const double ratio = coulombs / (amperes * rated_s);
  const Seconds time(rated_s * std::pow(ratio, peukert.exponent));
  if (!std::isfinite(time.value)) return std::nullopt;
  return time;
}

std::optional<double> fit_peukert(const MeasuredDischarge& a, const MeasuredDischarge& b) {
  const auto positive = [](const MeasuredDischarge& d) {
    return d.amperes > 0.0 && d.time.value > 0.0 && std::isfinite(d.amperes) &&
           std::isfinite(d.time.value);
  };
  if (!positive(a) || !positive(b) || a.amperes == b.amperes) return std::nullopt;
  // log1p of the relative differences: close currents keep their digits.
  const double time = std::log1p((b.time - a.time) / a.time);
  const double current = std::log1p((a.amperes - b.amperes) / b.amperes);
  return time / current;
}

}  // namespace encore::energy
