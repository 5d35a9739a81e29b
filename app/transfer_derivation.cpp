#include "app/transfer_derivation.h"

#include "app/session_input.h"
#include "energy/record_reader.h"
#include "energy/session_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace encore::app {

namespace {

using energy::KeyValue;
using energy::Phase;
using energy::PhaseRow;
using energy::SummaryRow;

std::string value_of(const SummaryRow& row, std::string_view key) {
  return configuration_value(row.configuration, key);
}

bool is_transfer_test(const SummaryRow& row) {
  const std::string test = value_of(row, "test");
  const std::string device = value_of(row, "device");
  return (test == "dynamic" || test == "forced") && !device.empty() && device != "cpu";
}

/// A test that another one is held against: these parts must be so, and those named must be the
/// other's.
struct Wanted {
  std::vector<KeyValue> fixed;
  std::vector<std::string_view> same;

  [[nodiscard]] bool fits(const SummaryRow& row, const SummaryRow& frames) const {
    return std::all_of(
               fixed.begin(), fixed.end(),
               [&](const KeyValue& part) { return value_of(row, part.key) == part.value; }) &&
           std::all_of(same.begin(), same.end(), [&](std::string_view key) {
             return value_of(row, key) == value_of(frames, key);
           });
  }
};

/// The first that fits, of the same group before others.
const SummaryRow* find(std::span<const SummaryRow> rows, const SummaryRow& frames,
                       const Wanted& wanted) {
  const SummaryRow* found = nullptr;
  for (const SummaryRow& row : rows) {
    if (!wanted.fits(row, frames)) continue;
    if (value_of(row, "group") == value_of(frames, "group")) return &row;
    if (found == nullptr) found = &row;
  }
  return found;
}

const PhaseRow* phase_of(std::span<const PhaseRow> phases, const SummaryRow& row, Phase phase) {
  for (const PhaseRow& one : phases) {
    if (one.source == "total" && one.phase == energy::to_string(phase) &&
        one.configuration == row.configuration) {
      return &one;
    }
  }
  return nullptr;
}

/// A sum of figures with signs, some of which may be missing, and of their intervals in quadrature.
class Sum {
 public:
  void add(double sign, std::optional<double> value, std::optional<double> half) {
    known_ = known_ && value.has_value();
    interval_ = interval_ && half.has_value();
    value_ += sign * value.value_or(0.0);
    squares_ += sign * sign * half.value_or(0.0) * half.value_or(0.0);
  }
  /// Of the whole: an error that is a share of the sum.
  void add_share(double share) { squares_ += share * share * value_ * value_; }
  [[nodiscard]] std::optional<double> value() const {
    return known_ ? std::optional(value_) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> half_width() const {
    return known_ && interval_ ? std::optional(std::sqrt(squares_)) : std::nullopt;
  }

 private:
  double value_ = 0.0;
  double squares_ = 0.0;
  bool known_ = true;
  bool interval_ = true;
};

template <class Quantity>
std::optional<double> plain(const std::optional<Quantity>& quantity) {
  if (!quantity) return std::nullopt;
  return quantity->value;
}

/// The relative gain error of a row's joules.
double gain_of(const SummaryRow& row) {
  if (!row.joules || !row.joules_ci95 || !row.joules_ci95_without_gain) return 0.0;
  if (!(std::abs(row.joules->value) > 0.0)) return 0.0;
  const double all = row.joules_ci95->value;
  const double without = row.joules_ci95_without_gain->value;
  return std::sqrt(std::max(0.0, all * all - without * without)) / std::abs(row.joules->value);
}

/// Frames minus their parts, as the tests of the session tell.
class Derivation {
 public:
  Derivation(std::span<const SummaryRow> rows, std::span<const PhaseRow> phases,
             const SummaryRow& frames)
      : rows_(rows), phases_(phases), frames_(frames) {
    add(1.0, frames);
  }

  TransferFigures make() {
    subtract_animation();
    const std::string policy = value_of(frames_, "policy");
    const std::string builder = value_of(frames_, "build_on") == "device" ? "gpu" : "cpu";
    subtract_test(Phase::build,
                  {{{"test", "build"}, {"device", builder}, {"policy", "rebuild"}},
                   {"scene", "structure", "memory", "repeat"}},
                  fmt::format("test build of device {} under policy rebuild", builder));
    subtract_test(Phase::update,
                  {{{"test", "build"}},
                   {"scene", "structure", "memory", "repeat", "device", "policy", "update_case"}},
                  policy == "auto" ? "test of updates under policy auto (there is none)"
                                   : fmt::format("test build of device {} under policy {}",
                                                 value_of(frames_, "device"), policy));
    subtract_test(
        Phase::render,
        {{{"test", "static"}},
         {"scene", "structure", "memory", "repeat", "device", "width", "height", "build_on"}},
        fmt::format("test static of device {} at {}x{}", value_of(frames_, "device"),
                    value_of(frames_, "width"), value_of(frames_, "height")));
    return figures();
  }

