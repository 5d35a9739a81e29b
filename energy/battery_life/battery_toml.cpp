#include "energy/battery_life/battery_toml.h"

#include "energy/battery_life/key_suggestion.h"
#include "energy/battery_life/peukert.h"
#include "energy/toml_depth.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace encore::energy {

namespace {

constexpr std::array<std::string_view, 16> kKeys = {
    "preset",       "name",        "capacity_ah", "capacity_wh",        "nominal_v",
    "cutoff_v",     "soc",         "series",      "parallel",           "peukert_exponent",
    "peukert_runs", "rated_hours", "kinetic_c",   "kinetic_rate_per_s", "kinetic_capacity_ah",
    "cell"};
constexpr std::array<std::string_view, 3> kCellKeys = {"r0_ohm", "rc", "ocv"};
constexpr std::array<std::string_view, 2> kRcKeys = {"ohm", "farad"};
constexpr std::array<std::string_view, 2> kRunKeys = {"amperes", "minutes"};

/// What a number may be.
struct Range {
  double min = 0.0;
  double max = 1e15;
  bool above_min = false;  ///< min itself is not allowed

  [[nodiscard]] bool holds(double x) const { return (above_min ? x > min : x >= min) && x <= max; }
  [[nodiscard]] std::string text() const {
    const std::string lower = fmt::format("{} {:g}", above_min ? "above" : "at least", min);
    return max < 1e15 ? fmt::format("{} and at most {:g}", lower, max) : lower;
  }
};
constexpr Range kPositive{0.0, 1e15, true};
constexpr Range kNotNegative{0.0, 1e15, false};

/// A table with the name of its file, read key by key.
class Section {
 public:
  Section(const toml::table& table, std::string title, const std::string& file)
      : table_(table), title_(std::move(title)), file_(file) {}

  [[noreturn]] void fail(const toml::node& node, const std::string& message) const {
    throw BatteryError(fmt::format("{}: {}", place(node.source().begin), message));
  }
  [[noreturn]] void fail(const std::string& message) const { fail(table_, message); }

  [[nodiscard]] double number(const toml::node& node, std::string_view key, Range range) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail(node, fmt::format("'{}' must be a number", key));
    if (!range.holds(*value)) {
      fail(node, fmt::format("'{}' must be {}, not {:g}", key, range.text(), *value));
    }
    return *value;
  }
  [[nodiscard]] std::optional<double> number(std::string_view key, Range range) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    return number(*node, key, range);
  }
  [[nodiscard]] std::optional<int> count(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_integer()) fail(*node, fmt::format("'{}' must be a whole number", key));
    return static_cast<int>(number(*node, key, Range{1.0, 1e6, false}));
  }
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::string>();
    if (!value) fail(*node, fmt::format("'{}' must be a string", key));
    return value;
  }
  [[nodiscard]] const toml::array* array(std::string_view key, std::string_view of) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_array()) fail(*node, fmt::format("'{}' must be an array of {}", key, of));
    return node->as_array();
  }
  /// A table inside an array or below a key.
  [[nodiscard]] Section inner(const toml::node& node, const std::string& title) const {
    if (!node.is_table()) fail(node, fmt::format("{} must be a table", title));
    return {*node.as_table(), title, file_};
  }

  void refuse_unknown(std::span<const std::string_view> known) const {
    for (const auto& [key, node] : table_) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      throw BatteryError(fmt::format("{}: unknown key '{}' in {}{}", place(key.source().begin),
                                     key.str(), title_, nearest_key(key.str(), known)));
    }
  }
  [[nodiscard]] const toml::table& raw() const { return table_; }

 private:
  [[nodiscard]] std::string place(const toml::source_position& position) const {
    // Tables that dotted keys imply have no place of their own; the parser then says line 0.
    return position.line == 0 ? file_
                              : fmt::format("{}:{}:{}", file_, position.line, position.column);
  }

  const toml::table& table_;
  std::string title_;
  const std::string& file_;
};

