#pragma once

#include <stdexcept>

namespace encore::renderer::gl {

/// OpenGL went wrong. what() is the whole message: what is missing or happened, what was found, and
/// the way out.
class GlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// There is no OpenGL here that can be used at all: no library, no device, too old a version.
class GlUnavailable : public GlError {
 public:
  using GlError::GlError;
};

}  // namespace encore::renderer::gl
