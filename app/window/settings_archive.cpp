#include "app/window/settings_archive.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace encore::app {

void SettingsWriter::number(const char* key, float& value, NumberLimits) {
  put(key, static_cast<double>(value));
}

void SettingsWriter::integer(const char* key, int& value, NumberLimits) {
  put(key, std::int64_t{value});
}

void SettingsWriter::seed(const char* key, std::uint64_t& value) {
  // As text: TOML's integers end at 2^63.
  put(key, fmt::format("{}", value));
}

void SettingsWriter::seed(const char* key, std::uint32_t& value) {
  put(key, std::int64_t{value});
}

void SettingsWriter::texts(const char* key, std::vector<std::string>& values) {
  toml::array array;
  for (const std::string& value : values) array.push_back(value);
  put(key, array);
}

void SettingsWriter::vector(const char* key, glm::vec3& value) {
  put(key, toml::array{double(value.x), double(value.y), double(value.z)});
}

void SettingsWriter::table(const char* key, const std::function<void(SettingsWriter&)>& fields) {
  toml::table inner;
  SettingsWriter writer(inner);
  fields(writer);
  put(key, inner);
}

void SettingsReader::warn(std::string_view key, std::string_view what) {
  warnings_.push_back(fmt::format("{}: {}{}: {}; the default is used", file_, path_, key, what));
}

void SettingsReader::flag(const char* key, bool& value) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  if (const auto read = node->value_exact<bool>()) {
    value = *read;
  } else {
    warn(key, "it takes true or false");
  }
}

void SettingsReader::number(const char* key, float& value, NumberLimits limits) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const auto read = node->is_number() ? node->value<double>() : std::nullopt;
  if (read && *read >= limits.low && *read <= limits.high) {
    value = static_cast<float>(*read);
  } else {
    warn(key, fmt::format("it takes a number from {:g} to {:g}", limits.low, limits.high));
  }
}

void SettingsReader::integer(const char* key, int& value, NumberLimits limits) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const auto read = node->value_exact<std::int64_t>();
  if (read && double(*read) >= limits.low && double(*read) <= limits.high) {
    value = static_cast<int>(*read);
  } else {
    warn(key, fmt::format("it takes a whole number from {:g} to {:g}", limits.low, limits.high));
  }
}

void SettingsReader::seed(const char* key, std::uint64_t& value) {
  std::string digits = fmt::format("{}", value);
  text(key, digits);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    warn(key, "it takes a whole number in quotation marks");
  }
}

void SettingsReader::seed(const char* key, std::uint32_t& value) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const auto read = node->value_exact<std::int64_t>();
  if (read && *read >= 0 && *read <= std::int64_t{0xFFFFFFFF}) {
    value = static_cast<std::uint32_t>(*read);
  } else {
    warn(key, "it takes a whole number from 0 to 4294967295");
  }
}

void SettingsReader::text(const char* key, std::string& value) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  if (auto read = node->value_exact<std::string>()) {
    value = std::move(*read);
  } else {
    warn(key, "it takes a text in quotation marks");
  }
}

void SettingsReader::texts(const char* key, std::vector<std::string>& values) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  std::vector<std::string> read;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    if (auto value = array->get(i)->value_exact<std::string>()) read.push_back(std::move(*value));
  }
  if (array != nullptr && read.size() == array->size()) {
    values = std::move(read);
  } else {
    warn(key, "it takes a list of texts");
  }
}

void SettingsReader::vector(const char* key, glm::vec3& value) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  glm::vec3 read(0.0F);
  bool whole = array != nullptr && array->size() == 3;
  for (int i = 0; whole && i < 3; ++i) {
    const toml::node& entry = *array->get(static_cast<std::size_t>(i));
    const auto number = entry.is_number() ? entry.value<double>() : std::nullopt;
    whole = number && std::abs(*number) <= 1e37;
    if (whole) read[i] = static_cast<float>(*number);
  }
  if (whole) {
    value = read;
  } else {
    warn(key, "it takes three numbers");
  }
}

void SettingsReader::table(const char* key, const std::function<void(SettingsReader&)>& fields) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  if (const toml::table* inner = node->as_table()) {
    SettingsReader reader(*inner, path_ + key + ".", file_, warnings_);
    fields(reader);
  } else {
    warn(key, "it takes a table");
  }
}

}  // namespace encore::app
