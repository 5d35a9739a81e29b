// The second step of sort.glsl: turns counts into the sums of those before them. A single work
// group, each thread with a row of them.
#define ENCORE_SORT_SCAN
#include "each.glsl"
#include "sort.glsl"

shared uint sums[ENCORE_GROUP_SIZE];

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint count = kSortDigits * sort_blocks();
  uint each = (count + uint(ENCORE_GROUP_SIZE) - 1u) / uint(ENCORE_GROUP_SIZE);
  uint first = min(lane * each, count);
  uint end = min(first + each, count);
  uint sum = 0u;
  for (uint i = first; i < end; ++i) sum += sort_counts[i];
  sums[lane] = sum;
  // Hillis and Steele (1986).
  for (uint step = 1u; step < uint(ENCORE_GROUP_SIZE); step *= 2u) {
    barrier();
    uint before = lane >= step ? sums[lane - step] : 0u;
    barrier();
    sums[lane] += before;
  }
  uint place = sums[lane] - sum;
  for (uint i = first; i < end; ++i) {
    uint here = sort_counts[i];
    sort_counts[i] = place;
    place += here;
  }
}
