#pragma once

#include "energy/units.h"

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// A battery description that cannot be used. what() is the whole message for the user:
/// "file:line:column: what is wrong".
class BatteryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A resistor and a capacitor side by side, in series with the rest: a voltage that lags behind.
struct RcBranch {
  double ohms = 0.0;
  double farads = 0.0;

  [[nodiscard]] double tau() const { return ohms * farads; }  ///< seconds
  friend bool operator==(const RcBranch&, const RcBranch&) = default;
};

/// Open-circuit voltage at a state of charge (0 empty, 1 full).
struct OcvPoint {
  double soc = 0.0;
  double volts = 0.0;

  friend bool operator==(const OcvPoint&, const OcvPoint&) = default;
};

/// Peukert's exponent, and the discharge for which the label's capacity holds.
struct PeukertParameters {
  double exponent = 1.05;
  double rated_hours = 5.0;

  friend bool operator==(const PeukertParameters&, const PeukertParameters&) = default;
};

/// The kinetic model: share `c` of the charge is at hand, the rest flows to it at k'.
struct KineticParameters {
  double c = 0.625;
  double rate_per_s = 1.92e-4;     ///< k' = k / (c (1 - c))
  std::optional<double> coulombs;  ///< in all; absent: so that the label holds at rated_hours

  friend bool operator==(const KineticParameters&, const KineticParameters&) = default;
};

/// The electric side of one cell.
struct Cell {
  double r0_ohms = 0.0;
  std::vector<RcBranch> branches;
  std::vector<OcvPoint> ocv;  ///< at least two, soc rising, volts not falling

  friend bool operator==(const Cell&, const Cell&) = default;
};

/// A battery pack: label, charge now, and what the models of battery_life/ need. Everything is of
/// the pack but `cell`.
struct Battery {
  std::string name;
  std::string source;  ///< where the description comes from, for people
  int series = 1;
  int parallel = 1;
  double nominal_volts = 0.0;
  double cutoff_volts = 0.0;  ///< the device switches off here
  double coulombs = 0.0;      ///< when full
  Joules full;                ///< when full
  double soc = 1.0;           ///< charge now as a share of the full one
  PeukertParameters peukert;
  KineticParameters kinetic;
  Cell cell;

  friend bool operator==(const Battery&, const Battery&) = default;
};

/// A Li-ion cell of about 2.4 Ah as laptops hold: R0 19.4 mOhm and two branches (20 s, 15 h) as
/// measured on such a cell at 25 C, a typical double layer (10 ms) and a typical OCV curve.
Cell generic_cell();
inline constexpr double kGenericCellVolts = 3.7;
inline constexpr double kGenericCellCoulombs = 2.4 * 3600.0;
inline constexpr double kGenericCutoffVolts = 3.0;

/// A pack of which only the label is known; cells, cut-off and constants are typical ones. Throws
/// std::invalid_argument unless volts and coulombs are positive and finite.
Battery battery_from_label(std::string name, double nominal_volts, double coulombs);

/// The presets' names, and one of them; nothing for an unknown name.
std::span<const std::string_view> battery_presets();
std::optional<Battery> battery_preset(std::string_view name);

/// What is wrong with a description, in words; empty if nothing is.
std::string battery_fault(const Battery& battery);

}  // namespace encore::energy
