#pragma once

#include "scene/mesh.h"

/// Made things, put together from tessellated shapes. Centred at the origin, longest side 27 units,
/// with normals. The comments name their materials by index.
namespace encore::scene::samples {

/// 604 triangles. 0 steel, 1 grips, 2 rivet.
Mesh scissors();

/// A steering wheel: 1,368 triangles. 0 rim, 1 spokes, 2 hub.
Mesh steering_wheel();

/// 3,450 triangles. 0 glaze, 1 handle.
Mesh mug();

/// 10,474 triangles. 0 paint, 1 glass, 2 tyres, 3 rims, 4 head lamps, 5 tail lamps.
Mesh sports_car();

/// A turned urn; 8,064 triangles. 0 glaze, 1 painted bands.
Mesh urn();

/// A wheel around the z axis: 0 tyre of outer radius 1, 1 hub; 544 triangles.
Mesh road_wheel();

}  // namespace encore::scene::samples
