#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace encore::renderer::gl {

/// A linked shader program.
class Program {
 public:
  /// One stage: the GL enum (GL_COMPUTE_SHADER …), its source, and the names of the files that the
  /// source's #line numbers stand for.
  struct Stage {
    std::uint32_t kind;
    std::string source;
    std::vector<std::string> files;
  };
  /// Compiles and links. `name` leads error messages. Throws GlError with the driver's log.
  Program(const std::string& name, const std::vector<Stage>& stages);
  ~Program();
  Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Program& operator=(Program&&) = delete;

  void use() const;
  [[nodiscard]] std::uint32_t id() const { return id_; }
  /// Sets a uniform of the program; one that the compiler left out is ignored.
  void set(const char* name, int value) const;
  void set(const char* name, unsigned value) const;
  void set(const char* name, int x, int y) const;

 private:
  std::uint32_t id_ = 0;
};

}  // namespace encore::renderer::gl
