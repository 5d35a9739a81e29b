#include "energy/session_columns.h"

#include "energy/record_reader.h"

namespace encore::energy {

namespace {

/// In both files the configuration's columns come before this one …
constexpr std::string_view kAfterConfiguration = "operations";
/// … and the summary's counters after this one.
constexpr std::string_view kBeforeCounters = "energy_provenance";

void append(CsvRecord& record, const std::vector<std::string>& fields) {
  record.insert(record.end(), fields.begin(), fields.end());
}

void append_phases(CsvRecord& header, std::string_view suffix) {
  for (const Phase phase : kPhases) header.push_back(std::string(to_string(phase)).append(suffix));
}

}  // namespace

CsvRecord frame_header(const SessionColumns& columns) {
  CsvRecord header{"time_s"};
  append(header, columns.configuration);
  header.emplace_back(kAfterConfiguration);
  append_phases(header, "_ms");
  append_phases(header, "_joules");
  append(header, {"joules_per_operation", "joules_per_operation_ci95"});
  header.emplace_back(kBeforeCounters);
  return header;
}

CsvRecord summary_header(const SessionColumns& columns) {
  CsvRecord header = columns.configuration;
  append(header, {std::string(kAfterConfiguration), "builds", "updates", "frames", "measured_s",
                  "ms_per_operation", "ms_per_operation_ci95", "effective_rows", "row_median_ms",
                  "row_p95_ms"});
  append_phases(header, "_share");
  append(
      header,
      {"source", "watts", "watts_ci95", "watts_ci95_without_gain", "joules_per_operation",
       "joules_per_operation_ci95", "joules_per_operation_ci95_without_gain",
       "net_joules_per_operation", "net_joules_per_operation_ci95", "idle_watts", "idle_watts_ci95",
       "cpu_temperature_c", "cpu_clock_mhz", "throttle_events", std::string(kBeforeCounters)});
  append(header, columns.counters);
  return header;
}

CsvRecord to_record(const FrameRow& row) {
  CsvRecord record{csv_number(row.time.value)};
  for (const KeyValue& part : row.configuration) record.push_back(part.value);
  record.push_back(csv_number(static_cast<double>(row.operations)));
  for (const Phase phase : kPhases) {
    record.push_back(csv_number(in_milliseconds(row.phases[phase])));
  }
  for (const Phase phase : kPhases) {
    // A phase that did not happen has no energy; one that did may have one that nobody could tell.
    record.push_back(csv_number(plain(row.joules[phase]),
                                row.phases[phase] ? kUnavailable : std::string_view()));
  }
  record.push_back(csv_number(plain(row.operation_joules), kUnavailable));
  record.push_back(csv_number(plain(row.operation_joules_ci95), kUnavailable));
  record.emplace_back(to_string(row.origin));
  return record;
}

CsvRecord to_record(const SummaryRow& row) {
  CsvRecord record;
  for (const KeyValue& part : row.configuration) record.push_back(part.value);
  const auto count = [](std::uint64_t n) { return csv_number(static_cast<double>(n)); };
  append(record,
         {count(row.operations), count(row.phase_counts[Phase::build]),
          count(row.phase_counts[Phase::update]), count(row.phase_counts[Phase::render]),
          csv_number(row.seconds.value), csv_number(milliseconds(row.mean)),
          csv_number(in_milliseconds(row.ci95)), csv_number(row.effective_rows),
          csv_number(in_milliseconds(row.median)), csv_number(in_milliseconds(row.percentile95))});
  for (const Phase phase : kPhases) record.push_back(csv_number(row.shares[phase]));
  const auto energy = [](auto quantity) { return csv_number(plain(quantity), kUnavailable); };
  append(record, {row.source, energy(row.watts), energy(row.watts_ci95),
                  energy(row.watts_ci95_without_gain), energy(row.joules), energy(row.joules_ci95),
                  energy(row.joules_ci95_without_gain), energy(row.net_joules),
                  energy(row.net_joules_ci95), energy(row.idle_watts), energy(row.idle_watts_ci95),
                  csv_number(row.temperature_c), csv_number(row.clock_mhz),
                  csv_number(row.throttle_events), std::string(to_string(row.origin))});
  for (const Counter& counter : row.counters) {
    record.push_back(
        csv_number(counter.value, counter.unavailable ? kUnavailable : std::string_view()));
  }
  return record;
}

FrameRow frame_from_record(const CsvRecord& header, const CsvRecord& record) {
  RecordReader fields(header, record);
  FrameRow row;
  row.time = Seconds(fields.required());
  row.configuration = fields.configuration(kAfterConfiguration);
  row.operations = fields.count();
  for (const Phase phase : kPhases) row.phases[phase] = fields.quantity<Seconds>(1e3);
  for (const Phase phase : kPhases) row.joules[phase] = fields.quantity<Joules>();
  row.operation_joules = fields.quantity<Joules>();
  row.operation_joules_ci95 = fields.quantity<Joules>();
  row.origin = fields.origin();
  return row;
}

SummaryRow summary_from_record(const CsvRecord& header, const CsvRecord& record) {
  RecordReader fields(header, record);
  SummaryRow row;
  row.configuration = fields.configuration(kAfterConfiguration);
  row.operations = fields.count();
  for (const Phase phase : {Phase::build, Phase::update, Phase::render}) {
    row.phase_counts[phase] = fields.count();
  }
  row.seconds = Seconds(fields.required());
  row.mean = Seconds(fields.required() / 1e3);
  row.ci95 = fields.quantity<Seconds>(1e3);
  row.effective_rows = fields.number();
  row.median = fields.quantity<Seconds>(1e3);
  row.percentile95 = fields.quantity<Seconds>(1e3);
  for (const Phase phase : kPhases) row.shares[phase] = fields.number();
  row.source = fields.text();
  row.watts = fields.quantity<Watts>();
  row.watts_ci95 = fields.quantity<Watts>();
  row.watts_ci95_without_gain = fields.quantity<Watts>();
  row.joules = fields.quantity<Joules>();
  row.joules_ci95 = fields.quantity<Joules>();
  row.joules_ci95_without_gain = fields.quantity<Joules>();
  row.net_joules = fields.quantity<Joules>();
  row.net_joules_ci95 = fields.quantity<Joules>();
  row.idle_watts = fields.quantity<Watts>();
  row.idle_watts_ci95 = fields.quantity<Watts>();
  row.temperature_c = fields.number();
  row.clock_mhz = fields.number();
  row.throttle_events = fields.number();
  row.origin = fields.origin();
  while (!fields.done()) {
    std::string name = fields.name();
    const bool unavailable = fields.next_is(kUnavailable);
    row.counters.push_back({std::move(name), fields.number(), unavailable});
  }
  return row;
}

}  // namespace encore::energy
