#pragma once

#include "accel/acceleration_structure.h"

#include <string>
#include <vector>

namespace encore::bench {

inline constexpr int kImageSize = 768;  ///< pixels a side, one ray each

/// One scene, made ready to be measured: centred, its longest side 27 units (thesis section 5.2).
struct BenchScene {
  std::string name;
  std::vector<scene::Triangle> triangles;
  std::vector<scene::Triangle> moved;  ///< the same, sheared a little: every vertex differs
  std::vector<scene::Ray> rays;        ///< primary rays of the thesis' camera
};

/// Loads a sample scene or model file. Throws scene::InputError.
BenchScene load_bench_scene(const std::string& name_or_path);

/// The sample scenes whose triangle counts come nearest to 11 k, 69 k, 203 k and 1.09 M, and the
/// Stanford bunny where ENCORE_MODELS (a folder) holds it.
std::vector<std::string> default_bench_scenes();

}  // namespace encore::bench
