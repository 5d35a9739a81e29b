#pragma once

#include "scene/ply_reader_header.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace encore::scene {

/// The values behind a PLY header one after the other. Two classes of the same shape, used as
/// template arguments: read() gives the next value (every type fits into a double exactly, and
/// ASCII floats are rounded to float first), can_hold() whether that many values could still come,
/// and place() where we are, for messages. read() throws InputError at the end of the file.
class PlyAsciiValues {
 public:
  PlyAsciiValues(std::string_view file, std::size_t begin, const std::string& name);

  double read(PlyType type);
  [[nodiscard]] bool can_hold(std::uint64_t values, std::size_t bytes_each) const;
  [[nodiscard]] bool at_end() const;
  [[nodiscard]] std::string place() const;

 private:
  std::string_view file_;
  std::string_view rest_;
  const std::string& name_;
};

class PlyBinaryValues {
 public:
  PlyBinaryValues(std::string_view file, std::size_t begin, bool big_endian,
                  const std::string& name);

  double read(PlyType type);
  [[nodiscard]] bool can_hold(std::uint64_t values, std::size_t bytes_each) const;
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] std::string place() const;

 private:
  template <typename Value>
  double load();

  std::string_view file_;
  std::string_view rest_;
  const std::string& name_;
  bool swap_ = false;
};

}  // namespace encore::scene
