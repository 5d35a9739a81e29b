#include "energy/session_columns.h"

namespace encore::energy {

namespace {

/// Both files: the configuration's columns come before this one …
constexpr std::string_view kAfterConfiguration = "operations";
/// … and the summary's counters after this one.
constexpr std::string_view kBeforeCounters = "energy_provenance";

std::optional<double> in_milliseconds(std::optional<Seconds> time) {
  if (!time) return std::nullopt;
  return milliseconds(*time);
}

template <class Unit>
std::optional<double> plain(std::optional<Quantity<Unit>> quantity) {
  if (!quantity) return std::nullopt;
  return quantity->value;
}

void append(CsvRecord& record, const std::vector<std::string>& fields) {
  record.insert(record.end(), fields.begin(), fields.end());
}

void append_phases(CsvRecord& header, std::string_view suffix) {
  for (const Phase phase : kPhases) header.push_back(std::string(to_string(phase)).append(suffix));
}

/// Takes the fields of a record one after the other, by the order of the header.
class FieldReader {
 public:
  FieldReader(const CsvRecord& header, const CsvRecord& record) : header_(header), record_(record) {
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

  /// A number, or nothing for an empty or unavailable one.
  std::optional<double> number() {
    const std::string& column = name();
    const std::string& field = text();
    if (field.empty() || field == kUnavailable) return std::nullopt;
    const auto value = parse_csv_number(field);
    if (!value) throw SessionError("column " + column + " holds '" + field + "', not a number");
    return value;
  }
  double required() {
    const std::string& column = name();
    const auto value = number();
    if (!value) throw SessionError("column " + column + " is empty");
    return *value;
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
  std::vector<KeyValue> configuration() {
    std::vector<KeyValue> values;
    while (name() != kAfterConfiguration) {
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

}  // namespace

CsvRecord sample_header() {
  return {"time_s", "source", "watts", "joules", "provenance"};
}

CsvRecord frame_header(const SessionColumns& columns) {
  CsvRecord header{"time_s"};
  append(header, columns.configuration);
  header.emplace_back(kAfterConfiguration);
  append_phases(header, "_ms");
  append_phases(header, "_joules");
  header.emplace_back(kBeforeCounters);
  return header;
}

CsvRecord summary_header(const SessionColumns& columns) {
  CsvRecord header = columns.configuration;
  append(header, {std::string(kAfterConfiguration), "builds", "updates", "frames", "measured_s",
                  "ms_per_operation", "ms_per_operation_ci95", "effective_rows", "row_median_ms",
                  "row_p95_ms"});
  append_phases(header, "_share");
  append(header, {"watts", "joules_per_operation", std::string(kBeforeCounters)});
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
    record.push_back(csv_number(plain(row.joules[phase]), kUnavailable));
  }
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
  append(record, {csv_number(plain(row.watts), kUnavailable),
                  csv_number(plain(row.joules), kUnavailable), std::string(to_string(row.origin))});
  for (const Counter& counter : row.counters) record.push_back(csv_number(counter.value));
  return record;
}

FrameRow frame_from_record(const CsvRecord& header, const CsvRecord& record) {
  FieldReader fields(header, record);
  FrameRow row;
  row.time = Seconds(fields.required());
  row.configuration = fields.configuration();
  row.operations = static_cast<std::uint64_t>(fields.required());
  for (const Phase phase : kPhases) row.phases[phase] = fields.quantity<Seconds>(1e3);
  for (const Phase phase : kPhases) row.joules[phase] = fields.quantity<Joules>();
  row.origin = fields.origin();
  return row;
}

SummaryRow summary_from_record(const CsvRecord& header, const CsvRecord& record) {
  FieldReader fields(header, record);
  SummaryRow row;
  row.configuration = fields.configuration();
  row.operations = static_cast<std::uint64_t>(fields.required());
  for (const Phase phase : {Phase::build, Phase::update, Phase::render}) {
    row.phase_counts[phase] = static_cast<std::uint64_t>(fields.required());
  }
  row.seconds = Seconds(fields.required());
  row.mean = Seconds(fields.required() / 1e3);
  row.ci95 = fields.quantity<Seconds>(1e3);
  row.effective_rows = fields.number();
  row.median = fields.quantity<Seconds>(1e3);
  row.percentile95 = fields.quantity<Seconds>(1e3);
  for (const Phase phase : kPhases) row.shares[phase] = fields.number();
  row.watts = fields.quantity<Watts>();
  row.joules = fields.quantity<Joules>();
  row.origin = fields.origin();
  while (!fields.done()) {
    std::string name = fields.name();
    row.counters.push_back({std::move(name), fields.number()});
  }
  return row;
}

}  // namespace encore::energy
