#pragma once

#include <cstdint>
#include <string>

namespace encore::app {

/// Writes where the widgets of the last frame lie (ui/widget_map.h) to `file`, for programs that
/// drive the window as a person would. The first line is "frame", its number, and "busy" or "idle",
/// with tabs between. The file is always whole: it is renamed into its place.
void write_widget_map(const std::string& file, std::uint64_t frame, bool busy);

}  // namespace encore::app
