#include "ui/plot/bar_layout.h"

#include <algorithm>
#include <string>

namespace encore::ui {

namespace {

constexpr std::string_view kBreaks = " /,-";
constexpr std::string_view kEllipsis = "\xE2\x80\xA6";

/// The end of the UTF-8 character before `end`.
std::size_t back_one(std::string_view text, std::size_t end) {
  do {
    --end;
  } while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U);
  return end;
}

/// The longest beginning with an ellipsis that fits; an ellipsis alone where nothing does.
std::string shorten(std::string_view text, float width, const MeasureText& measure) {
  std::size_t end = text.size();
  while (end > 0) {
    const std::string tried = std::string(text.substr(0, end)) + std::string(kEllipsis);
    if (measure(tried) <= width) return tried;
    end = back_one(text, end);
  }
  return measure(kEllipsis) <= width ? std::string(kEllipsis) : std::string();
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// The last place to break at so that what is before it fits; 0 if there is none.
std::size_t break_place(std::string_view text, float width, const MeasureText& measure) {
  std::size_t best = 0;
  for (std::size_t at = text.find_first_of(kBreaks); at != std::string_view::npos;
       at = text.find_first_of(kBreaks, at + 1)) {
    const std::size_t end = at + 1;  // the sign itself stays on the line
    if (end == text.size() || measure(trim(text.substr(0, end))) > width) break;
    best = end;
  }
  return best;
}

}  // namespace

PlacedLabel fit_label(std::string_view text, float width, int lines, const MeasureText& measure) {
  PlacedLabel label;
  std::string_view rest = trim(text);
  for (int line = 0; line < lines && !rest.empty(); ++line) {
    if (measure(rest) <= width) {
      label.lines.emplace_back(rest);
      return label;
    }
    const std::size_t end = line + 1 < lines ? break_place(rest, width, measure) : 0;
    if (end == 0) {
      label.lines.push_back(shorten(rest, width, measure));
      label.shortened = true;
      return label;
    }
    label.lines.emplace_back(trim(rest.substr(0, end)));
    rest = trim(rest.substr(end));
  }
  label.shortened = !rest.empty();
  return label;
}

float two_line_width(std::string_view text, const MeasureText& measure) {
  const std::string_view whole = trim(text);
  float least = measure(whole);
  for (std::size_t at = whole.find_first_of(kBreaks); at != std::string_view::npos;
       at = whole.find_first_of(kBreaks, at + 1)) {
    const std::size_t end = at + 1;
    if (end == whole.size()) break;
    least = std::min(
        least, std::max(measure(trim(whole.substr(0, end))), measure(trim(whole.substr(end)))));
  }
  return least;
}

}  // namespace encore::ui
