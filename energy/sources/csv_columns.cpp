#include "energy/sources/csv_columns.h"

#include <fmt/format.h>

#include <cctype>
#include <stdexcept>

namespace encore::energy {

namespace {

using Quantity = RecordedQuantity;

struct QuantityWord {
  std::string_view word;
  Quantity quantity;
};
constexpr QuantityWord kQuantityWords[] = {
    {"time", Quantity::time},     {"t", Quantity::time},        {"timestamp", Quantity::time},
    {"elapsed", Quantity::time},  {"seconds", Quantity::time},  {"power", Quantity::power},
    {"p", Quantity::power},       {"watts", Quantity::power},   {"watt", Quantity::power},
    {"w", Quantity::power},       {"energy", Quantity::energy}, {"e", Quantity::energy},
    {"joules", Quantity::energy}, {"joule", Quantity::energy},  {"j", Quantity::energy},
    {"voltage", Quantity::volts}, {"volts", Quantity::volts},   {"volt", Quantity::volts},
    {"u", Quantity::volts},       {"v", Quantity::volts},       {"current", Quantity::amps},
    {"amps", Quantity::amps},     {"ampere", Quantity::amps},   {"amperes", Quantity::amps},
    {"i", Quantity::amps},        {"a", Quantity::amps},
};

struct UnitWord {
  std::string_view word;
  Quantity quantity;
  double factor;
};
constexpr UnitWord kUnitWords[] = {
    {"s", Quantity::time, 1},         {"sec", Quantity::time, 1},
    {"seconds", Quantity::time, 1},   {"ms", Quantity::time, 1e-3},
    {"us", Quantity::time, 1e-6},     {"ns", Quantity::time, 1e-9},
    {"min", Quantity::time, 60},      {"h", Quantity::time, 3600},
    {"w", Quantity::power, 1},        {"watts", Quantity::power, 1},
    {"mw", Quantity::power, 1e-3},    {"uw", Quantity::power, 1e-6},
    {"kw", Quantity::power, 1e3},     {"j", Quantity::energy, 1},
    {"joules", Quantity::energy, 1},  {"mj", Quantity::energy, 1e-3},
    {"uj", Quantity::energy, 1e-6},   {"kj", Quantity::energy, 1e3},
    {"wh", Quantity::energy, 3600},   {"mwh", Quantity::energy, 3.6},
    {"kwh", Quantity::energy, 3.6e6}, {"v", Quantity::volts, 1},
    {"volts", Quantity::volts, 1},    {"mv", Quantity::volts, 1e-3},
    {"a", Quantity::amps, 1},         {"amps", Quantity::amps, 1},
    {"ma", Quantity::amps, 1e-3},     {"ua", Quantity::amps, 1e-6},
};

/// The words of a name in lower case: "Power(mW)" has "power" and "mw".
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) == 0) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    words.back() += static_cast<char>(std::tolower(byte));
  }
  return words;
}

}  // namespace

std::optional<RecordedColumn> understand_column(std::string_view name) {
  const std::vector<std::string> words = words_of(name);
  if (words.empty() || words.size() > 2) return std::nullopt;
  for (const QuantityWord& known : kQuantityWords) {
    if (words[0] != known.word) continue;
    RecordedColumn column{known.quantity, 1.0, false};
    if (words.size() == 1) return column;
    for (const UnitWord& unit : kUnitWords) {
      if (words[1] != unit.word || unit.quantity != known.quantity) continue;
      column.factor = unit.factor;
      column.watt_hours = unit.word.ends_with("wh");
      return column;
    }
  }
  return std::nullopt;
}

std::vector<std::string> split_fields(std::string_view line, char separator) {
  std::vector<std::string> fields;
  while (true) {
    const std::size_t end = line.find(separator);
    std::string_view field = line.substr(0, end);
    const std::string_view around = separator == '\t' ? " \r\"" : " \t\r\"";
    const std::size_t first = field.find_first_not_of(around);
    field = first == std::string_view::npos
                ? std::string_view()
                : field.substr(first, field.find_last_not_of(around) - first + 1);
    fields.emplace_back(field);
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

char separator_of(std::string_view header) {
  for (const char separator : {';', '\t'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

RecordingColumns::RecordingColumns(const std::vector<std::string>& header) : count_(header.size()) {
  for (std::size_t i = 0; i < header.size(); ++i) {
    const auto column = understand_column(header[i]);
    if (!column) continue;
    auto& place = places_[static_cast<std::size_t>(column->quantity)];
    if (place) {
      throw std::invalid_argument(
          fmt::format("the columns '{}' and '{}' mean the same; rename or remove one",
                      header[place->index], header[i]));
    }
    place = Place{i, *column};
  }
  const bool power = of(Quantity::power) || (of(Quantity::volts) && of(Quantity::amps));
  std::string found = "the header is";
  for (const std::string& name : header) found += fmt::format(" '{}'", name);
  if (!of(Quantity::time)) {
    throw std::invalid_argument("no column of time, such as 'time_s' or 'Time (ms)'; " + found);
  }
  if (!power && !of(Quantity::energy)) {
    throw std::invalid_argument(
        "no column of energy or power, such as 'watts', 'Power (mW)' or 'energy_j', nor both "
        "volts and amperes; " +
        found);
  }
}

bool RecordingColumns::counts_energy() const {
  const auto& energy = of(Quantity::energy);
  const bool power = of(Quantity::power) || (of(Quantity::volts) && of(Quantity::amps));
  // Watt-hour counters of meters are coarse: a milliwatt-hour is 3.6 J.
  return energy && (!power || !energy->column.watt_hours);
}

}  // namespace encore::energy
