#pragma once

#include "scene/diagnostics.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value in a binary file.
std::size_t ply_size(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  Warnings warnings;
  std::size_t data_begin = 0;  ///< offset of the first byte behind the header
};

/// Reads the header. Lines end as the first one does (LF, CRLF or CR), so that a binary file whose
/// first data byte is a line feed is read right. Stray text is skipped with a warning; numbers mean
/// that the data has begun without an end_header. Throws InputError with the line.
PlyHeader parse_ply_header(std::string_view file, const std::string& name);

}  // namespace encore::scene
