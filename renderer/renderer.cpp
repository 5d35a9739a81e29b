#include "renderer/renderer.h"

#include <stdexcept>

namespace encore::renderer {

void Tracer::refit() {
  throw std::logic_error("this renderer has no structure of its own to refit");
}

}  // namespace encore::renderer
