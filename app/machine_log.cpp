#include "app/machine_log.h"

#include <utility>

namespace encore::app {

namespace {

constexpr energy::Seconds kPeriod(1.0);

bool tells_anything(const energy::MachineState& state) {
  return state != energy::MachineState{};
}

}  // namespace

energy::CsvRecord machine_log_header() {
  return {"time_s",     "cpu_temperature_c", "cpu_clock_mhz", "throttle_events",
          "on_battery", "gpu_temperature_c", "gpu_clock_mhz"};
}

MachineLog::MachineLog(const std::filesystem::path& folder, energy::CsvWriter::Open how,
                       energy::SensorRoot root, energy::Seconds session_start)
    : file_(folder / "machine.csv", machine_log_header(), how),
      root_(std::move(root)),
      start_(session_start) {}

void MachineLog::poll(energy::Seconds now) {
  if (!last_ || now - *last_ >= kPeriod) read(now);
}

void MachineLog::read(energy::Seconds now) {
  last_ = now;
  const energy::MachineState state = energy::read_machine_state(root_);
  temperature_.add(state.cpu_temperature_c);
  clock_.add(state.cpu_clock_mhz);
  if (state.throttle_events) {
    last_throttle_ = static_cast<double>(*state.throttle_events);
    if (!first_throttle_) first_throttle_ = last_throttle_;
  }
  if (!tells_anything(state)) return;
  const std::optional<double> battery =
      state.on_battery ? std::optional<double>(*state.on_battery ? 1.0 : 0.0) : std::nullopt;
  file_.write({energy::csv_number((now - start_).value),
               energy::csv_number(state.cpu_temperature_c), energy::csv_number(state.cpu_clock_mhz),
               state.throttle_events ? energy::csv_number(*last_throttle_) : std::string(),
               energy::csv_number(battery), energy::csv_number(state.gpu_temperature_c),
               energy::csv_number(state.gpu_clock_mhz)});
}

void MachineLog::begin(energy::Seconds now) {
  temperature_ = {};
  clock_ = {};
  first_throttle_.reset();
  last_throttle_.reset();
  read(now);
}

void MachineLog::end(energy::Seconds now, energy::SummaryRow& row) {
  read(now);
  row.temperature_c = temperature_.value();
  row.clock_mhz = clock_.value();
  if (first_throttle_ && last_throttle_) row.throttle_events = *last_throttle_ - *first_throttle_;
}

}  // namespace encore::app
