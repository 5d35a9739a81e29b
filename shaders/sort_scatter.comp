// The third step of sort.glsl.
#include "each.glsl"
#include "sort.glsl"

layout(std430, binding = ENCORE_BINDING_SORT_TO) writeonly restrict buffer SortTo {
  uvec2 sort_to[];
};

// By digit, then by thread: how many keys it has; later how many others come before them.
shared uint places[kSortDigits * uint(ENCORE_GROUP_SIZE)];
shared uint parts[ENCORE_GROUP_SIZE];

void main() {
  const uint kThreads = uint(ENCORE_GROUP_SIZE);
  uint lane = gl_LocalInvocationID.x;
  uint block = group_index();
  uint first = block * kSortBlock + lane * kSortEach;
  for (uint digit = 0u; digit < kSortDigits; ++digit) places[digit * kThreads + lane] = 0u;
  for (uint i = 0u; i < kSortEach; ++i) {
    if (first + i < key_count) ++places[digit_of(sort_from[first + i].x) * kThreads + lane];
  }
  barrier();
  // Each thread takes sixteen counts in a row, which are of one digit.
  uint sum = 0u;
  for (uint i = 0u; i < kSortDigits; ++i) sum += places[lane * kSortDigits + i];
  parts[lane] = sum;
  barrier();
  const uint kPartsOfDigit = kThreads / kSortDigits;
  uint place = 0u;
  for (uint part = lane / kPartsOfDigit * kPartsOfDigit; part < lane; ++part) place += parts[part];
  for (uint i = 0u; i < kSortDigits; ++i) {
    uint here = places[lane * kSortDigits + i];
    places[lane * kSortDigits + i] = place;
    place += here;
  }
  barrier();
  uint blocks = sort_blocks();
  for (uint i = 0u; i < kSortEach; ++i) {
    if (first + i >= key_count) break;
    uvec2 key = sort_from[first + i];
    uint digit = digit_of(key.x);
    uint before = places[digit * kThreads + lane]++;
    sort_to[sort_counts[digit * blocks + block] + before] = key;
  }
}
