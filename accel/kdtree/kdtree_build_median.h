#pragma once

#include "accel/kdtree/kdtree_builder.h"

namespace encore::accel {

/// Spatial median split (thesis 3.2.1): halves the node's box, the axes taking turns. An axis on
/// which the box is too thin to have a float strictly inside is passed over (a flat scene has one);
/// a box that is too thin on all three becomes a leaf.
class KdMedianSplitter final : public KdSplitter {
 public:
  KdSplit choose(const KdTask& task, std::span<const KdReference> references) override;
};

}  // namespace encore::accel
