#pragma once

#include <glm/vec3.hpp>
#include <toml++/toml.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::app {

// The two directions of a settings file. settings_fields.cpp names each field once, for both.

struct NumberLimits {
  double low;
  double high;
};

/// How a word of a file becomes a value and back.
template <class Enum>
struct Words {
  std::string_view (*to_text)(Enum);
  std::optional<Enum> (*parse)(std::string_view);
};

/// Writes fields into a table.
class SettingsWriter {
 public:
  explicit SettingsWriter(toml::table& table) : table_(table) {}

  void flag(const char* key, bool& value) { put(key, value); }
  void number(const char* key, float& value, NumberLimits limits);
  void integer(const char* key, int& value, NumberLimits limits);
  void seed(const char* key, std::uint64_t& value);
  void seed(const char* key, std::uint32_t& value);
  void text(const char* key, std::string& value) { put(key, value); }
  void texts(const char* key, std::vector<std::string>& values);
  void vector(const char* key, glm::vec3& value);
  template <class Enum>
  void word(const char* key, Enum& value, const Words<Enum>& words) {
    put(key, std::string(words.to_text(value)));
  }
  void table(const char* key, const std::function<void(SettingsWriter&)>& fields);

 private:
  template <class T>
  void put(const char* key, T value) {
    table_.insert_or_assign(key, value);
  }
  toml::table& table_;
};

/// Reads fields from a table. What is absent stays as it is, silently; what does not fit stays as
/// it is with a warning "file: key: …".
class SettingsReader {
 public:
  SettingsReader(const toml::table& table, std::string path, const std::string& file,
                 std::vector<std::string>& warnings)
      : table_(table), path_(std::move(path)), file_(file), warnings_(warnings) {}

  void flag(const char* key, bool& value);
  void number(const char* key, float& value, NumberLimits limits);
  void integer(const char* key, int& value, NumberLimits limits);
  void seed(const char* key, std::uint64_t& value);
  void seed(const char* key, std::uint32_t& value);
  void text(const char* key, std::string& value);
  void texts(const char* key, std::vector<std::string>& values);
  void vector(const char* key, glm::vec3& value);
  template <class Enum>
  void word(const char* key, Enum& value, const Words<Enum>& words) {
    std::string name(words.to_text(value));
    text(key, name);
    if (const auto parsed = words.parse(name)) {
      value = *parsed;
    } else {
      warn(key, "'" + name + "' is none of its words");
    }
  }
  void table(const char* key, const std::function<void(SettingsReader&)>& fields);
  void warn(std::string_view key, std::string_view what);

 private:
  const toml::table& table_;
  std::string path_;
  const std::string& file_;
  std::vector<std::string>& warnings_;
};

}  // namespace encore::app
