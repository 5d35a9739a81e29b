#pragma once

#include "energy/csv.h"
#include "energy/session.h"
#include "energy/session_columns.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace encore::energy {

/// The plain number in a quantity's unit; nothing stays nothing.
template <class Unit>
std::optional<double> plain(std::optional<Quantity<Unit>> quantity) {
  if (!quantity) return std::nullopt;
  return quantity->value;
}
inline std::optional<double> in_milliseconds(std::optional<Seconds> time) {
  if (!time) return std::nullopt;
  return milliseconds(*time);
}

/// Takes the fields of a CSV record one after the other, by the order of its header. Throws
/// SessionError for what does not fit.
class RecordReader {
 public:
  RecordReader(const CsvRecord& header, const CsvRecord& record)
      : header_(header), record_(record) {
    if (header.size() != record.size()) {
      throw SessionError("a row has " + std::to_string(record.size()) + " fields, its header " +
                         std::to_string(header.size()));
    }
  }

  [[nodiscard]] bool done() const { return next_ == record_.size(); }
  [[nodiscard]] const std::string& name() const {
    if (done()) throw SessionError("a column is missing");
    return header_[next_];
  }
  const std::string& text() {
    (void)name();
    return record_[next_++];
  }

  /// A finite number, or nothing for an empty or unavailable one.
  std::optional<double> number() {
    const std::string& column = name();
    const std::string& field = text();
    if (field.empty() || field == kUnavailable) return std::nullopt;
    const auto value = parse_csv_number(field);
    if (!value || !std::isfinite(*value)) {
      throw SessionError("column " + column + " holds '" + field + "', not a number");
    }
    return value;
  }
  double required() {
    const std::string& column = name();
    const auto value = number();
    if (!value) throw SessionError("column " + column + " is empty");
    return *value;
  }
  /// A whole number of things.
  std::uint64_t count() {
    const std::string& column = name();
    const double value = required();
    constexpr double kMost = 9007199254740992.0;  // beyond it a double skips whole numbers
    if (!(value >= 0.0 && value <= kMost && value == std::floor(value))) {
      throw SessionError("column " + column + " holds '" + record_[next_ - 1] + "', not a count");
    }
    return static_cast<std::uint64_t>(value);
  }
  template <class Unit>
  std::optional<Unit> quantity(double scale = 1.0) {
    const auto value = number();
    if (!value) return std::nullopt;
    return Unit(*value / scale);
  }
  Origin origin() {
    const std::string& word = text();
    const auto parsed = parse_origin(word);
    if (!parsed) throw SessionError("'" + word + "' is no provenance");
    return *parsed;
  }
  [[nodiscard]] bool next_is(std::string_view word) const {
    return !done() && record_[next_] == word;
  }
  /// The columns up to the one named `end`.
  std::vector<KeyValue> configuration(std::string_view end) {
    std::vector<KeyValue> values;
    while (name() != end) {
      std::string key = name();
      values.push_back({std::move(key), text()});
    }
    return values;
  }

 private:
  const CsvRecord& header_;
  const CsvRecord& record_;
  std::size_t next_ = 0;
};

}  // namespace encore::energy
