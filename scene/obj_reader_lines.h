#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// A corner as the file states it, counted from 1; 0: none.
struct ObjCorner {
  int position = 0;
  int texcoord = 0;
  int normal = 0;
};

/// Feeds OBJ text to tinyobjloader one statement at a time, so that a callback can see the
/// statement it was called for, and keeps from the library what it cannot take:
/// - lines that end in a backslash are joined, any of LF, CRLF, CR ends a line;
/// - `v`, `vn`, `vt` go to `on_numbers`: the library reads "nan" as 0, rounds decimal numbers
///   inexactly, overflows on long exponents and has no colours in its callbacks;
/// - faces of plain numbers, which nearly all are, go to `on_plain_face`, as it is much faster;
/// - digits runs of ten and more in faces become 0, no valid index: the library would wrap them
///   around to some other vertex;
/// - blanks around and inside names are trimmed, so that usemtl finds what newmtl defined;
/// - everything else stays outside (comments, groups, curves, material files, which go to
///   `on_other` instead).
/// Reports to load_watch.h every few thousand lines.
class ObjLineFeed : public std::streambuf {
 public:
  explicit ObjLineFeed(std::string_view text) : rest_(text), size_(text.size()) {}
  ~ObjLineFeed() override = default;

  /// Called for statements that do not go through tinyobjloader; the keyword is cut off.
  virtual void on_other(std::string_view keyword, std::string_view arguments) = 0;
  /// Called for `v`, `vn`, `vt` with arguments() set.
  virtual void on_numbers(std::string_view keyword) = 0;
  /// Called for faces of positive numbers like "1 2 3", "1/1 2/2", "1//1" and "1/1/1", as the
  /// library would call index_cb.
  virtual void on_plain_face(std::span<const ObjCorner> corners) = 0;

  /// The current statement without its keyword, and the line it starts in (from 1).
  [[nodiscard]] std::string_view arguments() const { return arguments_; }
  [[nodiscard]] std::uint32_t line() const { return line_; }

 protected:
  int_type underflow() override;

 private:
  bool next_statement();
  bool read_plain_face();
  void write_statement(std::string_view keyword);

  std::string_view rest_;
  std::size_t size_;            // of the whole text
  std::string joined_;          // a statement made of several lines
  std::string_view arguments_;  // into the text or joined_
  std::string out_;             // what tinyobjloader gets
  std::vector<ObjCorner> plain_face_;
  std::uint32_t line_ = 0;
  std::uint32_t next_line_ = 1;
};

}  // namespace encore::scene
