// The hierarchy over sorted Morton codes (Karras 2012): a binary radix tree, each inner node of
// which one thread finds on its own. Equal codes are told apart by their places, so no path is
// longer than 30 bits and those of a place. The children of inner node i lie at 2i + 1 and 2i + 2;
// every leaf is of one triangle. Boxes are fitted afterwards (refit.comp).
#include "each.glsl"
#include "shaders/shared/bindings.h"

uniform uint leaf_count;

layout(std430, binding = ENCORE_BINDING_SORT_FROM) readonly restrict buffer Keys {
  uvec2 keys[];
};
// A gpu::BvhNode is two of these vectors, (min, first) and (max, count).
layout(std430, binding = ENCORE_BINDING_NODES) writeonly restrict buffer Nodes {
  uvec4 nodes[];
};
layout(std430, binding = ENCORE_BINDING_PARENTS) writeonly restrict buffer Parents {
  uint parents[];
};

void write_leaf(uint node, int leaf) {
  nodes[2u * node] = uvec4(0u, 0u, 0u, keys[leaf].y);
  nodes[2u * node + 1u] = uvec4(0u, 0u, 0u, 1u);
}

void write_inner(uint node, int inner) {
  nodes[2u * node] = uvec4(0u, 0u, 0u, 2u * uint(inner) + 1u);
  nodes[2u * node + 1u] = uvec4(0u);
  parents[inner + 1] = node;
}

// How many bits from the highest on two leaves have in common; -1 where there is no second.
int common_bits(int leaf, int other) {
  if (other < 0 || other >= int(leaf_count)) return -1;
  uint difference = keys[leaf].x ^ keys[other].x;
  if (difference != 0u) return 31 - findMSB(difference);
  return 63 - findMSB(uint(leaf ^ other));
}

void main() {
  uint index = thread_index();
  if (index >= thread_count) return;
  int inner = int(index);
  if (leaf_count == 1u) {
    write_leaf(0u, 0);
    return;
  }
  if (inner == 0) write_inner(0u, 0);
  // Leaf `inner` is one end of the node's range, which goes on to where more bits are in common.
  int way = common_bits(inner, inner + 1) > common_bits(inner, inner - 1) ? 1 : -1;
  int outside = common_bits(inner, inner - way);
  int most = 2;
  while (common_bits(inner, inner + most * way) > outside) most *= 2;
  int size = 0;
  for (int step = most / 2; step > 0; step /= 2) {
    if (common_bits(inner, inner + (size + step) * way) > outside) size += step;
  }
  int end = inner + size * way;
  // It is split where its leaves first differ.
  int common_to_all = common_bits(inner, end);
  int split = 0;
  int step = size;
  do {
    step = (step + 1) / 2;
    if (common_bits(inner, inner + (split + step) * way) > common_to_all) split += step;
  } while (step > 1);
  int last_left = inner + split * way + min(way, 0);
  uint children = 2u * index + 1u;
  if (min(inner, end) == last_left) {
    write_leaf(children, last_left);
  } else {
    write_inner(children, last_left);
  }
  if (max(inner, end) == last_left + 1) {
    write_leaf(children + 1u, last_left + 1);
  } else {
    write_inner(children + 1u, last_left + 1);
  }
}
