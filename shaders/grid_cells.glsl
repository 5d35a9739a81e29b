// The cells of a grid and their planes (twin of accel/grid/grid_layout.h), and the triangles of the
// cell that the ray is in.
#include "counters.glsl"
#include "pausing.glsl"
#include "triangle_filter.glsl"

uint cell_reference;  // what is left of the cell
uint cell_reference_end;

// Where an axis' planes begin among the cell planes.
uint first_plane(int axis) {
  return axis == 0 ? 0u : axis == 1 ? structure.first_plane_y : structure.first_plane_z;
}

// From a cell's index to that of the next one along an axis.
uint cell_stride(int axis) {
  return axis == 0 ? 1u
       : axis == 1 ? structure.cells.x
                   : structure.cells.x * structure.cells.y;
}

// The cell of a coordinate along an axis; those outside belong to the nearest. Stored planes are
// the smallest floats of the cell above them, so comparing with them is exact; the guess only
// saves steps.
uint cell_of(int axis, float x) {
  uint last = structure.cells[axis] - 1u;
  if (last == 0u) return 0u;
  uint plane = first_plane(axis);
  float low = structure.min[axis];
  float guess = (x - low) / (structure.max[axis] - low) * float(last + 1u);
  uint i = guess > 0.0 ? min(uint(min(guess, float(last))), last) : 0u;
  while (i > 0u && cell_planes[plane + i] > x) {
    ENCORE_SPEND;
    --i;
  }
  while (i < last && cell_planes[plane + i + 1u] <= x) {
    ENCORE_SPEND;
    ++i;
  }
  return i;
}

void enter_cell(uint cell) {
  ENCORE_COUNT_STEP;
  cell_reference = cell_starts[cell];
  cell_reference_end = cell_starts[cell + 1u];
  ENCORE_COUNT_TRIANGLE_TESTS(cell_reference_end - cell_reference);
}

// Tests what is left of the cell, or up to the first hit if any will do; false if it paused.
bool finish_cell(Ray ray, PreparedRay prepared, inout Hit hit) {
  while (cell_reference < cell_reference_end) {
    ENCORE_PAUSE_IF_SPENT;
    ENCORE_SPEND;
    test_triangle(ray, prepared, references[cell_reference], hit);
    ENCORE_END_IF_HIT;
    ++cell_reference;
  }
  return true;
}
