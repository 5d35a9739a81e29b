#include "screenshot.h"

#include "renderer/image_io.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace encore::test {

namespace {

/// What a person would call another colour.
constexpr int kClearly = 12;

bool differ(const std::uint8_t* a, const std::uint8_t* b) {
  for (int channel = 0; channel < 3; ++channel) {
    if (std::abs(int(a[channel]) - int(b[channel])) > kClearly) return true;
  }
  return false;
}

Area within(const Area& area, int width, int height) {
  Area cut = area;
  cut.x = std::clamp(area.x, 0, width);
  cut.y = std::clamp(area.y, 0, height);
  cut.width = std::clamp(area.x + area.width, cut.x, width) - cut.x;
  cut.height = std::clamp(area.y + area.height, cut.y, height) - cut.y;
  return cut;
}

template <class Visit>
void for_each_pixel(const Area& area, const Visit& visit) {
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) visit(x, y);
  }
}

}  // namespace

Screenshot::Screenshot(int width, int height)
    : width_(width),
      height_(height),
      rgb_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3) {}

const std::uint8_t* Screenshot::at(int x, int y) const {
  return &rgb_[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(x)) *
               3];
}

void Screenshot::set(int x, int y, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  const std::size_t place = static_cast<std::size_t>(at(x, y) - rgb_.data());
  rgb_[place] = r;
  rgb_[place + 1] = g;
  rgb_[place + 2] = b;
}

Screenshot Screenshot::take(_XDisplay* display, unsigned long window) {
  XWindowAttributes attributes{};
  if (XGetWindowAttributes(display, window, &attributes) == 0) return {};
  // What the root shows there, so that a part off the screen cannot fail the call.
  int x = 0;
  int y = 0;
  ::Window child = 0;
  const ::Window root = attributes.root;
  XTranslateCoordinates(display, window, root, 0, 0, &x, &y, &child);
  XWindowAttributes screen{};
  XGetWindowAttributes(display, root, &screen);
  const Area seen =
      within({x, y, attributes.width, attributes.height}, screen.width, screen.height);
  if (seen.width <= 0 || seen.height <= 0) return {};
  XImage* image = XGetImage(display, root, seen.x, seen.y, unsigned(seen.width),
                            unsigned(seen.height), AllPlanes, ZPixmap);
  if (image == nullptr) return {};
  Screenshot shot(seen.width, seen.height);
  for_each_pixel({0, 0, seen.width, seen.height}, [&](int px, int py) {
    const unsigned long pixel = XGetPixel(image, px, py);
    shot.set(px, py, std::uint8_t(pixel >> 16U), std::uint8_t(pixel >> 8U), std::uint8_t(pixel));
  });
  XDestroyImage(image);
  return shot;
}

std::size_t Screenshot::colors(const Area& area) const {
  std::set<unsigned> seen;
  for_each_pixel(within(area, width_, height_), [&](int x, int y) {
    const std::uint8_t* rgb = at(x, y);
    seen.insert(((rgb[0] & 0xF8U) << 16U) | ((rgb[1] & 0xF8U) << 8U) | (rgb[2] & 0xF8U));
  });
  return seen.size();
}

double Screenshot::brightness(const Area& area) const {
  double sum = 0.0;
  double count = 0.0;
  for_each_pixel(within(area, width_, height_), [&](int x, int y) {
    const std::uint8_t* rgb = at(x, y);
    sum += double(rgb[0]) + double(rgb[1]) + double(rgb[2]);
    count += 3.0;
  });
  return count > 0.0 ? sum / count : 0.0;
}

double Screenshot::edges(const Area& area) const {
  Area inner = within(area, width_, height_);
  inner.width = std::min(inner.width, width_ - 1 - inner.x);
  inner.height = std::min(inner.height, height_ - 1 - inner.y);
  double found = 0.0;
  double count = 0.0;
  for_each_pixel(inner, [&](int x, int y) {
    count += 1.0;
    if (differ(at(x, y), at(x + 1, y)) || differ(at(x, y), at(x, y + 1))) found += 1.0;
  });
  return count > 0.0 ? found / count : 0.0;
}

void Screenshot::keep(const std::string& name) const {
  const char* folder = std::getenv("ENCORE_WINDOW_SHOTS");
  if (folder == nullptr || rgb_.empty()) return;
  std::filesystem::create_directories(folder);
  renderer::write_png(rgb_, width_, height_, std::filesystem::path(folder) / (name + ".png"));
}

double difference(const Screenshot& a, const Screenshot& b, const Area& area) {
  const Area in_a = within(area, a.width(), a.height());
  const Area in_b = within(area, b.width(), b.height());
  const bool whole = in_a.width == area.width && in_a.height == area.height &&
                     in_b.width == area.width && in_b.height == area.height;
  if (!whole || area.width <= 0 || area.height <= 0) return 1.0;
  double found = 0.0;
  for_each_pixel(area, [&](int x, int y) {
    if (differ(a.at(x, y), b.at(x, y))) found += 1.0;
  });
  return found / (double(area.width) * double(area.height));
}

}  // namespace encore::test
