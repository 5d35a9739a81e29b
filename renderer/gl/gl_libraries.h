#pragma once

namespace encore::renderer::gl {

/// Throws GlUnavailable, with the packages to install, unless the system's OpenGL library (and
/// EGL's, `with_egl`) can be loaded. Call it before the first OpenGL or EGL call: libepoxy ends the
/// process where it finds no library.
void require_gl_libraries(bool with_egl);

}  // namespace encore::renderer::gl
