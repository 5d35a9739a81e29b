#pragma once

#include <string>
#include <string_view>

namespace encore::app {

/// A JSON string literal of UTF-8 text, quotes included; control characters are escaped.
std::string json_text(std::string_view text);

/// A JSON number, or null if it is not finite (JSON has no NaN or infinity).
std::string json_number(double value);

}  // namespace encore::app
