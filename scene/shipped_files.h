#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// Folders where what ships with the program (scenes/, studies/, thesis/) may lie, in the order in
/// which they are tried: beside the program (PREFIX/bin and PREFIX/share/encore, wherever PREFIX
/// was moved to; a build folder has a link to assets/ there), then where it was configured to be
/// installed. `program` is the path of the running program and may be empty.
std::vector<std::filesystem::path> shipped_folder_candidates(const std::filesystem::path& program);

/// The first candidate that is a folder; empty if none is.
std::filesystem::path first_folder(std::span<const std::filesystem::path> candidates);

/// The folder of the running program; empty if what ships is missing.
std::filesystem::path shipped_folder();

/// The file `name`.toml of one kind ("scenes", "studies"), or an empty path. Only bare names are
/// looked up: letters, digits, `-` and `_`.
std::filesystem::path shipped_file(std::string_view kind, std::string_view name);

/// The names that shipped_file() knows, sorted; none if what ships is missing.
std::vector<std::string> shipped_names(std::string_view kind);

/// For messages, where shipped_folder() is empty: what was looked for, where, and the way out.
std::string shipped_files_missing();

}  // namespace encore::scene
