#include "scene/obj_reader_lines.h"

#include "scene/load_watch.h"
#include "scene/model_number.h"

#include <algorithm>

namespace encore::scene {

namespace {

// Cuts the first line off `rest`, without its end.
std::string_view take_line(std::string_view& rest) {
  // Each sort of end by itself is found much faster than either.
  std::size_t end = rest.find('\n');
  end = std::min(end, rest.substr(0, end).find('\r'));
  if (end == std::string_view::npos) {
    const std::string_view line = rest;
    rest = {};
    return line;
  }
  const std::string_view line = rest.substr(0, end);
  const bool two = rest.substr(end).starts_with("\r\n");
  rest.remove_prefix(end + (two ? 2 : 1));
  return line;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Reads up to nine digits; none or more are not plain.
bool take_digits(const char*& at, const char* end, int& number) {
  const char* const first = at;
  int value = 0;
  for (; at != end && is_digit(*at); ++at) {
    if (at - first == 9) return false;
    value = value * 10 + (*at - '0');
  }
  number = value;
  return at != first;
}

}  // namespace

bool ObjLineFeed::next_statement() {
  if (rest_.empty()) return false;
  line_ = next_line_++;
  if (line_ % 4096 == 1) {
    report_load(1.0 - static_cast<double>(rest_.size()) / static_cast<double>(size_));
  }
  std::string_view statement = take_line(rest_);
  if (statement.ends_with('\\')) {
    joined_.clear();
    while (statement.ends_with('\\')) {
      statement.remove_suffix(1);
      joined_.append(statement).append(" ");
      statement = {};
      if (rest_.empty()) break;
      statement = take_line(rest_);
      ++next_line_;
    }
    joined_.append(statement);
    statement = joined_;
  }
  arguments_ = trimmed(statement);
  return true;
}

bool ObjLineFeed::read_plain_face() {
  plain_face_.clear();
  const char* at = arguments_.data();
  const char* const end = at + arguments_.size();
  while (at != end) {
    ObjCorner corner;
    if (!take_digits(at, end, corner.position)) return false;
    if (at != end && *at == '/') {
      const bool has_texcoord = ++at != end && *at != '/';
      if (has_texcoord && !take_digits(at, end, corner.texcoord)) return false;
      if (at != end && *at == '/' && !take_digits(++at, end, corner.normal)) return false;
    }
    plain_face_.push_back(corner);
    if (at != end && *at != ' ' && *at != '\t') return false;
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
  }
  return !plain_face_.empty();
}

void ObjLineFeed::write_statement(std::string_view keyword) {
  out_.assign(keyword);
  out_ += ' ';
  if (keyword == "f") {
    // Ten digits are more vertices than any file can hold.
    std::size_t run = 0;
    for (char c : arguments_.substr(0, arguments_.find('#'))) {
      run = is_digit(c) ? run + 1 : 0;
      if (run == 10) {
        out_.resize(out_.size() - 9);
        out_ += '0';
      }
      // A zero byte would end the line for the library.
      if (c == '\0') c = ' ';
      if (run < 10) out_ += c;
    }
  } else {
    out_ += arguments_;
  }
  out_ += '\n';
}

ObjLineFeed::int_type ObjLineFeed::underflow() {
  while (next_statement()) {
    if (arguments_.empty() || arguments_.front() == '#') continue;
    std::string_view arguments = arguments_;
    const std::string_view keyword = take_token(arguments);
    if (keyword.empty()) continue;  // zero bytes only
    arguments_ = trimmed(arguments);
    if (keyword == "v" || keyword == "vn" || keyword == "vt") {
      on_numbers(keyword);
      continue;
    }
    if (keyword == "f" && read_plain_face()) {
      on_plain_face(plain_face_);
      continue;
    }
    if (keyword != "f" && keyword != "usemtl") {
      on_other(keyword, arguments_);
      continue;
    }
    write_statement(keyword);
    setg(out_.data(), out_.data(), out_.data() + out_.size());
    return traits_type::to_int_type(out_.front());
  }
  return traits_type::eof();
}

}  // namespace encore::scene
