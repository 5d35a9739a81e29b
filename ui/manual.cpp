#include "ui/manual.h"

#include <algorithm>
#include <cctype>

namespace encore::ui {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) {
    text.remove_suffix(1);
  }
  return text;
}

ManualLine spans_of(std::string_view text) {
  ManualLine line;
  while (!text.empty()) {
    const std::size_t open = text.find('`');
    const std::size_t close = open == std::string_view::npos ? open : text.find('`', open + 1);
    if (close == std::string_view::npos) {
      line.push_back({std::string(text), false});
      break;
    }
    if (open > 0) line.push_back({std::string(text.substr(0, open)), false});
    line.push_back({std::string(text.substr(open + 1, close - open - 1)), true});
    text.remove_prefix(close + 1);
  }
  return line;
}

/// The cells between the bars; a bar inside of code divides nothing.
std::vector<ManualLine> cells_of(std::string_view row) {
  row = trimmed(row);
  row.remove_prefix(1);
  if (row.ends_with('|')) row.remove_suffix(1);
  std::vector<ManualLine> cells;
  std::size_t start = 0;
  bool code = false;
  for (std::size_t i = 0; i <= row.size(); ++i) {
    if (i < row.size() && row[i] == '`') code = !code;
    if (i == row.size() || (row[i] == '|' && !code)) {
      cells.push_back(spans_of(trimmed(row.substr(start, i - start))));
      start = i + 1;
    }
  }
  return cells;
}

/// "|---|:--:|", which divides headings from rows.
bool rule(std::string_view row) {
  return row.find('-') != std::string_view::npos &&
         row.find_first_not_of("|-: ") == std::string_view::npos;
}

void add_row(std::string_view row, bool first, Manual& manual) {
  if (first) manual.blocks.push_back({ManualBlock::Kind::table, 0, {}, {}});
  if (rule(row)) return;
  auto& rows = manual.blocks.back().rows;
  std::vector<ManualLine> cells = cells_of(row);
  if (!rows.empty()) cells.resize(rows.front().size());
  rows.push_back(std::move(cells));
}

int heading_level(std::string_view line) {
  int level = 0;
  while (level < 3 && line.substr(static_cast<std::size_t>(level)).starts_with('#')) ++level;
  return line.substr(static_cast<std::size_t>(level)).starts_with(' ') ? level : 0;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

void add_line(std::string_view line, Manual& manual) {
  if (const int level = heading_level(line); level > 0) {
    if (level > 1) manual.chapters.push_back(manual.blocks.size());
    const auto words = trimmed(line.substr(static_cast<std::size_t>(level)));
    manual.blocks.push_back({ManualBlock::Kind::heading, level, spans_of(words), {}});
  } else if (line.starts_with("- ")) {
    manual.blocks.push_back({ManualBlock::Kind::bullet, 0, spans_of(trimmed(line.substr(2))), {}});
  } else {
    manual.blocks.push_back({ManualBlock::Kind::paragraph, 0, spans_of(line), {}});
  }
}

}  // namespace

Manual parse_manual(std::string_view text) {
  Manual manual;
  bool in_table = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool row = line.starts_with('|');
    if (row) {
      add_row(line, !in_table, manual);
    } else if (!line.empty()) {
      add_line(line, manual);
    }
    in_table = row;
  }
  return manual;
}

std::string plain_text(const ManualLine& line) {
  std::string text;
  for (const ManualSpan& span : line) text += span.text;
  return text;
}

std::string plain_text(const ManualBlock& block) {
  std::string text = plain_text(block.line);
  for (const auto& row : block.rows) {
    for (const ManualLine& cell : row) text += plain_text(cell) + " ";
  }
  return text;
}

std::vector<std::size_t> search_manual(const Manual& manual, std::string_view words) {
  const std::string wanted = lower(trimmed(words));
  std::vector<std::size_t> found;
  if (wanted.empty()) return found;
  for (std::size_t i = 0; i < manual.blocks.size(); ++i) {
    if (lower(plain_text(manual.blocks[i])).find(wanted) != std::string::npos) found.push_back(i);
  }
  return found;
}

}  // namespace encore::ui
