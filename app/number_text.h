#pragma once

#include <cstdint>
#include <string>

namespace encore::app {

/// 1234567 → "1,234,567".
std::string with_separators(std::uint64_t number);

/// A number of bytes in the unit that fits: "512 B", "1.5 MiB".
std::string bytes_text(std::uint64_t bytes);

/// A duration: "12.5 s", "3 min 20 s", "12 h 34 min".
std::string duration_text(double seconds);

}  // namespace encore::app
