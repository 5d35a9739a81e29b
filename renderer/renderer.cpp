#include "renderer/renderer.h"

#include <stdexcept>

namespace encore::renderer {

std::uint64_t RayFigures::rays() const {
  std::uint64_t sum = 0;
  for (const Kind& kind : kinds) sum += kind.rays;
  return sum;
}

std::optional<double> RayFigures::share(scene::RayKind kind) const {
  double sum = 0.0;
  for (const Kind& one : kinds) {
    if (one.rays > 0 && !one.seconds) return std::nullopt;
    sum += one.seconds.value_or(0.0);
  }
  if (!(sum > 0.0)) return std::nullopt;
  return (*this)[kind].seconds.value_or(0.0) / sum;
}

void Tracer::refit() {
  throw std::logic_error("this renderer has no structure of its own to refit");
}

void Tracer::build() {
  throw std::logic_error("this renderer cannot build a structure on its device");
}

}  // namespace encore::renderer
