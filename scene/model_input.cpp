#include "scene/model_input.h"

#include "scene/diagnostics.h"
#include "scene/load_watch.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace encore::scene {

namespace {

// Length of the UTF-8 sequence that starts at text[at]; 0 if it is broken.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  std::size_t length = 0;
  if (lead >= 0xC2 && lead <= 0xDF) length = 2;
  if (lead >= 0xE0 && lead <= 0xEF) length = 3;
  if (lead >= 0xF0 && lead <= 0xF4) length = 4;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[at + i]) & 0xC0U) != 0x80U) return 0;
  }
  return length;
}

}  // namespace

std::string read_model_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError(name + ": no such file; check the path");
  }
  if (error) throw InputError(name + ": cannot be read (" + error.message() + ")");
  if (std::filesystem::is_directory(status)) {
    throw InputError(name + ": is a folder; name a model file in it");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(name + ": is no regular file; copy the model into one");
  }

  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw InputError(name + ": cannot be opened (" + std::strerror(errno) +
                     "); check its permissions");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw InputError(name + ": cannot be read (" + error.message() + ")");
  if (size == 0) throw InputError(name + ": the file is empty (0 bytes); get a whole copy of it");

  std::string bytes;
  try {
    bytes.resize(size);
  } catch (const std::exception&) {
    throw InputError(name + ": the file does not fit into memory; use a smaller model");
  }
  // By pieces, between which the loading may be cancelled.
  constexpr std::uintmax_t kPiece = 4U << 20U;
  std::size_t got = 0;
  for (std::uintmax_t begin = 0; begin < size && file; begin += kPiece) {
    report_load(static_cast<double>(begin) / static_cast<double>(size));
    const std::uintmax_t piece = std::min(kPiece, size - begin);
    file.read(bytes.data() + begin, static_cast<std::streamsize>(piece));
    got += static_cast<std::size_t>(file.gcount());
  }
  bytes.resize(got);
  if (file.bad() || bytes.size() != size) {
    throw InputError(name + ": reading stopped after " + counted(bytes.size(), "byte") + " of " +
                     std::to_string(size) + "; check the disk");
  }
  return bytes;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte >= 0x20 && byte < 0x7F ? 1 : utf8_length(text, i);
    if (result.size() + std::max<std::size_t>(length, 1) > limit) return result + "...";
    if (length == 0) {
      result += '?';
      ++i;
    } else {
      result += text.substr(i, length);
      i += length;
    }
  }
  return result;
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

std::string counted(std::uint64_t count, std::string_view noun) {
  std::string text = std::to_string(count) + " " + std::string(noun);
  if (count == 1) return text;
  if (text.ends_with("x")) {
    text.back() = 'c';
    return text + "es";
  }
  return text + "s";
}

}  // namespace encore::scene
