#include "scene/ply_reader_header.h"

#include "scene/diagnostics.h"
#include "scene/model_input.h"
#include "scene/model_number.h"
#include "scene/ply_reader.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace encore::scene {

namespace {

std::optional<PlyType> type_named(std::string_view name) {
  if (name == "char" || name == "int8") return PlyType::int8;
  if (name == "uchar" || name == "uint8") return PlyType::uint8;
  if (name == "short" || name == "int16") return PlyType::int16;
  if (name == "ushort" || name == "uint16") return PlyType::uint16;
  if (name == "int" || name == "int32") return PlyType::int32;
  if (name == "uint" || name == "uint32") return PlyType::uint32;
  if (name == "float" || name == "float32") return PlyType::float32;
  if (name == "double" || name == "float64") return PlyType::float64;
  return std::nullopt;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view file, const std::string& name) : file_(file), name_(name) {
    const std::size_t end = file.find_first_of("\r\n");
    if (end != std::string_view::npos && file[end] == '\r') {
      line_end_ = file.substr(end).starts_with("\r\n") ? "\r\n" : "\r";
    }
  }

  PlyHeader run() {
    next_line();
    bool has_format = false;
    while (true) {
      if (!next_line()) {
        fail("the header has no end_header line; the file is damaged or no PLY");
      }
      std::string_view rest = text_;
      const std::string_view keyword = take_token(rest);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        parse_format(rest);
        has_format = true;
      } else if (keyword == "element") {
        parse_element(rest);
      } else if (keyword == "property") {
        parse_property(rest);
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        unknown_line(keyword);
      }
    }
    if (!has_format) fail("the header has no format line; add \"format ascii 1.0\"");
    header_.data_begin = at_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(line_) + ": " + what);
  }

  void unknown_line(std::string_view keyword) {
    double number = 0.0;
    if (parse_number(keyword, number)) {
      fail("the data begins without an end_header line before it; the header is damaged");
    }
    if (!header_.warnings.messages.empty()) return;
    header_.warnings.add(name_ + ":" + std::to_string(line_) + ": \"" + printable(keyword) +
                         "\" in the header means nothing; such lines are skipped");
  }

  bool next_line() {
    if (at_ >= file_.size()) return false;
    std::size_t end = file_.find(line_end_, at_);
    const bool last = end == std::string_view::npos;
    end = std::min(end, file_.size());
    text_ = file_.substr(at_, end - at_);
    at_ = last ? end : end + line_end_.size();
    ++line_;
    return true;
  }

  void parse_format(std::string_view rest) {
    const std::string_view format = take_token(rest);
    if (format == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::little_endian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::big_endian;
    } else {
      fail("format \"" + printable(format) + "\" is none of ascii, binary_little_endian and " +
           "binary_big_endian");
    }
    const std::string_view version = take_token(rest);
    if (version != "1.0") {
      fail("format version \"" + printable(version) + "\" is unknown; 1.0 is read");
    }
  }

  void parse_element(std::string_view rest) {
    PlyElement element;
    element.name = take_token(rest);
    const std::string_view count = take_token(rest);
    const char* end = count.data() + count.size();
    const auto [stop, error] = std::from_chars(count.data(), end, element.count);
    if (count.empty() || error != std::errc() || stop != end) {
      fail("element " + printable(element.name) + " has the count \"" + printable(count) +
           "\", which is no whole number from 0 on");
    }
    header_.elements.push_back(std::move(element));
  }

  PlyType parse_type(std::string_view& rest) {
    const std::string_view name = take_token(rest);
    const auto type = type_named(name);
    if (!type) fail("\"" + printable(name) + "\" is no type of a property");
    return *type;
  }

  void parse_property(std::string_view rest) {
    if (header_.elements.empty()) fail("a property comes before the first element");
    PlyProperty property;
    std::string_view ahead = rest;
    if (take_token(ahead) == "list") {
      property.is_list = true;
      rest = ahead;
      property.count_type = parse_type(rest);
      if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64) {
        fail("the length of a list must be of a whole-number type");
      }
    }
    property.type = parse_type(rest);
    property.name = take_token(rest);
    if (property.name.empty()) fail("a property has no name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  std::string_view file_;
  const std::string& name_;
  std::string_view line_end_ = "\n";
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
  PlyHeader header_;
};

}  // namespace

std::size_t ply_size(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

bool is_ply(std::string_view file) {
  if (!file.starts_with("ply")) return false;
  const std::size_t end = file.find_first_not_of(" \t", 3);
  return end == std::string_view::npos || file[end] == '\r' || file[end] == '\n';
}

PlyHeader parse_ply_header(std::string_view file, const std::string& name) {
  if (!is_ply(file)) {
    throw InputError(name + ":1: does not start with the line \"ply\"; is it a PLY file?");
  }
  return HeaderParser(file, name).run();
}

}  // namespace encore::scene
