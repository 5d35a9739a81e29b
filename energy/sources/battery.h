#pragma once

#include "energy/sources/discovery.h"
#include "energy/sources/gauge_integral.h"
#include "energy/sources/power_supply.h"

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace encore::energy {

/// Two ways to count what a battery gave, from the same gauge: its power, integrated, and the fall
/// of the energy that it says is left.
struct BatteryCheck {
  Joules integral;     ///< of the gauge's watts
  Joules drawn;        ///< what the energy left fell by, over the same time
  Joules step;         ///< smallest fall seen: what the energy left is counted in
  Joules uncertainty;  ///< standard: step/sqrt(6), as each end is rounded by up to half a step

  [[nodiscard]] Joules difference() const { return integral - drawn; }
  /// Whether the difference is within three standard uncertainties and `gain` of the integral: the
  /// two are the same joules, unless the gauge smooths or guesses.
  [[nodiscard]] bool agrees(double gain = 0.02) const;
};

/// The power of one pack: what its gauge shows, else the slope of what it says is left.
class PackPower {
 public:
  struct Value {
    std::optional<Watts> power;
    std::string why;  ///< without a power: the reason
  };
  /// The next snapshot of a discharging pack, in the order of time.
  Value next(Seconds now, const SupplySnapshot& pack);
  /// Forgets the slope: the pack rested or could not be read.
  void interrupt();

 private:
  struct Change {
    Seconds time;
    double left = 0.0;
  };
  std::optional<Watts> slope(Seconds now, double left);

  std::optional<double> last_left_;  ///< joules, or ampere-seconds for packs that count charge
  std::optional<Change> change_;     ///< the latest change of it
  std::optional<double> rate_;       ///< fall between the last two changes, per second
  Seconds interval_;                 ///< time between them
};

/// All packs of a machine as one gauge of the whole system: the sum over the packs that are
/// discharging. Lost as soon as a charger is plugged in, since the gauge then no longer sees what
/// the machine uses.
class BatterySource final : public PowerSource {
 public:
  BatterySource(SourceInfo info, std::vector<std::string> packs, SensorFiles files);
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  ReadResult read(Seconds now) override;
  /// Gaps are left out of both sides. Nothing until the energy left has fallen twice. May be called
  /// from any thread.
  [[nodiscard]] std::optional<BatteryCheck> check() const;

 private:
  /// What the energy left of one pack did since the source was opened.
  struct Drawn {
    std::optional<Joules> last;
    Joules sum;
    std::optional<Joules> step;
    int falls = 0;
  };
  std::optional<std::string> plugged();
  /// All packs at one tick.
  struct Look {
    std::vector<SupplySnapshot> discharging;
    Watts sum;              ///< of those whose power is known
    bool charging = false;  ///< one of them is
    std::string states;     ///< "BAT0 is Full, BAT1 is Discharging"
    std::string missing;    ///< why the power of one is not known
    std::string taken_out;  ///< which is gone
  };
  Look look(Seconds now);
  void follow(const SupplySnapshot& pack);

  SourceInfo info_;
  std::vector<std::string> packs_;
  SensorFiles files_;
  GaugeIntegral integral_;
  std::map<std::string, PackPower> powers_;
  std::set<std::string> not_mains_;
  std::set<std::string> mains_;
  mutable std::mutex mutex_;  ///< guards what check() reads
  std::map<std::string, Drawn> drawn_;
  Joules integrated_;
  int stretches_ = 0;
};

/// As declared in discovery.h, with files that a test supplies.
std::vector<Finding> find_batteries(const SensorFiles& files);

/// What the system's packs hold together. What no pack tells has no value; a sum of which one pack
/// does not know its part has none either.
struct BatteryState {
  std::string name;               ///< "BAT0" or "BAT0+BAT1"
  std::string status;             ///< the kernel's words: "Discharging", "Full+Discharging"
  std::optional<Joules> now;      ///< left
  std::optional<Joules> full;     ///< after a full charge today
  std::optional<Joules> design;   ///< after a full charge when new
  std::optional<double> voltage;  ///< volts now, of the first pack
  std::optional<double> design_voltage;
  std::optional<Watts> power;    ///< discharge rate; only while discharging
  std::optional<bool> on_mains;  ///< a charger is plugged in

  /// What is left of a full charge, from 0 to 1.
  [[nodiscard]] std::optional<double> charge() const;
  /// Today's full charge over that of the new pack.
  [[nodiscard]] std::optional<double> health() const;
};

/// Nothing if the machine has no battery of its own.
std::optional<BatteryState> read_battery_state(const SensorRoot& root);
std::optional<BatteryState> read_battery_state(const SensorFiles& files);

}  // namespace encore::energy
