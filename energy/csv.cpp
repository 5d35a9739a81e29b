#include "energy/csv.h"

#include "energy/session.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
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

CsvWriter::CsvWriter(const std::filesystem::path& path, const CsvRecord& header, Open open)
    : path_(path), columns_(header.size()) {
  const int how = open == Open::append ? O_RDWR | O_CREAT | O_APPEND : O_WRONLY | O_CREAT | O_TRUNC;
  file_ = ::open(path.c_str(), how | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw SessionError("cannot create " + path.string() + ": " + std::strerror(errno));
  }
  try {
    if (open == Open::create || !go_on(header)) write(header);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

bool CsvWriter::go_on(const CsvRecord& header) {
  std::ifstream in(path_, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  const std::string text = content.str();
  const std::vector<CsvRecord> records = parse_csv(text);
  // The end of the last whole record: a line break outside quotes.
  std::size_t whole = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '\n' && !quoted) whole = i + 1;
  }
  if (whole < text.size() && ::ftruncate(file_, static_cast<off_t>(whole)) != 0) {
    throw SessionError("cannot write " + path_.string() + ": " + std::strerror(errno));
  }
  if (records.empty()) return false;
  if (records.front() != header) {
    throw SessionError(path_.string() +
                       " was written by another version of this program (its columns differ); "
                       "start a new folder");
  }
  return true;
}

CsvWriter::~CsvWriter() {
  ::close(file_);
}

void CsvWriter::write(const CsvRecord& record) {
  if (record.size() != columns_)
    throw std::logic_error("a CSV record of the wrong length for " + path_.string());
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
      const std::string reason = std::strerror(errno);
      const bool full = errno == ENOSPC || errno == EDQUOT;
      throw SessionError("cannot write " + path_.string() + ": " + reason +
                         (full ? "; what was measured so far is kept there. Free some space, or "
                                 "name another folder with --out"
                               : ""));
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace encore::energy
