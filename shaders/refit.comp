// Fits the boxes of a bounding volume hierarchy to triangles that moved (twin of
// accel/bvh/bvh_refit.cpp). One thread a node: those of leaves take their triangle's box and climb;
// of two siblings the first to arrive stops, the second finds both done and fits their parent.
//
// ENCORE_UPDATE_REAL     leaves whose box differs are written, and inner nodes above them as long
//                        as theirs differ too
// ENCORE_UPDATE_BEST     the same, but no leaf is written
// ENCORE_UPDATE_AVERAGE  the leaves whose bit is set are written, and all nodes above them
// ENCORE_UPDATE_WORST    everything is written
#include "each.glsl"
#include "ordered_bits.glsl"
#include "shaders/shared/bindings.h"

// A node is two of these vectors, (min, first) and (max, count); a triangle three, a vertex and
// something else each.
layout(std430, binding = ENCORE_BINDING_NODES) coherent buffer Nodes {
  uvec4 nodes[];
};
layout(std430, binding = ENCORE_BINDING_TRIANGLES) readonly restrict buffer Triangles {
  uvec4 vertices[];
};
layout(std430, binding = ENCORE_BINDING_PARENTS) readonly restrict buffer Parents {
  uint parents[];
};
// Of each pair of siblings, 0 until one of them arrives: then 1, or 3 if it has changed.
layout(std430, binding = ENCORE_BINDING_ARRIVALS) coherent buffer Arrivals {
  uint arrivals[];
};
#ifdef ENCORE_UPDATE_AVERAGE
layout(std430, binding = ENCORE_BINDING_LEAF_WRITES) readonly restrict buffer LeafWrites {
  uint leaf_writes[];
};
#endif

#ifdef ENCORE_UPDATE_BEST
// Always 0, which a compiler cannot know: so it cannot leave out the comparison of the boxes.
uniform uint leaves_to_write;
#endif

bool same(uvec3 a, uvec3 b) {
  return ordered(a.x) == ordered(b.x) && ordered(a.y) == ordered(b.y) &&
         ordered(a.z) == ordered(b.z);
}
bool differs(uint node, uvec3 lower, uvec3 upper) {
  return !same(nodes[2u * node].xyz, lower) || !same(nodes[2u * node + 1u].xyz, upper);
}

void write_box(uint node, uvec3 lower, uvec3 upper) {
  nodes[2u * node].xyz = lower;
  nodes[2u * node + 1u].xyz = upper;
}

// True if the parent must be looked at.
bool fit_leaf(uint node) {
#ifdef ENCORE_UPDATE_AVERAGE
  if ((leaf_writes[node / 32u] & (1u << (node % 32u))) == 0u) return false;
#endif
  uint vertex = 3u * nodes[2u * node].w;
  uvec3 a = vertices[vertex].xyz;
  uvec3 b = vertices[vertex + 1u].xyz;
  uvec3 c = vertices[vertex + 2u].xyz;
  uvec3 lower = lower_of(lower_of(a, b), c);
  uvec3 upper = upper_of(upper_of(a, b), c);
#if defined(ENCORE_UPDATE_REAL) || defined(ENCORE_UPDATE_BEST)
  if (!differs(node, lower, upper)) return false;
#endif
#ifdef ENCORE_UPDATE_BEST
  if (leaves_to_write == 0u) return false;
#endif
  write_box(node, lower, upper);
  return true;
}

// The same for a node whose children, one of which has changed, are done.
bool fit_inner(uint node) {
  uint first = nodes[2u * node].w;
  uvec3 lower = lower_of(nodes[2u * first].xyz, nodes[2u * first + 2u].xyz);
  uvec3 upper = upper_of(nodes[2u * first + 1u].xyz, nodes[2u * first + 3u].xyz);
#if defined(ENCORE_UPDATE_REAL) || defined(ENCORE_UPDATE_BEST)
  if (!differs(node, lower, upper)) return false;
#endif
  write_box(node, lower, upper);
  return true;
}

void main() {
  uint node = thread_index();
  if (node >= thread_count || nodes[2u * node + 1u].w == 0u) return;
  bool changed = fit_leaf(node);
  while (node != 0u) {
    uint pair = (node + 1u) / 2u;
    memoryBarrierBuffer();  // the box before the arrival
    uint arrived = atomicAdd(arrivals[pair], changed ? 3u : 1u);
    if (arrived == 0u) return;
    memoryBarrierBuffer();  // the arrival before the sibling's box
    changed = changed || arrived == 3u;
    node = parents[pair];
    changed = changed && fit_inner(node);
  }
}