void read_cell(const Section& section, Cell& cell) {
  section.refuse_unknown(kCellKeys);
  cell.r0_ohms = section.number("r0_ohm", kNotNegative).value_or(cell.r0_ohms);
  if (const toml::array* branches = section.array("rc", "tables {ohm, farad}")) {
    cell.branches.clear();
    for (const toml::node& node : *branches) {
      const Section branch = section.inner(node, "an element of 'rc'");
      branch.refuse_unknown(kRcKeys);
      const auto ohms = branch.number("ohm", kNotNegative);
      const auto farads = branch.number("farad", kNotNegative);
      if (!ohms || !farads) branch.fail("an RC branch needs 'ohm' and 'farad'");
      cell.branches.push_back({*ohms, *farads});
    }
  }
  if (const toml::array* points = section.array("ocv", "pairs [soc, volts]")) {
    cell.ocv.clear();
    for (const toml::node& node : *points) {
      const toml::array* pair = node.as_array();
      if (pair == nullptr || pair->size() != 2) {
        section.fail(node, "an element of 'ocv' must be a pair [soc, volts]");
      }
      const double soc = section.number((*pair)[0], "soc", Range{0.0, 1.0, false});
      const double volts = section.number((*pair)[1], "volts", kPositive);
      if (!cell.ocv.empty() && (soc <= cell.ocv.back().soc || volts < cell.ocv.back().volts)) {
        section.fail(node, "the 'ocv' table must rise in charge and not fall in voltage");
      }
      cell.ocv.push_back({soc, volts});
    }
    if (cell.ocv.size() < 2) section.fail(*points, "'ocv' needs two points or more");
  }
}

/// The exponent through two discharges.
double read_peukert_runs(const Section& section, const toml::array& runs) {
  if (runs.size() != 2) section.fail(runs, "'peukert_runs' needs two discharges");
  std::array<MeasuredDischarge, 2> measured;
  for (std::size_t i = 0; i < 2; ++i) {
    const Section run = section.inner(runs[i], "an element of 'peukert_runs'");
    run.refuse_unknown(kRunKeys);
    const auto amperes = run.number("amperes", kPositive);
    const auto minutes = run.number("minutes", kPositive);
    if (!amperes || !minutes) run.fail("a discharge needs 'amperes' and 'minutes'");
    measured[i] = {*amperes, Seconds(*minutes * 60.0)};
  }
  const auto exponent = fit_peukert(measured[0], measured[1]);
  if (!exponent) section.fail(runs, "'peukert_runs' needs two different currents");
  if (!(*exponent >= 1.0 && *exponent <= 2.0)) {
    section.fail(
        runs, fmt::format("'peukert_runs' imply an exponent of {:.4g}, not in 1 ... 2", *exponent));
  }
  return *exponent;
}

/// The pack before anything else is known of it: a preset, or what the label says.
Battery read_label(const Section& section, const std::string& file) {
  const auto amp_hours = section.number("capacity_ah", kPositive);
  const auto watt_hours = section.number("capacity_wh", kPositive);
  const auto volts = section.number("nominal_v", kPositive);
  Battery battery;
  if (const auto preset = section.text("preset")) {
    const auto found = battery_preset(*preset);
    if (!found) {
      section.fail(
          *section.raw().get("preset"),
          fmt::format("there is no preset '{}'; there are {}{}", *preset,
                      fmt::join(battery_presets(), ", "), nearest_key(*preset, battery_presets())));
    }
    battery = *found;
    battery.source = fmt::format("{} (on preset {})", file, *preset);
    battery.nominal_volts = volts.value_or(battery.nominal_volts);
  } else {
    if (!volts || (!amp_hours && !watt_hours)) {
      section.fail("a battery needs 'nominal_v' and 'capacity_ah' or 'capacity_wh', or a 'preset'");
    }
    const double coulombs = (amp_hours ? *amp_hours : *watt_hours / *volts) * 3600.0;
    // Each is a number that may be; the quotient of two extreme ones need not.
    if (!std::isfinite(coulombs) || !(coulombs > 0.0)) {
      section.fail("'capacity_wh' by 'nominal_v' is no charge that a battery can have");
    }
    battery = battery_from_label("battery", *volts, coulombs);
    battery.source = file;
  }
  // One of the two capacities implies the other.
  if (amp_hours) {
    battery.coulombs = *amp_hours * 3600.0;
    battery.full = Joules(battery.coulombs * battery.nominal_volts);
  }
  if (watt_hours) {
    battery.full = Joules(*watt_hours * 3600.0);
    if (!amp_hours) battery.coulombs = battery.full.value / battery.nominal_volts;
  } else if (volts && !amp_hours) {
    battery.full = Joules(battery.coulombs * battery.nominal_volts);
  }
  return battery;
}

