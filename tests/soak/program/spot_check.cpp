#include "tests/soak/program/spot_check.h"

#include "accel/verify.h"
#include "app/hit_difference.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace encore::test {

namespace {

using accel::IntersectionMode;
using scene::Hit;
using scene::Ray;

std::string text(const Hit& hit) {
  return hit.found() ? fmt::format("triangle {} at {}", hit.triangle, hit.t) : "nothing";
}

bool same_single_precision_hit(const Hit& expected, const Hit& found) {
  if (expected.triangle != found.triangle) return false;
  return !expected.found() ||
         std::fabs(expected.t - found.t) <= accel::kModeDistance * std::fabs(expected.t);
}

}  // namespace

SpotCheck::SpotCheck(std::span<const scene::Triangle> triangles) : triangles_(triangles) {
  precise_.build(triangles);
  loose_.build(triangles);
  loose_.set_intersection(IntersectionMode::moller_trumbore);
}

bool SpotCheck::is_a_hit(const Ray& ray, const Hit& found) const {
  if (found.triangle >= triangles_.size()) return false;
  accel::BruteForce alone;
  alone.build(triangles_.subspan(found.triangle, 1));
  Hit hit;
  alone.intersect({&ray, 1}, {&hit, 1});
  return hit.found() && std::fabs(hit.t - found.t) <= accel::kModeDistance * std::fabs(hit.t);
}

bool SpotCheck::right(const Ray& ray, const Hit& expected, const Hit& found,
                      const Source& source) const {
  if (std::memcmp(&expected, &found, sizeof(Hit)) == 0) return true;
  if (source.outdated) {
    return !found.found() || (expected.found() && is_a_hit(ray, found) &&
                              found.t >= expected.t * (1.0F - accel::kModeDistance));
  }
  if (source.mode == IntersectionMode::watertight && same_single_precision_hit(expected, found)) {
    return true;
  }
  return source.on_device &&
         app::explain_difference(triangles_, ray, expected, found).explanation !=
             app::Explanation::none;
}

void SpotCheck::check(std::span<const Ray> rays, std::span<const Hit> found, const Source& source,
                      SpotCheckTally& tally) {
  const bool loose = source.mode == IntersectionMode::moller_trumbore;
  expected_.resize(rays.size());
  (loose ? loose_ : precise_).intersect(rays, expected_);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    tally.rays += 1;
    tally.hits += expected_[i].found() ? 1 : 0;
    if (loose) {
      // An outdated structure overlooks triangles by rights.
      if (source.outdated) continue;
      tally.loose += 1;
      tally.loose_differing += expected_[i].triangle != found[i].triangle ? 1 : 0;
      continue;
    }
    if (right(rays[i], expected_[i], found[i], source)) continue;
    if (tally.wrong++ == 0) {
      tally.first_wrong = fmt::format("{}: ray {} should find {}, found {}", source.name, i,
                                      text(expected_[i]), text(found[i]));
    }
  }
}

}  // namespace encore::test
