#include "scene/scene.h"

#include "scene/motion.h"

#include <algorithm>

namespace encore::scene {

double Scene::duration_s() const {
  double longest = 0.0;
  for (const Instance& instance : instances) {
    longest = std::max(longest, motion_duration_s(instance.motion));
  }
  return longest;
}

bool Scene::animated() const {
  return duration_s() > 0.0;
}

}  // namespace encore::scene
