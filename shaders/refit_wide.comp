// Fits the boxes of a hierarchy of up to eight children a node to triangles that moved (twin of
// accel/kernels/wide_build_fit.cpp). One thread a child: those of leaves take the box of their
// triangles and climb; of siblings all but the last to arrive stop, which finds them all done and
// fits what their parent holds of their node.
#include "each.glsl"
#include "ordered_bits.glsl"
#include "shaders/shared/bindings.h"
#include "wide_words.glsl"

// Three vectors a triangle, a vertex and something else each.
layout(std430, binding = ENCORE_BINDING_TRIANGLES) readonly restrict buffer Triangles {
  uvec4 vertices[];
};
layout(std430, binding = ENCORE_BINDING_REFERENCES) readonly restrict buffer References {
  uint references[];
};
// Of each node but the root: eight times its parent, and its place there.
layout(std430, binding = ENCORE_BINDING_WIDE_PARENTS) readonly restrict buffer Parents {
  uint parents[];
};
// Of each node, how many of its children are done.
layout(std430, binding = ENCORE_BINDING_ARRIVALS) coherent buffer Arrivals {
  uint arrivals[];
};

// `slot`: eight times a node, and a place there.
void write_box(uint slot, uvec3 lower, uvec3 upper) {
  uint word = kWideWords * (slot / 8u) + slot % 8u;
  uvec3 minus_upper = upper ^ 0x80000000u;
  for (uint axis = 0u; axis < 3u; ++axis) {
    node_words[word + kWideAxisWords * axis] = lower[axis];
    node_words[word + kWideAxisWords * axis + 8u] = minus_upper[axis];
  }
}

void fit_leaf(uint slot, uint leaf) {
  uint first = kWideBlockSize * (leaf & 0x0FFFFFFFu);
  uint end = first + kWideBlockSize * ((leaf >> 28 & 7u) + 1u);
  uint triangle = references[first];
  uvec3 lower = vertices[3u * triangle].xyz;
  uvec3 upper = lower;
  for (uint place = first; place < end; ++place) {
    triangle = references[place];
    for (uint corner = 0u; corner < 3u; ++corner) {
      uvec3 vertex = vertices[3u * triangle + corner].xyz;
      lower = lower_of(lower, vertex);
      upper = upper_of(upper, vertex);
    }
  }
  write_box(slot, lower, upper);
}

// The least of eight words, of which the empty places' are infinite.
uint least_of(uint word) {
  uint least = node_words[word];
  for (uint i = 1u; i < 8u; ++i) least = lower_of(least, node_words[word + i]);
  return least;
}

void fit_inner(uint slot, uint node) {
  uint from = kWideWords * node;
  uint to = kWideWords * (slot / 8u) + slot % 8u;
  for (uint half_axis = 0u; half_axis < 6u; ++half_axis) {
    node_words[to + 8u * half_axis] = least_of(from + 8u * half_axis);
  }
}

uint children_of(uint node) {
  uint count = 0u;
  for (uint i = 0u; i < 8u; ++i) count += wide_child_of(node, i) == kWideNoChild ? 0u : 1u;
  return count;
}

void main() {
  uint slot = thread_index();
  if (slot >= thread_count) return;
  uint node = slot / 8u;
  uint child = wide_child_of(node, slot % 8u);
  if ((child & kWideLeafBit) == 0u || child == kWideNoChild) return;
  fit_leaf(slot, child);
  for (;;) {
    memoryBarrierBuffer();  // the box before the arrival
    if (atomicAdd(arrivals[node], 1u) + 1u < children_of(node)) return;
    memoryBarrierBuffer();  // the arrival before the siblings' boxes
    if (node == 0u) return;
    slot = parents[node];
    fit_inner(slot, node);
    node = slot / 8u;
  }
}
