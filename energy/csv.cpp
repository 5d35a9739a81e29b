#include "energy/csv.h"

#include "energy/session.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace encore::energy {

std::string csv_field(std::string_view text) {
  const bool blank_edge = !text.empty() && (text.front() == ' ' || text.front() == '\t' ||
                                            text.back() == ' ' || text.back() == '\t');
  if (!blank_edge && text.find_first_of(",\"\r\n") == std::string_view::npos) {
    return std::string(text);
  }
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted += '"';
}

std::string csv_number(double value) {
  if (!std::isfinite(value)) return {};
  std::array<char, 64> text;
  const bool whole = value == std::trunc(value) && std::fabs(value) < 1e15;
  const auto result =
      whole ? std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed)
            : std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

std::string csv_number(std::optional<double> value, std::string_view missing) {
  return value ? csv_number(*value) : std::string(missing);
}

std::optional<double> parse_csv_number(std::string_view field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size()) return std::nullopt;
  return value;
}

std::vector<CsvRecord> parse_csv(std::string_view text) {
  std::vector<CsvRecord> records;
  CsvRecord record;
  std::string field;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      // Two quotes in a row stand for one; a single one ends the quoted part.
      if (c != '"') {
        field += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        field += '"';
        ++i;
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      record.push_back(std::move(field));
      field.clear();
    } else if (c == '\n') {
      record.push_back(std::move(field));
      field.clear();
      records.push_back(std::move(record));
      record.clear();
    } else if (c != '\r') {
      field += c;
    }
  }
  return records;
}

CsvWriter::CsvWriter(const std::filesystem::path& path, const CsvRecord& header)
    : path_(path), columns_(header.size()) {
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw SessionError("cannot create " + path.string() + ": " + std::strerror(errno));
  }
  try {
    write(header);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

CsvWriter::~CsvWriter() {
  ::close(file_);
}

void CsvWriter::write(const CsvRecord& record) {
  if (record.size() != columns_) throw std::logic_error("a CSV record of the wrong length");
  line_.clear();
  for (const std::string& field : record) {
    if (&field != &record.front()) line_ += ',';
    line_ += csv_field(field);
  }
  line_ += '\n';

  // One call is the rule; a signal or a full pipe may make it several.
  for (std::string_view rest = line_; !rest.empty();) {
    const ssize_t written = ::write(file_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      throw SessionError("cannot write " + path_.string() + ": " + std::strerror(errno));
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace encore::energy
