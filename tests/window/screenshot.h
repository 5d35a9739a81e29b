#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

struct _XDisplay;

namespace encore::test {

/// A rectangle of the screen, in pixels.
struct Area {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// What is to be seen on the screen. The figures of a part are loose on purpose: they tell
/// structure, not pixels.
class Screenshot {
 public:
  Screenshot() = default;
  Screenshot(int width, int height);
  static Screenshot take(_XDisplay* display, unsigned long window);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const;
  void set(int x, int y, std::uint8_t r, std::uint8_t g, std::uint8_t b);

  /// The number of colours, told apart by their upper five bits a channel.
  [[nodiscard]] std::size_t colors(const Area& area) const;
  /// From 0 to 255, of all channels.
  [[nodiscard]] double brightness(const Area& area) const;
  /// The share of pixels that differ clearly from their right or lower neighbour.
  [[nodiscard]] double edges(const Area& area) const;
  /// Writes it as NAME.png into the folder that ENCORE_WINDOW_SHOTS names, if it does.
  void keep(const std::string& name) const;

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> rgb_;
};

/// The share of an area's pixels that differ clearly; 1 where one of them does not hold it all.
double difference(const Screenshot& a, const Screenshot& b, const Area& area);

}  // namespace encore::test
