// A pass of a radix sort by four bits of the keys, from the lowest on (after Satish, Harris and
// Garland 2009): sort_count.comp counts in each block who has which digit, sort_scan.comp says
// where each block's go, sort_scatter.comp puts them there. Equal ones stay in their order. A work
// group a block; each thread has some keys in a row. No extension is needed, and the result is the
// same on every device.
#include "shaders/shared/bindings.h"

const uint kSortDigits = 16u;
const uint kSortEach = 8u;  // keys a thread
const uint kSortBlock = kSortEach * uint(ENCORE_GROUP_SIZE);

uniform uint key_count;
uniform uint shift;  // of the digit

// By digit, then by block.
layout(std430, binding = ENCORE_BINDING_SORT_COUNTS) restrict buffer SortCounts {
  uint sort_counts[];
};
#ifndef ENCORE_SORT_SCAN
layout(std430, binding = ENCORE_BINDING_SORT_FROM) readonly restrict buffer SortFrom {
  uvec2 sort_from[];
};
#endif

uint sort_blocks() {
  return (key_count + kSortBlock - 1u) / kSortBlock;
}
uint digit_of(uint key) {
  return key >> shift & (kSortDigits - 1u);
}
