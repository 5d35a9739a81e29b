#pragma once

#include "renderer/overlay/overlay_renderer.h"

#include <array>
#include <cstdint>
#include <vector>

namespace encore::test {

using renderer::OverlayItems;
using renderer::OverlayRenderer;
using renderer::OverlayView;

inline constexpr std::uint32_t kBlack = 0xFF000000U;
inline constexpr std::uint32_t kWhite = 0xFFFFFFFFU;
inline constexpr std::uint32_t kRed = 0xFF0000FFU;
inline constexpr std::uint32_t kGreen = 0xFF00FF00U;

/// An overlay's picture in the processor's memory.
struct Codes {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;

  [[nodiscard]] std::array<int, 4> at(int x, int y) const {
    const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x));
    return {rgba[i], rgba[i + 1], rgba[i + 2], rgba[i + 3]};
  }
  [[nodiscard]] int red(int x, int y) const { return at(x, y)[0]; }
  /// How much red there is over all pixels, in codes.
  [[nodiscard]] std::uint64_t red_sum() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) sum += rgba[i];
    return sum;
  }
};

inline Codes drawn(OverlayRenderer& overlay, const OverlayView& view, const OverlayItems& items) {
  overlay.draw(view, items);
  Codes codes{view.width, view.height, {}};
  overlay.read(codes.rgba);
  return codes;
}

/// A view over black.
inline OverlayView black_view(const scene::Camera& camera, int width, int height) {
  OverlayView view;
  view.camera = camera;
  view.width = width;
  view.height = height;
  view.background_rgba = kBlack;
  return view;
}

inline const scene::Camera kCamera{.eye = {0.0F, 0.0F, 3.0F}};

/// Something of every kind, in the middle of kCamera's view.
struct Everything {
  renderer::OverlayQuad quad{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, 0x80FF0000U};
  renderer::OverlaySegment segment{{-1.0F, 0.0F, 0.0F}, {1.0F, 0.3F, 0.0F}, kRed, 2.0F};
  renderer::OverlayPoint point{{0.0F, 0.0F, 0.5F}, kRed, 5.0F};
  renderer::OverlayTriangle triangle{{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0x8000FF00U};
  std::vector<std::uint32_t> boxes = {0};

  [[nodiscard]] renderer::OverlayItems items() const {
    return {.boxes = boxes,
            .quads = std::span(&quad, 1),
            .segments = std::span(&segment, 1),
            .points = std::span(&point, 1),
            .triangles = std::span(&triangle, 1)};
  }
  static renderer::OverlayBox box() { return {glm::vec3(-0.5F), kGreen, glm::vec3(0.5F), 1}; }
};

}  // namespace encore::test
