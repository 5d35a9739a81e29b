#pragma once

#include <string_view>

namespace encore::app {

/// Whether a text is one JSON value by the grammar of RFC 8259, and nothing else.
class JsonChecker {
 public:
  explicit JsonChecker(std::string_view text) : rest_(text) {}

  bool valid() {
    const bool ok = value();
    blanks();
    return ok && rest_.empty();
  }

 private:
  void blanks() {
    while (!rest_.empty() && std::string_view(" \t\r\n").find(rest_[0]) != std::string_view::npos) {
      rest_.remove_prefix(1);
    }
  }
  bool take(std::string_view word) {
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  bool value() {
    blanks();
    if (rest_.empty()) return false;
    if (rest_[0] == '{') return list('{', '}', true);
    if (rest_[0] == '[') return list('[', ']', false);
    if (rest_[0] == '"') return string();
    return take("null") || take("true") || take("false") || number();
  }
  bool list(char open, char close, bool named) {
    take(std::string_view(&open, 1));
    blanks();
    if (take(std::string_view(&close, 1))) return true;
    do {
      blanks();
      if (named && !(string() && (blanks(), take(":")))) return false;
      if (!value()) return false;
      blanks();
    } while (take(","));
    return take(std::string_view(&close, 1));
  }
  bool string() {
    if (!take("\"")) return false;
    while (!rest_.empty() && rest_[0] != '"') {
      if (static_cast<unsigned char>(rest_[0]) < 0x20) return false;
      rest_.remove_prefix(rest_[0] == '\\' && rest_.size() > 1 ? 2 : 1);
    }
    return take("\"");
  }
  bool digits() {
    const std::size_t end = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    rest_.remove_prefix(end);
    return end > 0;
  }
  bool number() {
    take("-");
    if (!digits()) return false;
    if (take(".") && !digits()) return false;
    if (take("e") || take("E")) {
      if (!take("-")) take("+");
      return digits();
    }
    return true;
  }

  std::string_view rest_;
};

}  // namespace encore::app
