#pragma once

#include <filesystem>

struct _XDisplay;

namespace encore::test {

/// Drops a file onto a window as a file manager does (XDND, version 5). False if the window did not
/// take it.
bool drop_file(_XDisplay* display, unsigned long window, const std::filesystem::path& file, int x,
               int y);

}  // namespace encore::test
