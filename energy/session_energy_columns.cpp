#include "energy/session_energy_columns.h"

#include "energy/record_reader.h"

namespace encore::energy {

namespace {

CsvRecord after_configuration(const SessionColumns& columns,
                              std::initializer_list<std::string> more) {
  CsvRecord header = columns.configuration;
  header.insert(header.end(), more);
  return header;
}

CsvRecord configuration_of(const std::vector<KeyValue>& configuration) {
  CsvRecord record;
  for (const KeyValue& part : configuration) record.push_back(part.value);
  return record;
}

std::string yes_or_no(bool yes) {
  return yes ? "1" : "0";
}

}  // namespace

CsvRecord sample_header() {
  return {"time_s", "source", "watts", "joules", "changed", "restarted", "provenance"};
}

CsvRecord event_header() {
  return {"time_s", "source", "message"};
}

CsvRecord phase_header(const SessionColumns& columns) {
  return after_configuration(
      columns, {"source", "phase", "method", "busy_s", "operations", "watts", "watts_ci95",
                "joules_per_operation", "joules_per_operation_ci95", "net_joules_per_operation",
                "net_joules_per_operation_ci95", "energy_provenance", "note"});
}

CsvRecord window_header(const SessionColumns& columns) {
  return after_configuration(columns, {"kind", "from_s", "to_s"});
}

CsvRecord convergence_header(const SessionColumns& columns) {
  return after_configuration(
      columns, {"elapsed_s", "quantity", "mean", "ci95", "relative_ci95", "effective_samples",
                "allan_deviation", "allan_window_s", "drift_per_s"});
}

CsvRecord to_record(const SampleRow& row) {
  return {csv_number(row.time.value),
          row.source,
          csv_number(plain(row.watts)),
          csv_number(plain(row.joules)),
          yes_or_no(row.changed),
          yes_or_no(row.restarted),
          std::string(to_string(row.origin))};
}

CsvRecord to_record(const EventRow& row) {
  return {csv_number(row.time.value), row.source, row.message};
}

CsvRecord to_record(const PhaseRow& row) {
  CsvRecord record = configuration_of(row.configuration);
  const auto energy = [](auto quantity) { return csv_number(plain(quantity), kUnavailable); };
  const CsvRecord rest{row.source,
                       row.phase,
                       row.method,
                       csv_number(plain(row.seconds)),
                       csv_number(row.operations),
                       energy(row.watts),
                       energy(row.watts_ci95),
                       energy(row.joules),
                       energy(row.joules_ci95),
                       energy(row.net_joules),
                       energy(row.net_joules_ci95),
                       std::string(to_string(row.origin)),
                       row.note};
  record.insert(record.end(), rest.begin(), rest.end());
  return record;
}

CsvRecord to_record(const WindowRow& row) {
  CsvRecord record = configuration_of(row.configuration);
  record.push_back(row.kind);
  record.push_back(csv_number(row.from.value));
  record.push_back(csv_number(row.to.value));
  return record;
}

CsvRecord to_record(const ConvergenceRow& row) {
  CsvRecord record = configuration_of(row.configuration);
  const CsvRecord rest{csv_number(row.elapsed.value),
                       row.quantity,
                       csv_number(row.mean),
                       csv_number(row.ci95),
                       csv_number(row.relative_ci95),
                       csv_number(row.effective_samples),
                       csv_number(row.allan_deviation),
                       csv_number(plain(row.allan_window)),
                       csv_number(row.drift_per_s)};
  record.insert(record.end(), rest.begin(), rest.end());
  return record;
}

SampleRow sample_from_record(const CsvRecord& header, const CsvRecord& record) {
  RecordReader fields(header, record);
  SampleRow row;
  row.time = Seconds(fields.required());
  row.source = fields.text();
  row.watts = fields.quantity<Watts>();
  row.joules = fields.quantity<Joules>();
  row.changed = fields.required() != 0.0;
  row.restarted = fields.required() != 0.0;
  row.origin = fields.origin();
  return row;
}

EventRow event_from_record(const CsvRecord& header, const CsvRecord& record) {
  RecordReader fields(header, record);
  EventRow row;
  row.time = Seconds(fields.required());
  row.source = fields.text();
  row.message = fields.text();
  return row;
}

PhaseRow phase_from_record(const CsvRecord& header, const CsvRecord& record) {
  RecordReader fields(header, record);
  PhaseRow row;
  row.configuration = fields.configuration("source");
  row.source = fields.text();
  row.phase = fields.text();
  row.method = fields.text();
  row.seconds = fields.quantity<Seconds>();
  row.operations = fields.number();
  row.watts = fields.quantity<Watts>();
  row.watts_ci95 = fields.quantity<Watts>();
  row.joules = fields.quantity<Joules>();
  row.joules_ci95 = fields.quantity<Joules>();
  row.net_joules = fields.quantity<Joules>();
  row.net_joules_ci95 = fields.quantity<Joules>();
  row.origin = fields.origin();
  row.note = fields.text();
  return row;
}

WindowRow window_from_record(const CsvRecord& header, const CsvRecord& record) {
  RecordReader fields(header, record);
  WindowRow row;
  row.configuration = fields.configuration("kind");
  row.kind = fields.text();
  row.from = Seconds(fields.required());
  row.to = Seconds(fields.required());
  return row;
}

ConvergenceRow convergence_from_record(const CsvRecord& header, const CsvRecord& record) {
  RecordReader fields(header, record);
  ConvergenceRow row;
  row.configuration = fields.configuration("elapsed_s");
  row.elapsed = Seconds(fields.required());
  row.quantity = fields.text();
  row.mean = fields.required();
  row.ci95 = fields.number();
  row.relative_ci95 = fields.number();
  row.effective_samples = fields.number();
  row.allan_deviation = fields.number();
  row.allan_window = fields.quantity<Seconds>();
  row.drift_per_s = fields.number();
  return row;
}

}  // namespace encore::energy
