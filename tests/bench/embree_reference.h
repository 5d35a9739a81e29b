#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"

#include <memory>
#include <span>

namespace encore::bench {

/// Embree 3 on one thread, one ray at a time, over the same triangles: the reference column.
class EmbreeReference {
 public:
  enum class Quality { low, medium };

  explicit EmbreeReference(Quality quality);
  ~EmbreeReference();

  /// Builds a fresh scene; the triangles must outlive it.
  void build(std::span<const scene::Triangle> triangles);
  /// Builds a scene whose later refit() calls fit its boxes to moved triangles.
  void build_refittable(std::span<const scene::Triangle> triangles);
  void refit(std::span<const scene::Triangle> triangles);
  void intersect(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace encore::bench
