#pragma once

#include "accel/wide/wide_tree.h"

namespace encore::accel {

/// Orders the children of the uppermost nodes for rays that take any hit, which go on with the last
/// child that they meet: large boxes come after small ones (Nah and Manocha 2014), and leaves,
/// which so high up are triangles that hide much of the scene, after all nodes. Order does not
/// matter to any other ray.
void order_wide_children(WideTree& tree);

}  // namespace encore::accel
