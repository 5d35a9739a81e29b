#pragma once

#include "renderer/gl/program.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace encore::renderer::gl {

/// The programs of one context, each compiled once for every set of defines.
class ProgramCache {
 public:
  /// The compute program of this file (below shaders/) and these defines, in any order. Throws
  /// GlError with the compiler's log.
  std::shared_ptr<Program> compute(std::string_view file, std::vector<std::string> defines);
  /// Likewise of a vertex and a fragment shader.
  std::shared_ptr<Program> graphics(std::string_view vertex_file, std::string_view fragment_file,
                                    std::vector<std::string> defines);

  [[nodiscard]] std::size_t compiled() const { return programs_.size(); }

 private:
  std::map<std::string, std::shared_ptr<Program>> programs_;
};

}  // namespace encore::renderer::gl
