#pragma once

#include <string_view>

namespace encore::scene {

/// Cuts the next token (a run of anything but blanks and line ends) off the front of `text`.
/// Returns an empty view when only blanks are left.
std::string_view take_token(std::string_view& text);

/// Reads a whole token as a number, correctly rounded and independent of the locale. Takes what
/// model files hold: a leading '+', "nan", "inf", the "1.#IND" and "1.#INF" of old Windows
/// programs; too large becomes infinite, too small zero. Returns false if the token is no number.
bool parse_number(std::string_view token, float& value);
bool parse_number(std::string_view token, double& value);

}  // namespace encore::scene
