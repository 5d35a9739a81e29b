#pragma once

#include "scene/diagnostics.h"

#include <glm/vec3.hpp>
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// What a number in a file may be. NaN and infinities never are.
struct NumberRange {
  double min = -1e37;
  double max = 1e37;
  bool open = false;  ///< the ends themselves are not allowed

  [[nodiscard]] bool holds(double x) const;
  /// "between 0 and 1", "greater than 0" …
  [[nodiscard]] std::string text() const;
};

inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kShare{0.0, 1.0};
inline constexpr NumberRange kNotNegative{0.0, 1e37};
inline constexpr NumberRange kPositive{0.0, 1e37, true};

/// One table of a TOML file, read key by key. Every mismatch is an InputError
/// "file:line:column: ..."; keys that nobody asked for become warnings with the nearest known name.
/// Borrows the table, the file name and the keys it is asked for (string literals).
class TomlTable {
 public:
  /// `path` is the table's dotted name, empty for the whole file.
  TomlTable(const toml::table& table, std::string path, const std::string& file);

  [[nodiscard]] bool has(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  std::optional<float> number(std::string_view key, const NumberRange& range = kAnyNumber);
  /// Exactly three numbers.
  std::optional<glm::vec3> vector(std::string_view key, const NumberRange& range = kAnyNumber);
  /// Three numbers, or one that stands for all three.
  std::optional<glm::vec3> number_or_vector(std::string_view key,
                                            const NumberRange& range = kAnyNumber);
  /// An array of elements, each three numbers or one that stands for all three.
  std::optional<std::vector<glm::vec3>> numbers_or_vectors(std::string_view key,
                                                           const NumberRange& range = kAnyNumber);
  /// An array of strings.
  std::optional<std::vector<std::string>> texts(std::string_view key);
  std::optional<TomlTable> table(std::string_view key);
  /// The tables of an array of tables; none if the key is absent.
  std::vector<TomlTable> tables(std::string_view key);
  [[nodiscard]] bool is_text(std::string_view key);

  /// "file:line:column" of the table, or of a key's value.
  [[nodiscard]] std::string place() const { return place_of(table_); }
  [[nodiscard]] std::string place(std::string_view key) const;
  /// Throws InputError at a key's value, or at the table if the key is absent.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// To be called when everything was asked for.
  void warn_about_unknown_keys(Warnings& warnings) const;

  [[nodiscard]] const toml::table& raw() const { return table_; }
  /// As in messages: "[camera]".
  [[nodiscard]] std::string title() const;
  [[nodiscard]] std::string place_of(const toml::node& node) const;

 private:
  const toml::node* find(std::string_view key);
  [[nodiscard]] std::string inner_path(std::string_view key) const;
  float checked(const toml::node& node, std::string_view key, const NumberRange& range) const;
  glm::vec3 checked_vector(const toml::node& node, std::string_view key,
                           const NumberRange& range) const;
  [[noreturn]] void wrong_type(const toml::node& node, std::string_view key,
                               std::string_view wanted) const;

  const toml::table& table_;
  std::string path_;
  const std::string& file_;
  std::vector<std::string_view> known_;
};

/// Parses TOML. Syntax errors, too many dots in a key and texts that are not UTF-8 are InputErrors
/// "file:line:column: ...".
toml::table parse_toml(std::string_view text, const std::string& file);

/// "file:line:column".
std::string toml_place(const std::string& file, const toml::source_position& position);

/// What a node is, in words: "a string", "an array" …
std::string_view kind_of(const toml::node& node);

}  // namespace encore::scene
