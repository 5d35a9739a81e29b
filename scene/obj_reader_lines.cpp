#include "scene/obj_reader_lines.h"

#include "scene/load_watch.h"
#include "scene/model_number.h"

namespace encore::scene {

namespace {

// Cuts the first line off `rest`, without its end.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find_first_of("\r\n");
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
  } else if (keyword == "usemtl") {
    out_ += arguments_;
  } else {
    out_ += '0';
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
    const bool numbers = keyword == "v" || keyword == "vn" || keyword == "vt";
    if (!numbers && keyword != "f" && keyword != "usemtl") {
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
