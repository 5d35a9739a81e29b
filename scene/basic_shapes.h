#pragma once

#include "scene/model.h"

#include <memory>
#include <string_view>
#include <vector>

namespace encore::scene {

/// A sphere of radius 1 around the origin: `slices` around the y axis, `stacks` from pole to pole,
/// 2 * slices * (stacks - 1) triangles, with normals. Texture coordinates are longitude and
/// latitude: a picture goes once around with its middle in front (+z) and its left and right sides
/// meeting at the back, from the south pole (0) to the north pole (1). Bit-identical on every
/// machine.
Model sphere_model(int slices = 64, int stacks = 32);

/// A cube from -1/2 to 1/2, 12 triangles, no normals. Each face wears a whole texture, upright on
/// the four sides.
Model box_model();

/// A square from -1/2 to 1/2 in the plane z = 0, 2 triangles that face +z and wear a whole texture.
Model square_model();

/// The names under which scene files reach these shapes: "sphere", "box", "square".
const std::vector<std::string_view>& basic_shape_names();

/// The shape of that name; null if there is none.
std::shared_ptr<const Model> make_basic_shape(std::string_view name);

}  // namespace encore::scene
