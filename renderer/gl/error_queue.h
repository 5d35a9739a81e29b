#pragma once

#include <cstdint>
#include <string>

namespace encore::renderer::gl {

/// Forgets the errors that the current context has collected. Returns the first, GL_NO_ERROR if
/// there was none. Ends even where a lost context reports errors for ever.
std::uint32_t discard_errors();

/// "GL_OUT_OF_MEMORY", …
std::string error_name(std::uint32_t error);

/// Why the current context was reset ("guilty": by what it did), empty if it was not or the driver
/// does not tell.
std::string reset_reason();

}  // namespace encore::renderer::gl
