#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace encore::scene {

/// Reads a whole model file. Throws InputError for what is missing, no regular file (folders, pipes
/// and devices could block or never end), empty, unreadable or larger than memory. Followed by
/// load_watch.h, as all that loads.
std::string read_model_file(const std::filesystem::path& path);

/// Text from a file made fit for a message: control characters and broken UTF-8 become '?', and
/// what is longer than `limit` bytes is cut.
std::string printable(std::string_view text, std::size_t limit = 60);

/// Lower-cased extension with its dot (ASCII letters only); empty if there is none.
std::string lower_extension(const std::filesystem::path& path);

/// "1 face", "3 faces".
std::string counted(std::uint64_t count, std::string_view noun);

}  // namespace encore::scene
