#include "energy/sources/csv_replay.h"

#include "energy/csv.h"
#include "energy/sources/csv_columns.h"
#include "energy/sources/discovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace encore::energy {

namespace {

/// One line of the file; no value: a gap.
struct Row {
  Seconds time;
  std::optional<double> value;  ///< watts or joules
};

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& what) {
  throw SensorError(fmt::format("{}:{}: {}", file, line, what));
}

/// No meter shows more of anything, in SI units; keeps all sums and products of rows finite.
constexpr double kLargestNumber = 1e30;

class RowReader {
 public:
  RowReader(std::string file, std::size_t line, const std::vector<std::string>& header,
            char separator)
      : file_(std::move(file)), columns_(parsed(line, header)), separator_(separator) {}

  [[nodiscard]] bool counts_energy() const { return columns_.counts_energy(); }

  [[nodiscard]] Row read(const std::string& text, std::size_t line) const {
    const std::vector<std::string> fields = split_fields(text, separator_);
    if (fields.size() != columns_.count()) {
      refuse(file_, line,
             fmt::format("{} fields where the header has {}", fields.size(), columns_.count()));
    }
    const auto time = number(fields, RecordedQuantity::time, line);
    if (!time) refuse(file_, line, "no time in this row");
    Row row{Seconds(*time), std::nullopt};
    if (counts_energy()) {
      row.value = number(fields, RecordedQuantity::energy, line);
    } else if (columns_.of(RecordedQuantity::power)) {
      row.value = number(fields, RecordedQuantity::power, line);
    } else {
      const auto volts = number(fields, RecordedQuantity::volts, line);
      const auto amps = number(fields, RecordedQuantity::amps, line);
      if (volts && amps) row.value = *volts * *amps;
    }
    if (row.value && *row.value < 0 && !counts_energy()) {
      refuse(file_, line,
             fmt::format("{} W; power must count as positive when it flows into the machine",
                         *row.value));
    }
    return row;
  }

 private:
  [[nodiscard]] RecordingColumns parsed(std::size_t line,
                                        const std::vector<std::string>& header) const {
    try {
      return RecordingColumns(header);
    } catch (const std::invalid_argument& error) {
      refuse(file_, line, error.what());
    }
  }

  /// In SI units; nothing if the field is empty or "nan".
  [[nodiscard]] std::optional<double> number(const std::vector<std::string>& fields,
                                             RecordedQuantity quantity, std::size_t line) const {
    const RecordingColumns::Place& place = *columns_.of(quantity);
    std::string text = fields[place.index];
    if (text.empty()) return std::nullopt;
    if (separator_ != ',') std::replace(text.begin(), text.end(), ',', '.');
    if (text.front() == '+') text.erase(0, 1);
    const auto value = parse_csv_number(text);
    if (!value) {
      refuse(file_, line,
             fmt::format("'{}' is no number{}", fields[place.index],
                         quantity == RecordedQuantity::time
                             ? "; times are to be seconds since any moment"
                             : ""));
    }
    if (!std::isfinite(*value)) return std::nullopt;
    const double si = *value * place.column.factor;
    if (!(std::fabs(si) <= kLargestNumber)) {
      refuse(file_, line, fmt::format("'{}' is too large", fields[place.index]));
    }
    return si;
  }

  std::string file_;
  RecordingColumns columns_;
  char separator_;
};

struct Rows {
  std::vector<Row> rows;
  bool counts_energy = false;
};

Rows read_rows(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  if (!file) throw SensorError(name + ": cannot be read; is it there?");
  std::optional<RowReader> reader;
  Rows result;
  std::string text;
  for (std::size_t line = 1; std::getline(file, text); ++line) {
    const bool complete = !file.eof();
    if (line == 1 && text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos || text[first] == '#') continue;
    if (!reader) {
      const char separator = separator_of(text);
      reader.emplace(name, line, split_fields(text, separator), separator);
      result.counts_energy = reader->counts_energy();
      continue;
    }
    try {
      const Row row = reader->read(text, line);
      if (!result.rows.empty() && row.time < result.rows.back().time) {
        refuse(name, line,
               fmt::format("time goes back from {} s to {} s", result.rows.back().time.value,
                           row.time.value));
      }
      if (!result.rows.empty() && row.time == result.rows.back().time) result.rows.pop_back();
      result.rows.push_back(row);
    } catch (const SensorError&) {
      // A last line without its end is what the end of the recorder left.
      if (complete) throw;
    }
  }
  if (!reader) throw SensorError(name + ": empty; a header and rows were expected");
  return result;
}

