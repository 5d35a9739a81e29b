#include "scene/camera_text.h"

#include "scene/diagnostics.h"
#include "scene/model_number.h"
#include "scene/scene_toml_camera.h"
#include "scene/toml_reading.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

namespace encore::scene {

namespace {

constexpr std::size_t kLongestText = 10000;
const std::string kSource = "camera";

/// The shortest text that is read back as the same float; it is read as a double first.
std::string number_text(float value) {
  std::string text = fmt::format("{}", value);
  // Integers of TOML have no -0, and as numbers they may not be greater than 2^53.
  const bool integer = text.find_first_of(".e") == std::string::npos;
  if (integer && ((value == 0.0F && std::signbit(value)) || std::abs(value) >= 1e15F)) text += ".0";
  double read = 0.0;
  if (parse_number(text, read) && static_cast<float>(read) == value) return text;
  return fmt::format("{:.17g}", static_cast<double>(value));
}

std::string vector_text(const glm::vec3& v) {
  return fmt::format("[{}, {}, {}]", number_text(v.x), number_text(v.y), number_text(v.z));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// One line without `camera =` or a heading becomes the value of `camera`.
std::string as_toml(std::string_view text) {
  if (text.starts_with('{')) return fmt::format("camera = {}", text);
  const bool one_line = text.find('\n') == std::string_view::npos;
  if (one_line && !text.starts_with("camera") && !text.starts_with('[')) {
    return fmt::format("camera = {{ {} }}", text);
  }
  return std::string(text);
}

/// "camera:1:12: ..." without the place, which the text that was put around it has moved.
std::string without_place(const std::string& message) {
  std::size_t i = kSource.size();
  while (i < message.size() && (message[i] == ':' || (message[i] >= '0' && message[i] <= '9'))) {
    ++i;
  }
  return message.starts_with(kSource) && i < message.size() && message[i] == ' '
             ? message.substr(i + 1)
             : message;
}

std::string without(std::string text, std::string_view part) {
  const std::size_t found = text.find(part);
  if (found != std::string::npos) text.erase(found, part.size());
  return text;
}

Camera read(std::string_view text, const Camera& base) {
  const toml::table document = parse_toml(as_toml(text), kSource);
  TomlTable root(document, "", kSource);
  std::optional<TomlTable> inner = root.table("camera");
  TomlTable outer(document, "camera", kSource);
  TomlTable& table = inner ? *inner : outer;
  if (table.raw().empty()) throw InputError("it names none of eye, target, up, fov");
  const Camera camera = read_camera_keys(table, base);
  Warnings unknown;
  table.warn_about_unknown_keys(unknown);
  if (!unknown.messages.empty()) throw InputError(without(unknown.messages.front(), " is ignored"));
  return camera;
}

}  // namespace

std::string camera_text(const Camera& camera) {
  return fmt::format("camera = {{ eye = {}, target = {}, up = {}, {} = {} }}",
                     vector_text(camera.eye), vector_text(camera.target), vector_text(camera.up),
                     camera.orthographic() ? "orthographic_height" : "fov",
                     number_text(camera.orthographic() ? camera.orthographic_height
                                                       : camera.vertical_fov_degrees));
}

Camera parse_camera_text(std::string_view text, const Camera& base) {
  const std::string_view content = trimmed(text);
  if (content.empty()) throw InputError("this is no camera: the text is empty");
  if (content.size() > kLongestText) {
    throw InputError(fmt::format("this is no camera: the text has {} characters", content.size()));
  }
  try {
    return read(content, base);
  } catch (const InputError& error) {
    throw InputError(fmt::format("this is no camera: {}; write for example {}",
                                 without_place(error.what()), camera_text(Camera{})));
  }
}

}  // namespace encore::scene
