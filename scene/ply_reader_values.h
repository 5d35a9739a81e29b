#pragma once

#include "scene/ply_reader_header.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// A face element whose only list holds the corners: what stands before and behind it has the same
/// number of bytes in every face of a binary file.
struct PlyFaceShape {
  std::size_t before = 0;
  PlyType count_type = PlyType::uint8;
  PlyType corner_type = PlyType::int32;
  std::size_t behind = 0;
};

/// The values behind a PLY header one after the other. Two classes of the same shape, used as
/// template arguments: read() gives the next value (every type fits into a double exactly, and
/// ASCII floats are rounded to float first), can_hold() whether that many values could still come,
/// and place() where we are, for messages. read() throws InputError at the end of the file.
class PlyAsciiValues {
 public:
  /// Whether rows of the same length can be had as they lie: see PlyBinaryValues.
  static constexpr bool kHasRows = false;

  PlyAsciiValues(std::string_view file, std::size_t begin, const std::string& name);

  double read(PlyType type);
  [[nodiscard]] bool can_hold(std::uint64_t values, std::size_t bytes_each) const;
  [[nodiscard]] bool at_end() const;
  [[nodiscard]] std::string place() const;

 private:
  double read_unusual(PlyType type);

  std::string_view file_;
  std::string_view rest_;
  const std::string& name_;
};

class PlyBinaryValues {
 public:
  static constexpr bool kHasRows = true;

  PlyBinaryValues(std::string_view file, std::size_t begin, bool big_endian,
                  const std::string& name);

  double read(PlyType type);
  [[nodiscard]] bool can_hold(std::uint64_t values, std::size_t bytes_each) const;
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] std::string place() const;

  /// The next `bytes` bytes as they lie, at once; can_hold() must have said that they are there.
  std::string_view take_rows(std::size_t bytes);
  /// Whether the bytes of each value are the other way round than the machine's.
  [[nodiscard]] bool swapped() const { return swap_; }
  /// Appends the corners of the next faces, up to `most` of them; stops before the first that does
  /// not have three corners or that the file does not hold whole, and at once at types other than
  /// 8- and 32-bit counts with 32-bit corners. Negative corners become kNoVertex. Returns
  /// the number of faces.
  std::uint64_t take_triangles(const PlyFaceShape& shape, std::uint64_t most,
                               std::vector<glm::uvec3>& triangles);

 private:
  template <typename Value>
  double load();

  std::string_view file_;
  std::string_view rest_;
  const std::string& name_;
  bool swap_ = false;
};

}  // namespace encore::scene
