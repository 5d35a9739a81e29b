#pragma once

#include "scene/scene.h"

/// The sample scenes that need more than one model, or move, or more than plain materials.
namespace encore::scene::samples {

/// An open box of toys, several of them moving rigidly in one loop of eight seconds; 11,141.
Scene toys();

/// Five models far apart, seen from afar; 98,867 triangles.
Scene still_life();

/// A strongly uneven scene: a dense statue in a huge, coarse hall; 436,942 triangles.
Scene hall();

/// A clearing with trees, mushrooms, a dragon and a rabbit; 679,531 triangles.
Scene forest();

/// A checkered cloth deformed by a travelling wave; 20,000 triangles.
Scene wave();

/// Drops that merge and part; the number of triangles changes from frame to frame.
Scene metaballs();

/// Mirrors, a glass ball and textures over a checkered floor; prefers all kinds of rays.
Scene mirrors();

}  // namespace encore::scene::samples
