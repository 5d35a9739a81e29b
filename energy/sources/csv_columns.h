#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// What a column of a recording holds.
enum class RecordedQuantity { time, power, energy, volts, amps };
inline constexpr std::size_t kRecordedQuantities = 5;

/// A column's quantity and the factor that turns its numbers into SI units.
struct RecordedColumn {
  RecordedQuantity quantity = RecordedQuantity::time;
  double factor = 1.0;
  bool watt_hours = false;
};

/// Understands a header's field such as "Power (mW)"; nothing if it is none of the quantities.
std::optional<RecordedColumn> understand_column(std::string_view name);

/// The fields of a line, without blanks and quotes around them.
std::vector<std::string> split_fields(std::string_view line, char separator);

/// The separator that a header line uses.
char separator_of(std::string_view header);

/// Which column of a recording holds what.
class RecordingColumns {
 public:
  struct Place {
    std::size_t index = 0;
    RecordedColumn column;
  };
  /// Throws std::invalid_argument, saying what is missing or named twice.
  explicit RecordingColumns(const std::vector<std::string>& header);

  [[nodiscard]] const std::optional<Place>& of(RecordedQuantity quantity) const {
    return places_[static_cast<std::size_t>(quantity)];
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Whether the energy column is to be used.
  [[nodiscard]] bool counts_energy() const;

 private:
  std::array<std::optional<Place>, kRecordedQuantities> places_;
  std::size_t count_ = 0;
};

}  // namespace encore::energy
