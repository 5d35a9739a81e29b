#pragma once

#include <string>
#include <string_view>

namespace encore::scene {

/// The extension (as ".ply") of the format that the content shows without doubt, by signatures at
/// its start, by the exact size of binary STL, or because it consists of OBJ statements; empty if
/// nothing tells.
std::string sniff_extension(std::string_view file);

}  // namespace encore::scene
