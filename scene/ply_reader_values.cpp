#include "scene/ply_reader_values.h"

#include "scene/diagnostics.h"
#include "scene/model_input.h"
#include "scene/model_number.h"
#include "scene/ply_reader_bytes.h"

#include <algorithm>
#include <bit>
#include <span>

namespace encore::scene {

namespace {

[[noreturn]] void fail_truncated(const std::string& place) {
  throw InputError(place + ": the file ends before its data does; it is truncated, get a whole " +
                   "copy of it");
}

// Faces lie `step` bytes apart; `at` is the first one's list. Returns how many of them have three
// corners before another one comes.
template <typename Count, bool swap>
std::size_t load_triangles(const char* at, std::size_t step, std::span<glm::uvec3> triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (load_bytes<Count, swap>(at) != 3) return i;
    for (int k = 0; k < 3; ++k) {
      triangles[i][k] = load_bytes<std::uint32_t, swap>(at + sizeof(Count) + 4 * k);
    }
    at += step;
  }
  return triangles.size();
}

void mark_negative(std::span<glm::uvec3> triangles) {
  for (glm::uvec3& t : triangles) {
    for (int k = 0; k < 3; ++k) t[k] |= 0U - (t[k] >> 31U);
  }
}

}  // namespace

PlyAsciiValues::PlyAsciiValues(std::string_view file, std::size_t begin, const std::string& name)
    : file_(file), rest_(file.substr(begin)), name_(name) {}

double PlyAsciiValues::read(PlyType type) {
  if (type == PlyType::float32) {
    float value = 0.0F;
    if (take_plain_number(rest_, value)) return value;
  } else {
    double value = 0.0;
    if (take_plain_number(rest_, value)) return value;
  }
  return read_unusual(type);
}

double PlyAsciiValues::read_unusual(PlyType type) {
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
  const Value value =
      swap_ ? load_bytes<Value, true>(rest_.data()) : load_bytes<Value, false>(rest_.data());
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

std::string_view PlyBinaryValues::take_rows(std::size_t bytes) {
  const std::string_view rows = rest_.substr(0, bytes);
  rest_.remove_prefix(rows.size());
  return rows;
}

std::uint64_t PlyBinaryValues::take_triangles(const PlyFaceShape& shape, std::uint64_t most,
                                              std::vector<glm::uvec3>& triangles) {
  const std::size_t count_size = ply_size(shape.count_type);
  const bool counts = shape.count_type == PlyType::uint8 || shape.count_type == PlyType::int8 ||
                      shape.count_type == PlyType::uint32 || shape.count_type == PlyType::int32;
  const bool is_signed = shape.corner_type == PlyType::int32;
  if (!counts || (!is_signed && shape.corner_type != PlyType::uint32)) return 0;

  const std::size_t step = shape.before + count_size + sizeof(glm::uvec3) + shape.behind;
  const std::size_t old = triangles.size();
  triangles.resize(old + std::min<std::uint64_t>(most, rest_.size() / step));
  const std::span<glm::uvec3> fresh = std::span(triangles).subspan(old);
  const char* const at = rest_.data() + shape.before;
  std::size_t got = 0;
  if (count_size == 1) {
    got = swap_ ? load_triangles<std::uint8_t, true>(at, step, fresh)
                : load_triangles<std::uint8_t, false>(at, step, fresh);
  } else {
    got = swap_ ? load_triangles<std::uint32_t, true>(at, step, fresh)
                : load_triangles<std::uint32_t, false>(at, step, fresh);
  }
  if (is_signed) mark_negative(fresh.first(got));
  triangles.resize(old + got);
  rest_.remove_prefix(got * step);
  return got;
}

std::string PlyBinaryValues::place() const {
  return name_ + ": at byte " + std::to_string(file_.size() - rest_.size());
}

}  // namespace encore::scene