/// Median time between rows.
Seconds spacing_of(const std::vector<Row>& rows) {
  std::vector<Seconds> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) steps.push_back(rows[i].time - rows[i - 1].time);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::vector<TracePoint> points_of(const Rows& rows, Seconds spacing) {
  const Seconds longest_step = std::max(Seconds(1.0), spacing * 10);
  std::vector<TracePoint> points;
  Joules sum;
  const Row* last = nullptr;
  for (const Row& row : rows.rows) {
    if (!row.value) {
      last = nullptr;
      continue;
    }
    // A counter that falls was reset.
    const bool joined = last != nullptr && row.time - last->time <= longest_step &&
                        !(rows.counts_energy && *row.value < *last->value);
    if (joined && rows.counts_energy) sum += Joules(*row.value - *last->value);
    if (joined && !rows.counts_energy) {
      sum += Watts((*row.value + *last->value) / 2) * (row.time - last->time);
    }
    TracePoint point;
    point.time = row.time;
    point.energy = sum;
    if (!rows.counts_energy) point.power = Watts(*row.value);
    point.changed = !joined || *row.value != *last->value;
    point.starts_stretch = !joined;
    points.push_back(point);
    last = &row;
  }
  return points;
}

class ReplaySource final : public PowerSource {
 public:
  ReplaySource(Recording recording, std::optional<Seconds> offset)
      : info_(replay_info(recording)), recording_(std::move(recording)), offset_(offset) {}

  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  ReadResult read(Seconds now) override {
    const std::vector<TracePoint>& points = recording_.trace.points();
    if (!offset_) offset_ = now - points.front().time;
    const Seconds time = now - *offset_;
    if (time > points.back().time) return failure(ReadState::lost, "the recording has ended");
    if (time < points.front().time) return failure(ReadState::failed, "it has not begun yet");

    // The row that the meter showed at that time, and whether anything follows without a gap.
    std::size_t row = recording_.trace.first_at_or_after(time);
    if (points[row].time > time) {
      if (points[row].starts_stretch) return failure(ReadState::failed, "a gap in the recording");
      --row;
    }
    ReadResult result;
    result.state = ReadState::ok;
    Joules energy = points[row].energy;
    if (!recording_.is_counter) energy += *recording_.trace.energy_between(points[row].time, time);
    if (!base_) base_ = energy;
    const bool gap = last_row_ && crosses_gap(*last_row_, row);
    if (failed_ || gap) {
      result.state = ReadState::restarted;
      result.message = info_.place + ": the recording goes on after a gap";
    }
    result.reading = {.time = now,
                      .energy = energy - *base_,
                      .power = points[row].power,
                      .changed = !last_row_ || changes(*last_row_, row)};
    last_row_ = row;
    failed_ = false;
    return result;
  }

 private:
  ReadResult failure(ReadState state, const std::string& what) {
    failed_ = last_row_.has_value();
    ReadResult result;
    result.state = state;
    result.message = fmt::format("{}: {}", info_.place, what);
    return result;
  }
  [[nodiscard]] bool crosses_gap(std::size_t from, std::size_t to) const {
    for (std::size_t i = from + 1; i <= to; ++i) {
      if (recording_.trace.points()[i].starts_stretch) return true;
    }
    return false;
  }
  [[nodiscard]] bool changes(std::size_t from, std::size_t to) const {
    for (std::size_t i = from + 1; i <= to; ++i) {
      if (recording_.trace.points()[i].changed) return true;
    }
    return false;
  }

  SourceInfo info_;
  Recording recording_;
  std::optional<Seconds> offset_;
  std::optional<Joules> base_;
  std::optional<std::size_t> last_row_;
  bool failed_ = false;
};

}  // namespace

Recording load_recording(const std::filesystem::path& file) {
  Recording recording;
  recording.file = file.string();
  const Rows rows = read_rows(recording.file);
  const auto values = std::count_if(rows.rows.begin(), rows.rows.end(),
                                    [](const Row& row) { return row.value.has_value(); });
  if (values < 2) {
    throw SensorError(
        fmt::format("{}: {} rows with a value; at least 2 are needed", recording.file, values));
  }
  recording.is_counter = rows.counts_energy;
  recording.spacing = spacing_of(rows.rows);
  recording.trace = TraceView(points_of(rows, recording.spacing));
  return recording;
}

SourceInfo replay_info(const Recording& recording) {
  const std::string name = std::filesystem::path(recording.file).filename().string();
  SourceInfo info;
  info.name = "replay:" + name;
  info.kind = SourceKind::replay;
  info.domain = Domain::system;
  info.unit = recording.file;
  info.includes = "what the meter of this recording saw";
  info.place = recording.file;
  info.provenance = {Origin::measured, "recording " + name};
  info.is_counter = recording.is_counter;
  info.update_period = recording.spacing;
  info.poll_period = recording.spacing / 2;
  info.gain_uncertainty = 0.02;
  return info;
}

TraceView aligned_trace(const Recording& recording, Seconds offset) {
  std::vector<TracePoint> points = recording.trace.points();
  for (TracePoint& point : points) point.time += offset;
  return TraceView(std::move(points));
}

std::unique_ptr<PowerSource> open_replay(Recording recording, std::optional<Seconds> offset) {
  return std::make_unique<ReplaySource>(std::move(recording), offset);
}

}  // namespace encore::energy
