#include "scene/ply_reader_values.h"

#include "scene/diagnostics.h"
#include "scene/model_input.h"
#include "scene/model_number.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace encore::scene {

namespace {

[[noreturn]] void fail_truncated(const std::string& place) {
  throw InputError(place + ": the file ends before its data does; it is truncated, get a whole " +
                   "copy of it");
}

}  // namespace

PlyAsciiValues::PlyAsciiValues(std::string_view file, std::size_t begin, const std::string& name)
    : file_(file), rest_(file.substr(begin)), name_(name) {}

double PlyAsciiValues::read(PlyType type) {
  const std::string_view token = take_token(rest_);
  if (token.empty()) fail_truncated(place());
  if (type == PlyType::float32) {
    float value = 0.0F;
    if (parse_number(token, value)) return value;
  } else {
    double value = 0.0;
    if (parse_number(token, value)) return value;
  }
  throw InputError(place() + ": \"" + printable(token) +
                   "\" stands where a number must be; the file is damaged");
}

// A value takes a character and a blank at least; only the last one may lack the blank.
bool PlyAsciiValues::can_hold(std::uint64_t values, std::size_t /*bytes_each*/) const {
  return values <= (rest_.size() + 1) / 2;
}

bool PlyAsciiValues::at_end() const {
  std::string_view rest = rest_;
  return take_token(rest).empty();
}

std::string PlyAsciiValues::place() const {
  const std::string_view before = file_.substr(0, file_.size() - rest_.size());
  // Windows line ends hold a line feed each; only the oldest Mac files have none.
  auto lines = std::count(before.begin(), before.end(), '\n');
  if (lines == 0) lines = std::count(before.begin(), before.end(), '\r');
  return name_ + ":" + std::to_string(lines + 1);
}

PlyBinaryValues::PlyBinaryValues(std::string_view file, std::size_t begin, bool big_endian,
                                 const std::string& name)
    : file_(file),
      rest_(file.substr(begin)),
      name_(name),
      swap_(big_endian != (std::endian::native == std::endian::big)) {}

template <typename Value>
double PlyBinaryValues::load() {
  if (rest_.size() < sizeof(Value)) fail_truncated(place());
  char bytes[sizeof(Value)];
  std::memcpy(bytes, rest_.data(), sizeof(Value));
  if (swap_) std::reverse(bytes, bytes + sizeof(Value));
  Value value;
  std::memcpy(&value, bytes, sizeof(Value));
  rest_.remove_prefix(sizeof(Value));
  return static_cast<double>(value);
}

double PlyBinaryValues::read(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return load<std::int8_t>();
    case PlyType::uint8:
      return load<std::uint8_t>();
    case PlyType::int16:
      return load<std::int16_t>();
    case PlyType::uint16:
      return load<std::uint16_t>();
    case PlyType::int32:
      return load<std::int32_t>();
    case PlyType::uint32:
      return load<std::uint32_t>();
    case PlyType::float32:
      return load<float>();
    case PlyType::float64:
      break;
  }
  return load<double>();
}

bool PlyBinaryValues::can_hold(std::uint64_t values, std::size_t bytes_each) const {
  return values <= rest_.size() / std::max<std::size_t>(bytes_each, 1);
}

std::string PlyBinaryValues::place() const {
  return name_ + ": at byte " + std::to_string(file_.size() - rest_.size());
}

}  // namespace encore::scene
