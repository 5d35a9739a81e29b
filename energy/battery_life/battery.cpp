#include "energy/battery_life/battery.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::energy {

namespace {

constexpr std::array<std::string_view, 2> kPresets = {"thesis-laptop", "generic-3s"};

bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

std::string cell_fault(const Cell& cell) {
  if (!std::isfinite(cell.r0_ohms) || cell.r0_ohms < 0.0) return "R0 is not 0 or more";
  for (const RcBranch& branch : cell.branches) {
    const bool good = std::isfinite(branch.ohms) && branch.ohms >= 0.0 &&
                      std::isfinite(branch.farads) && branch.farads >= 0.0;
    if (!good) return "an RC branch needs ohms and farads of 0 or more";
  }
  if (cell.ocv.size() < 2) return "the OCV table needs two points or more";
  for (std::size_t i = 0; i < cell.ocv.size(); ++i) {
    const OcvPoint& point = cell.ocv[i];
    if (!(point.soc >= 0.0 && point.soc <= 1.0)) return "an OCV point's charge is not in 0 ... 1";
    if (!positive(point.volts)) return "an OCV point's voltage is not positive";
    if (i == 0) continue;
    if (point.soc <= cell.ocv[i - 1].soc) return "the OCV table's charges do not rise";
    if (point.volts < cell.ocv[i - 1].volts) return "the OCV table's voltages fall";
  }
  return {};
}

}  // namespace

Cell generic_cell() {
  Cell cell;
  cell.r0_ohms = 0.0194;
  cell.branches = {{0.005, 2.0}, {0.0146, 1360.0}, {0.656, 82720.0}};
  cell.ocv = {{0.00, 3.00}, {0.05, 3.35}, {0.10, 3.46}, {0.20, 3.56}, {0.30, 3.61}, {0.40, 3.65},
              {0.50, 3.70}, {0.60, 3.78}, {0.70, 3.87}, {0.80, 3.96}, {0.90, 4.06}, {1.00, 4.18}};
  return cell;
}

Battery battery_from_label(std::string name, double nominal_volts, double coulombs) {
  if (!positive(nominal_volts) || !positive(coulombs)) {
    throw std::invalid_argument("a battery needs a positive voltage and capacity");
  }
  // Beyond any pack there is; keeps the conversions below defined.
  constexpr double kMostCells = 1e6;
  const auto count = [kMostCells](double cells) {
    return static_cast<int>(std::clamp(std::round(cells), 1.0, kMostCells));
  };
  Battery battery;
  battery.name = std::move(name);
  battery.source = "its label; cells assumed typical";
  battery.series = count(nominal_volts / kGenericCellVolts);
  battery.parallel = count(coulombs / kGenericCellCoulombs);
  battery.nominal_volts = nominal_volts;
  battery.cutoff_volts = battery.series * kGenericCutoffVolts;
  battery.coulombs = coulombs;
  battery.full = Joules(nominal_volts * coulombs);
  battery.cell = generic_cell();
  return battery;
}

std::span<const std::string_view> battery_presets() {
  return kPresets;
}

std::optional<Battery> battery_preset(std::string_view name) {
  if (std::find(kPresets.begin(), kPresets.end(), name) == kPresets.end()) return std::nullopt;
  Battery battery = battery_from_label(std::string(name), 11.1, 4.8 * 3600.0);
  battery.source = fmt::format("preset {}", name);
  if (name == "thesis-laptop") battery.full = Joules(53.0 * 3600.0);
  return battery;
}

std::string battery_fault(const Battery& battery) {
  if (battery.series < 1 || battery.parallel < 1) return "there must be one cell at least";
  if (!positive(battery.nominal_volts)) return "the nominal voltage is not positive";
  if (!positive(battery.coulombs) || !positive(battery.full.value)) {
    return "the capacity is not positive";
  }
  const double ratio = battery.full.value / (battery.nominal_volts * battery.coulombs);
  if (ratio < 0.75 || ratio > 1.25) {
    return fmt::format("{:.4g} Wh is not about {:.4g} Ah at {:.4g} V", battery.full.value / 3600.0,
                       battery.coulombs / 3600.0, battery.nominal_volts);
  }
  if (!(battery.soc >= 0.0 && battery.soc <= 1.0)) return "the charge now is not in 0 ... 1";
  if (!(battery.peukert.exponent >= 1.0 && battery.peukert.exponent <= 2.0)) {
    return "the Peukert exponent is not in 1 ... 2";
  }
  if (!positive(battery.peukert.rated_hours)) return "the rated hours are not positive";
  const KineticParameters& kinetic = battery.kinetic;
  if (!(kinetic.c > 0.0 && kinetic.c <= 1.0)) return "the kinetic c is not in 0 ... 1";
  if (!std::isfinite(kinetic.rate_per_s) || kinetic.rate_per_s < 0.0) {
    return "the kinetic rate is not 0 or more";
  }
  if (kinetic.coulombs && !positive(*kinetic.coulombs)) {
    return "the kinetic capacity is not positive";
  }
  std::string fault = cell_fault(battery.cell);
  if (!fault.empty()) return fault;
  if (!std::isfinite(battery.cutoff_volts) || battery.cutoff_volts < 0.0) {
    return "the cut-off voltage is not 0 or more";
  }
  const double highest = battery.series * battery.cell.ocv.back().volts;
  if (battery.cutoff_volts >= highest) {
    return fmt::format("the cut-off of {:.4g} V is not below the {:.4g} V of the full pack",
                       battery.cutoff_volts, highest);
  }
  return {};
}

}  // namespace encore::energy
