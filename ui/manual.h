#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace encore::ui {

/// A piece of a line: words, or code in backticks.
struct ManualSpan {
  std::string text;
  bool code = false;

  friend bool operator==(const ManualSpan&, const ManualSpan&) = default;
};
using ManualLine = std::vector<ManualSpan>;

struct ManualBlock {
  enum class Kind { heading, paragraph, bullet, table } kind = Kind::paragraph;
  int level = 0;    ///< of a heading: 1 to 3
  ManualLine line;  ///< of all but tables
  std::vector<std::vector<ManualLine>>
      rows;  ///< of a table, each with as many cells; headings first
};

/// The manual as it is drawn: blocks in order, and the places of its chapters.
struct Manual {
  std::vector<ManualBlock> blocks;
  std::vector<std::size_t> chapters;  ///< headings of level 2 and 3
};

/// Reads Markdown of headings (#, ##, ###), paragraphs, lists (-), code in backticks and tables
/// (|). Never fails: what is none of these is a paragraph; an unclosed backtick stays as it is.
Manual parse_manual(std::string_view text);

/// The words of a line or of a whole block.
std::string plain_text(const ManualLine& line);
std::string plain_text(const ManualBlock& block);

/// Places of the blocks that hold the words, capitals or not; none for no words.
std::vector<std::size_t> search_manual(const Manual& manual, std::string_view words);

}  // namespace encore::ui
