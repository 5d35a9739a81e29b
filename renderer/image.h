#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace encore::renderer {

/// A picture in linear RGB, row by row from the top left.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;

  void resize(int new_width, int new_height) {
    width = new_width;
    height = new_height;
    pixels.resize(static_cast<std::size_t>(new_width) * static_cast<std::size_t>(new_height));
  }
};

}  // namespace encore::renderer
