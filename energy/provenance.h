#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace encore::energy {

/// Where a joule comes from.
enum class Origin {
  measured,     ///< a sensor
  modelled,     ///< constants that a user or a calibration gave
  simulated,    ///< a test double
  unavailable,  ///< nowhere: the number does not exist (it is never 0 instead)
};

/// An origin and what it rests on: which sensor, which constants, or why there is nothing.
struct Provenance {
  Origin origin = Origin::unavailable;
  std::string detail;

  friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// The words exactly as files hold them.
std::string_view to_string(Origin origin);
std::optional<Origin> parse_origin(std::string_view word);

}  // namespace encore::energy
