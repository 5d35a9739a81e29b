#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// One record of a CSV file.
using CsvRecord = std::vector<std::string>;

/// A field as RFC 4180 writes it: in double quotes if it holds a comma, quote, line break or
/// leading or trailing blank, quotes inside doubled.
std::string csv_field(std::string_view text);

/// A number in the shortest form that reads back as the same double, always with a decimal point,
/// whatever the locale; whole numbers without exponent below 1e15. Not finite: empty, as missing.
std::string csv_number(double value);
/// The same; nothing gives `missing`.
std::string csv_number(std::optional<double> value, std::string_view missing = {});

/// The number a field holds; nothing if it is not wholly one.
std::optional<double> parse_csv_number(std::string_view field);

/// Splits a text into records (LF or CRLF). A last record without its line break is what a crash
/// left of it, and is dropped.
std::vector<CsvRecord> parse_csv(std::string_view text);

/// Writes records to a new file, each with one system call, so that what was written survives the
/// end of the program in whatever way. Lines end with LF.
class CsvWriter {
 public:
  enum class Open {
    create,  ///< a new file, or an empty one in the place of an old one
    append,  ///< goes on with the file if there is one: a last line that was cut off is removed
  };
  /// Opens the file and writes the header if it is new. Throws SessionError, also if an existing
  /// file that is gone on with has another header.
  CsvWriter(const std::filesystem::path& path, const CsvRecord& header, Open open = Open::create);
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  /// Throws SessionError if the file cannot take it (disk full), std::logic_error if the number of
  /// fields is not the header's.
  void write(const CsvRecord& record);

 private:
  /// Whether the file already holds this header; cuts off what a crash left of a last line.
  bool go_on(const CsvRecord& header);

  std::filesystem::path path_;
  std::size_t columns_;
  int file_ = -1;
  std::string line_;
};

}  // namespace encore::energy
