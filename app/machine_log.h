#pragma once

#include "energy/csv.h"
#include "energy/machine_state.h"
#include "energy/session.h"

#include <filesystem>
#include <optional>

namespace encore::app {

/// The columns of machine.csv.
energy::CsvRecord machine_log_header();

/// Notes temperature, clock and throttling about once a second, between operations, and what they
/// were on average while a configuration was measured.
class MachineLog {
 public:
  /// Creates machine.csv in `folder`, or goes on with it. Throws energy::SessionError.
  MachineLog(const std::filesystem::path& folder, energy::CsvWriter::Open how,
             energy::SensorRoot root, energy::Seconds session_start);

  /// Reads the machine if a second has passed since the last time.
  void poll(energy::Seconds now);

  /// Forgets what was gathered so far: a new configuration begins. Reads the machine.
  void begin(energy::Seconds now);
  /// Puts the means since begin() into the row. Reads the machine.
  void end(energy::Seconds now, energy::SummaryRow& row);

 private:
  void read(energy::Seconds now);

  struct Mean {
    double sum = 0.0;
    std::size_t count = 0;
    void add(std::optional<double> value) {
      if (value) sum += *value;
      if (value) ++count;
    }
    [[nodiscard]] std::optional<double> value() const {
      if (count == 0) return std::nullopt;
      return sum / static_cast<double>(count);
    }
  };

  energy::CsvWriter file_;
  energy::SensorRoot root_;
  energy::Seconds start_;
  std::optional<energy::Seconds> last_;
  Mean temperature_;
  Mean clock_;
  std::optional<double> first_throttle_;
  std::optional<double> last_throttle_;
};

}  // namespace encore::app
