#include "scene/toml_reading.h"

#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::scene {
namespace {

/// Parts of one dotted key. The parser limits the nesting of values but not of dotted keys, and
/// tables are freed recursively: together the two limits bound the stack.
constexpr int kMaxParts = 16;

/// Skips a string that starts at `i`; returns the index behind it (or behind the line's end, where
/// the parser will complain).
std::size_t skip_string(std::string_view text, std::size_t i) {
  const char quote = text[i];
  const bool multi_line = text.substr(i, 3) == std::string(3, quote);
  i += multi_line ? 3 : 1;
  while (i < text.size()) {
    if (text[i] == '\\' && quote == '"') {
      i += 2;
    } else if (multi_line && text.substr(i, 3) == std::string(3, quote)) {
      i += 3;
      // Up to two quotes more may belong to the string's end.
      while (i < text.size() && text[i] == quote) ++i;
      return i;
    } else if (!multi_line && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else {
      ++i;
    }
  }
  return text.size();
}

/// Refuses keys like a.a.a.a… before the parser sees them.
void check_dots(std::string_view text, const std::string& file) {
  int dots = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = skip_string(text, i);
      continue;
    }
    if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
      continue;
    }
    if (c == '.') {
      ++dots;
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') {
      dots = 0;
    }
    if (dots >= kMaxParts) {
      const auto line =
          std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
      const std::size_t start = text.rfind('\n', i);
      const std::size_t column = start == std::string_view::npos ? i + 1 : i - start;
      throw InputError(
          fmt::format("{}:{}:{}: a key of more than {} parts", file, line + 1, column, kMaxParts));
    }
    ++i;
  }
}

}  // namespace

bool NumberRange::holds(double x) const {
  if (!std::isfinite(x)) return false;
  return open ? x > min && x < max : x >= min && x <= max;
}

std::string NumberRange::text() const {
  const bool bounded_below = min > -1e37;
  const bool bounded_above = max < 1e37;
  if (bounded_below && bounded_above) {
    return open ? fmt::format("greater than {} and less than {}", min, max)
                : fmt::format("between {} and {}", min, max);
  }
  if (bounded_below) return fmt::format("{} {}", open ? "greater than" : "at least", min);
  return "a finite number of at most 1e37";
}

std::string toml_place(const std::string& file, const toml::source_position& position) {
  return fmt::format("{}:{}:{}", file, position.line, position.column);
}

std::string_view kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

toml::table parse_toml(std::string_view text, const std::string& file) {
  check_dots(text, file);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}: {}", toml_place(file, error.source().begin), error.description()));
  }
}

TomlTable::TomlTable(const toml::table& table, std::string path, const std::string& file)
    : table_(table), path_(std::move(path)), file_(file) {}

std::string TomlTable::title() const {
  return path_.empty() ? "the scene" : fmt::format("[{}]", path_);
}

std::string TomlTable::inner_path(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const toml::node* TomlTable::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_.get(key);
}

bool TomlTable::has(std::string_view key) {
  return find(key) != nullptr;
}

bool TomlTable::is_text(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_string();
}

std::string TomlTable::place_of(const toml::node& node) const {
  // Tables that dotted keys imply have no place of their own; the parser then says line 0.
  const toml::source_position position = node.source().begin;
  return position.line == 0 ? file_ : toml_place(file_, position);
}

std::string TomlTable::place(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return place_of(node == nullptr ? static_cast<const toml::node&>(table_) : *node);
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  throw InputError(fmt::format("{}: {}", place(key), message));
}

void TomlTable::wrong_type(const toml::node& node, std::string_view key,
                           std::string_view wanted) const {
  throw InputError(
      fmt::format("{}: '{}' must be {}, not {}", place_of(node), key, wanted, kind_of(node)));
}

float TomlTable::checked(const toml::node& node, std::string_view key,
                         const NumberRange& range) const {
  const std::optional<double> value = node.value<double>();
  if (!node.is_number() || !value) wrong_type(node, key, "a number");
  if (!range.holds(*value)) {
    const NumberRange& broken = kAnyNumber.holds(*value) ? range : kAnyNumber;
    throw InputError(
        fmt::format("{}: '{}' must be {}, not {}", place_of(node), key, broken.text(), *value));
  }
  return static_cast<float>(*value);
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto* value = node->as_string();
  if (value == nullptr) wrong_type(*node, key, "a string");
  return value->get();
}

std::optional<float> TomlTable::number(std::string_view key, const NumberRange& range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return checked(*node, key, range);
}

glm::vec3 TomlTable::checked_vector(const toml::node& node, std::string_view key,
                                    const NumberRange& range) const {
  const toml::array* array = node.as_array();
  if (array == nullptr) wrong_type(node, key, "an array of 3 numbers");
  if (array->size() != 3) {
    throw InputError(fmt::format("{}: '{}' must be an array of 3 numbers, not of {}",
                                 place_of(node), key, array->size()));
  }
  glm::vec3 v(0.0F);
  for (int i = 0; i < 3; ++i) v[i] = checked((*array)[static_cast<std::size_t>(i)], key, range);
  return v;
}

std::optional<glm::vec3> TomlTable::vector(std::string_view key, const NumberRange& range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return checked_vector(*node, key, range);
}

std::optional<std::vector<glm::vec3>> TomlTable::numbers_or_vectors(std::string_view key,
                                                                    const NumberRange& range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* array = node->as_array();
  if (array == nullptr) wrong_type(*node, key, "an array of numbers or of arrays of 3 numbers");
  std::vector<glm::vec3> values;
  for (const toml::node& element : *array) {
    values.push_back(element.is_number() ? glm::vec3(checked(element, key, range))
                                         : checked_vector(element, key, range));
  }
  return values;
}

std::optional<glm::vec3> TomlTable::number_or_vector(std::string_view key,
                                                     const NumberRange& range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (node->is_array()) return vector(key, range);
  if (!node->is_number()) wrong_type(*node, key, "a number or an array of 3 numbers");
  return glm::vec3(checked(*node, key, range));
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* array = node->as_array();
  if (array == nullptr) wrong_type(*node, key, "an array of strings");
  std::vector<std::string> result;
  for (const toml::node& element : *array) {
    const auto* value = element.as_string();
    if (value == nullptr) wrong_type(element, key, "an array of strings");
    result.push_back(value->get());
  }
  return result;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::table* table = node->as_table();
  if (table == nullptr) wrong_type(*node, key, "a table");
  return TomlTable(*table, inner_path(key), file_);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = find(key);
  std::vector<TomlTable> result;
  if (node == nullptr) return result;
  const std::string wanted = fmt::format("an array of tables ([[{}]])", inner_path(key));
  const toml::array* array = node->as_array();
  if (array == nullptr) wrong_type(*node, key, wanted);
  for (const toml::node& element : *array) {
    const toml::table* table = element.as_table();
    if (table == nullptr) wrong_type(element, key, wanted);
    result.emplace_back(*table, inner_path(key), file_);
  }
  return result;
}

void TomlTable::warn_about_unknown_keys(Warnings& warnings) const {
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    const toml::source_position position = key.source().begin;
    warnings.add(fmt::format("{}: unknown key '{}' in {} is ignored{}",
                             position.line == 0 ? place_of(node) : toml_place(file_, position),
                             key.str(), title(), did_you_mean(key.str(), known_)));
  }
}

}  // namespace encore::scene