Battery read_battery(const Section& section, const std::string& file) {
  section.refuse_unknown(kKeys);
  Battery battery = read_label(section, file);
  battery.name = section.text("name").value_or(battery.name);
  if (const auto series = section.count("series")) {
    battery.series = *series;
    battery.cutoff_volts = *series * kGenericCutoffVolts;
  }
  battery.parallel = section.count("parallel").value_or(battery.parallel);
  battery.cutoff_volts = section.number("cutoff_v", kNotNegative).value_or(battery.cutoff_volts);
  battery.soc = section.number("soc", Range{0.0, 1.0, false}).value_or(battery.soc);

  PeukertParameters& peukert = battery.peukert;
  peukert.rated_hours = section.number("rated_hours", kPositive).value_or(peukert.rated_hours);
  if (const toml::array* runs = section.array("peukert_runs", "two tables {amperes, minutes}")) {
    peukert.exponent = read_peukert_runs(section, *runs);
  }
  peukert.exponent =
      section.number("peukert_exponent", Range{1.0, 2.0, false}).value_or(peukert.exponent);

  KineticParameters& kinetic = battery.kinetic;
  kinetic.c = section.number("kinetic_c", Range{0.0, 1.0, true}).value_or(kinetic.c);
  kinetic.rate_per_s =
      section.number("kinetic_rate_per_s", kNotNegative).value_or(kinetic.rate_per_s);
  if (const auto amp_hours = section.number("kinetic_capacity_ah", kPositive)) {
    kinetic.coulombs = *amp_hours * 3600.0;
  }
  if (const toml::node* cell = section.raw().get("cell")) {
    read_cell(section.inner(*cell, "[battery.cell]"), battery.cell);
  }
  if (const std::string fault = battery_fault(battery); !fault.empty()) section.fail(fault);
  return battery;
}

}  // namespace

std::span<const std::string_view> battery_keys() {
  return kKeys;
}

std::span<const std::string_view> battery_cell_keys() {
  return kCellKeys;
}

Battery parse_battery_toml(std::string_view text, const std::string& file) {
  if (const auto line = line_of_deep_key(text)) {
    throw BatteryError(
        fmt::format("{}:{}: a key of more than {} parts", file, *line, kMostKeyParts));
  }
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw BatteryError(fmt::format("{}:{}:{}: {}", file, at.line, at.column, error.description()));
  }
  const Section whole(root, "the file", file);
  const toml::node* battery = root.get("battery");
  if (battery == nullptr) {
    throw BatteryError(
        fmt::format("{}: there is no table [battery]; docs/battery-life.md shows one", file));
  }
  return read_battery(whole.inner(*battery, "[battery]"), file);
}

Battery read_battery_toml(const std::filesystem::path& path) {
  const auto fail = [&](const char* reason) {
    throw BatteryError(fmt::format("cannot read {}: {}", path.string(), reason));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail("it is a folder");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(std::strerror(errno));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_battery_toml(text, path.string());
}

}  // namespace encore::energy
