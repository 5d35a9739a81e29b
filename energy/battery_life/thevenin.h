#pragma once

#include "energy/battery_life/battery.h"
#include "energy/units.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace encore::energy {

/// Why a battery stops.
enum class EndReason {
  empty,      ///< no charge left
  cut_off,    ///< the voltage fell to where the device switches off
  brown_out,  ///< no current gives the power any more
  never,      ///< no load, or one so small that the time is beyond numbers
};
std::string_view to_string(EndReason reason);

/// A pack as one circuit: an OCV source, R0 and RC branches in series.
struct PackCircuit {
  double coulombs = 0.0;
  double r0_ohms = 0.0;
  std::vector<RcBranch> branches;
  std::vector<OcvPoint> ocv;
  double cutoff_volts = 0.0;

  /// Linear between the table's points, constant beyond its ends.
  [[nodiscard]] double open_volts(double soc) const;
};

/// The cells of a pack in series and parallel.
PackCircuit pack_circuit(const Battery& battery);

struct TheveninState {
  double soc = 1.0;
  std::vector<double> branch_volts;  ///< one a branch
};

/// At rest: no voltage across the branches.
TheveninState thevenin_rest(const PackCircuit& circuit, double soc);

/// What stands before R0: the OCV less the branches' voltages.
double inner_volts(const PackCircuit& circuit, const TheveninState& state);

/// How far each branch goes towards its end in one step. Kept for steps of equal length.
class StepGains {
 public:
  StepGains(const PackCircuit& circuit, Seconds dt);
  [[nodiscard]] Seconds dt() const { return dt_; }
  [[nodiscard]] double operator[](std::size_t branch) const { return gains_[branch]; }

 private:
  Seconds dt_;
  std::vector<double> gains_;
};

/// The state after a step at a constant current, negative to charge: exact and stable for any
/// length and any time constants, 0 included. The charge may leave 0 ... 1; the OCV then stays.
void thevenin_step(const PackCircuit& circuit, TheveninState& state, double amperes,
                   const StepGains& gains);

/// How a discharge ended.
struct DischargeEnd {
  EndReason reason = EndReason::empty;
  Seconds time;
  TheveninState state;
  std::uint64_t steps = 0;
};

/// When, at a constant current, the charge ends or the terminals fall to the cut-off, not later
/// than `within`; nothing if neither happens. The moment is found inside one exact step: bounds on
/// the voltage over parts of the step tell whether it dips in between, so that no dip is stepped
/// over.
std::optional<DischargeEnd> discharge_within(const PackCircuit& circuit, const TheveninState& state,
                                             double amperes, Seconds within);

/// What limits a step at constant power, where the current changes with the voltage.
struct StepLimits {
  Seconds longest{std::numeric_limits<double>::infinity()};
  double most_soc = 0.005;  ///< charge taken, as a share of the full one
};

/// Discharges at a constant power from `state` to the end. Each step holds the current at which
/// half-way through the step the power is right (implicit midpoint, branches and R0 solved with
/// it), so it stays stable whatever the step and the time constants; the error is of second order.
/// The end is approached by halving steps that go past it and is known to 1e-12 of the time. At 0 W
/// the reason is `never` and the time 0.
DischargeEnd discharge_constant_power(const PackCircuit& circuit, const TheveninState& state,
                                      Watts load, const StepLimits& limits);

}  // namespace encore::energy
