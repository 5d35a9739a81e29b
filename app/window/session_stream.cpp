#include "app/window/session_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

namespace encore::app {

namespace {

constexpr std::size_t kStretch = 1U << 20U;

/// Where the last whole record of a text ends: a line break outside quotes.
std::size_t whole_records(std::string_view text) {
  std::size_t whole = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '\n' && !quoted) whole = i + 1;
  }
  return whole;
}

/// A column that is not as this program knows them; empty if all are.
std::string strange_column(const energy::CsvRecord& header, const energy::CsvRecord& columns) {
  for (const std::string& name : header) {
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) return name;
  }
  return header == columns ? std::string() : std::string("?");
}

}  // namespace

void SessionStream::check_stop() const {
  if (control_.stop) throw energy::SessionError("reading was cancelled");
}

void SessionStream::read(const std::filesystem::path& file, const OnRecord& on_record) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw energy::SessionError("cannot read " + file.string());
  energy::CsvRecord header;
  std::string text;
  std::string stretch(kStretch, '\0');
  std::uint64_t row = 0;
  while (in) {
    check_stop();
    in.read(stretch.data(), static_cast<std::streamsize>(stretch.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    text.append(stretch, 0, got);
    const std::size_t whole = whole_records(text);
    for (const energy::CsvRecord& record :
         energy::parse_csv(std::string_view(text).substr(0, whole))) {
      if (header.empty()) {
        header = record;
        continue;
      }
      ++row;
      try {
        on_record(header, record);
      } catch (const energy::SessionError& error) {
        throw energy::SessionError(fmt::format("{}, row {}: {}", file.string(), row, error.what()));
      }
    }
    text.erase(0, whole);
    done_ += got;
    if (bytes_ > 0) {
      control_.progress = std::min(1.0, static_cast<double>(done_) / static_cast<double>(bytes_));
    }
  }
  if (in.bad()) throw energy::SessionError("cannot read " + file.string());
  const std::string name = file.filename().string();
  if (header.empty()) remarks_.push_back(name + " has no header: nothing was written to it");
  if (!header.empty() && !text.empty()) {
    remarks_.push_back(name + ": the last row was cut off and is left out");
  }
}

void SessionStream::read(const std::filesystem::path& file, const energy::CsvRecord& columns,
                         const OnRecord& on_record) {
  bool checked = false;
  read(file, [&](const energy::CsvRecord& header, const energy::CsvRecord& record) {
    if (!checked) {
      const std::string strange = strange_column(header, columns);
      if (!strange.empty()) {
        throw energy::SessionError(fmt::format(
            "the column '{}' is not one that this version of the program knows; a newer version "
            "wrote it, and opens it",
            strange));
      }
      checked = true;
    }
    on_record(header, record);
  });
}

}  // namespace encore::app
