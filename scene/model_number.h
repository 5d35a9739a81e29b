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

/// take_token and parse_number in one step and much faster, same value bit for bit, for numbers as
/// most files hold them: few digits, a small exponent or none (Clinger 1990). Returns false and
/// leaves `text` as it is before all others, so call those two then.
bool take_plain_number(std::string_view& text, float& value);
bool take_plain_number(std::string_view& text, double& value);

}  // namespace encore::scene
