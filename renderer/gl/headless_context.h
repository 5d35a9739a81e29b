#pragma once

#include "renderer/gl/context.h"
#include "renderer/gl/egl_display.h"

#include <memory>

namespace encore::renderer::gl {

/// A context of the highest OpenGL version that this candidate gives, current in this thread; it
/// may be too old. Throws GlUnavailable with the reason if there is none; what was current before
/// is then current again.
std::shared_ptr<Context> start_headless_context(const EglCandidate& candidate);

}  // namespace encore::renderer::gl
