#pragma once

#include "scene/mesh.h"

#include <cstddef>

/// Organic models in place of the thesis' scans: soft sculptures with relief. All stand about the
/// origin, longest side 27 units, seen best from +z, with smooth normals.
namespace encore::scene::samples {

/// A scaly dragon; closed, `triangles` even.
Mesh dragon(std::size_t triangles);

/// A sitting rabbit with fur, open at the bottom as the scanned one is (so any count will do).
Mesh bunny(std::size_t triangles);

/// A smiling figure seated on a lotus, in a robe; closed, `triangles` even. `levels` subdivisions
/// of a coarser sculpture (see finished()).
Mesh sage(std::size_t triangles, int levels);

/// A cow with patches (in vertex colours); closed, `triangles` even.
Mesh cow(std::size_t triangles);

/// A spider; its body (material 0) and eight legs (material 1) are closed; `triangles` even.
Mesh spider(std::size_t triangles);

/// A bath duck; material 0 body, 1 beak, 2 eyes; closed parts, `triangles` even.
Mesh duck(std::size_t triangles);

}  // namespace encore::scene::samples