 private:
  void add(double sign, const SummaryRow& row) {
    const auto half = plain(row.joules_ci95_without_gain);
    ms_.add(sign, energy::milliseconds(row.mean), energy::in_milliseconds(row.ci95));
    joules_.add(sign, plain(row.joules), half ? half : plain(row.joules_ci95));
    weaken(row.origin);
  }

  void weaken(energy::Origin origin) { origin_ = std::max(origin_, origin); }

  void subtract_animation() {
    const auto share = frames_.shares[Phase::animate];
    if (!share) return;
    // The frame's own interval holds how this part of it varied.
    ms_.add(-1.0, energy::milliseconds(frames_.mean) * *share, 0.0);
    const PhaseRow* row = phase_of(phases_, frames_, Phase::animate);
    joules_.add(-1.0, row != nullptr ? plain(row->joules) : std::nullopt,
                row != nullptr ? plain(row->joules_ci95) : std::nullopt);
    weaken(row != nullptr ? row->origin : energy::Origin::unavailable);
  }

  void subtract_test(Phase phase, const Wanted& wanted, const std::string& name) {
    const std::uint64_t count = frames_.phase_counts[phase];
    if (count == 0) return;
    if (const SummaryRow* test = find(rows_, frames_, wanted)) {
      add(-static_cast<double>(count) / static_cast<double>(frames_.operations), *test);
      return;
    }
    missing_ += (missing_.empty() ? "" : " and no ") + name;
  }

  [[nodiscard]] TransferFigures figures() {
    TransferFigures figures;
    figures.configuration = frames_.configuration;
    figures.bytes = counter_value(frames_, "transfer_bytes");
    if (const auto share = frames_.shares[Phase::transfer]) {
      figures.ms = energy::milliseconds(frames_.mean) * *share;
    }
    if (const PhaseRow* row = phase_of(phases_, frames_, Phase::transfer)) {
      figures.joules = plain(row->joules);
      figures.joules_ci95 = plain(row->joules_ci95);
    }
    if (!missing_.empty()) {
      figures.note = "this session has no " + missing_ + " to derive it from";
      if (figures.joules) figures.origin = frames_.origin;
      return figures;
    }
    joules_.add_share(gain_of(frames_));
    figures.derived_ms = ms_.value();
    figures.derived_ms_ci95 = ms_.half_width();
    figures.derived_joules = joules_.value();
    figures.derived_joules_ci95 = joules_.half_width();
    figures.origin = figures.derived_joules ? origin_
                     : figures.joules       ? frames_.origin
                                            : energy::Origin::unavailable;
    return figures;
  }

  std::span<const SummaryRow> rows_;
  std::span<const PhaseRow> phases_;
  const SummaryRow& frames_;
  Sum ms_;
  Sum joules_;
  energy::Origin origin_ = energy::Origin::measured;  ///< the weakest so far
  std::string missing_;
};

}  // namespace

std::vector<TransferFigures> derive_transfers(std::span<const SummaryRow> rows,
                                              std::span<const PhaseRow> phases) {
  std::vector<TransferFigures> transfers;
  for (const SummaryRow& row : rows) {
    if (is_transfer_test(row)) transfers.push_back(Derivation(rows, phases, row).make());
  }
  return transfers;
}

energy::CsvRecord transfer_header(const std::vector<std::string>& configuration_columns) {
  energy::CsvRecord header = configuration_columns;
  for (const char* name :
       {"transfer_bytes", "transfer_ms", "transfer_joules", "transfer_joules_ci95", "derived_ms",
        "derived_ms_ci95", "derived_joules", "derived_joules_ci95", "energy_provenance", "note"}) {
    header.emplace_back(name);
  }
  return header;
}

energy::CsvRecord to_record(const TransferFigures& figures) {
  energy::CsvRecord record;
  for (const KeyValue& part : figures.configuration) record.push_back(part.value);
  const auto joules = [](std::optional<double> value) {
    return energy::csv_number(value, energy::kUnavailable);
  };
  for (std::string field :
       {energy::csv_number(figures.bytes), energy::csv_number(figures.ms), joules(figures.joules),
        joules(figures.joules_ci95), energy::csv_number(figures.derived_ms),
        energy::csv_number(figures.derived_ms_ci95), joules(figures.derived_joules),
        joules(figures.derived_joules_ci95), std::string(energy::to_string(figures.origin)),
        figures.note}) {
    record.push_back(std::move(field));
  }
  return record;
}

std::vector<TransferFigures> write_transfers(const std::filesystem::path& folder,
                                             std::span<const SummaryRow> rows,
                                             std::span<const PhaseRow> phases) {
  std::vector<TransferFigures> transfers = derive_transfers(rows, phases);
  if (transfers.empty()) return transfers;
  std::vector<std::string> columns;
  for (const KeyValue& part : transfers.front().configuration) columns.push_back(part.key);
  energy::CsvWriter file(folder / "transfer.csv", transfer_header(columns));
  for (const TransferFigures& figures : transfers) file.write(to_record(figures));
  return transfers;
}

}  // namespace encore::app
