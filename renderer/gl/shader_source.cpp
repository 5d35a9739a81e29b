#include "renderer/gl/shader_source.h"

#include "renderer/gl/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace encore::renderer::gl {

namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) - first + 1);
}

/// What stands behind a directive such as "include"; nothing if the line is none.
std::optional<std::string_view> directive(std::string_view line, std::string_view name) {
  line = trimmed(line);
  if (!line.starts_with('#')) return std::nullopt;
  line = trimmed(line.substr(1));
  if (!line.starts_with(name)) return std::nullopt;
  line.remove_prefix(name.size());
  const bool word_ends =
      line.empty() || line[0] == ' ' || line[0] == '\t' || line[0] == '"' || line[0] == '<';
  return word_ends ? std::optional(trimmed(line)) : std::nullopt;
}

const ShaderFile* find_file(std::string_view name) {
  const auto files = shader_files();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const ShaderFile& file) { return file.name == name; });
  return found == files.end() ? nullptr : &*found;
}

class Assembly {
 public:
  Assembly(ShaderSource& source) : source_(source) {}

  /// Appends a file with all that it includes; `from` says who asked for it.
  void append(std::string_view name, const std::string& from) {
    const ShaderFile* file = find_file(name);
    if (file == nullptr) {
      throw GlError(fmt::format(
          "{}there is no shader file '{}'; files must have been in shaders/ when the program was "
          "built",
          from, name));
    }
    const std::size_t number = source_.files.size();
    source_.files.emplace_back(name);
    mark_line(1, number);
    std::string_view rest = file->text;
    for (int line = 1; !rest.empty(); ++line) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      append_line(rest.substr(0, end), line, number);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

 private:
  void mark_line(int line, std::size_t file) {
    source_.text += fmt::format("#line {} {}\n", line, file);
  }

  void append_line(std::string_view line, int line_number, std::size_t file) {
    const auto included = directive(line, "include");
    if (!included) {
      // The version stands at the top, and each file comes once anyway.
      if (!directive(line, "version") && directive(line, "pragma") != "once") source_.text += line;
      source_.text += '\n';
      return;
    }
    const std::string_view path = *included;
    const std::size_t end = path.find('"', 1);
    if (!path.starts_with('"') || end == std::string_view::npos) {
      source_.text += '\n';  // <…> is for C++ alone
      return;
    }
    std::string_view name = path.substr(1, end - 1);
    if (name.starts_with("shaders/")) name.remove_prefix(std::string_view("shaders/").size());
    if (std::find(source_.files.begin(), source_.files.end(), name) != source_.files.end()) {
      source_.text += '\n';
      return;
    }
    append(name, fmt::format("{}:{}: ", source_.files[file], line_number));
    mark_line(line_number + 1, file);
  }

  ShaderSource& source_;
};

/// Takes a number off the front.
std::optional<std::size_t> take_number(std::string_view& text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

std::string readable_line(std::string_view line, std::span<const std::string> files) {
  std::string prefix;
  std::string_view rest = line;
  for (const std::string_view word : {"ERROR: ", "WARNING: "}) {
    if (rest.starts_with(word)) {
      prefix = word;
      rest.remove_prefix(word.size());
    }
  }
  const auto file = take_number(rest);
  if (!file || *file >= files.size() || rest.empty()) return std::string(line);
  const char open = rest[0];
  if (open != '(' && open != ':') return std::string(line);
  rest.remove_prefix(1);
  const auto number = take_number(rest);
  if (!number) return std::string(line);
  if (open == '(') {
    if (!rest.starts_with(')')) return std::string(line);
    rest.remove_prefix(1);
  }
  return fmt::format("{}{}:{}{}", prefix, files[*file], *number, rest);
}

}  // namespace

ShaderSource assemble_shader(std::string_view file, std::span<const std::string> defines) {
  ShaderSource source;
  source.text = "#version 430 core\n";
  for (const std::string& define : defines) source.text += "#define " + define + '\n';
  Assembly(source).append(file, "");
  return source;
}

std::string readable_log(std::string_view log, std::span<const std::string> files) {
  std::string text;
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size());
    text += readable_line(log.substr(0, end), files);
    if (end < log.size()) text += '\n';
    log.remove_prefix(std::min(end + 1, log.size()));
  }
  return text;
}

}  // namespace encore::renderer::gl
