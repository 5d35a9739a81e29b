#pragma once

#include "renderer/gl/capabilities.h"
#include "renderer/gl/program_cache.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::renderer::gl {

/// An OpenGL context and what is shared by everything that draws in it. Used by one thread.
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  virtual void make_current() = 0;
  [[nodiscard]] const Capabilities& capabilities() const { return capabilities_; }
  /// Programs already compiled in this context.
  [[nodiscard]] ProgramCache& programs() { return programs_; }

  /// Throws GlError if the driver reset the context (a hung shader, a lost device) or reports an
  /// error; `doing` says what was being done. Costs a call or two; meant for the end of a frame.
  void check(const std::string& doing);

 protected:
  Context() = default;
  Capabilities capabilities_;
  ProgramCache programs_;
};

/// The same context, made current in this thread. Throws std::invalid_argument for none.
std::shared_ptr<Context> made_current(std::shared_ptr<Context> context);

/// Makes a context without a window or display: surfaceless EGL on the machine's devices, hardware
/// before software, else on the default display. `device`: only the device at this place of
/// list_devices(). Throws GlUnavailable if there is none, none is new enough, or none is there.
std::shared_ptr<Context> make_headless_context(std::optional<int> device = std::nullopt);

/// The window's context, which must be current in this thread and outlive the result. Throws
/// GlUnavailable if it is too old.
std::shared_ptr<Context> adopt_current_context();

/// An EGL device as the doctor shows it.
struct DeviceListing {
  int index = 0;        ///< for make_headless_context()
  std::string name;     ///< GL_RENDERER, or what the device says of itself where no context starts
  std::string version;  ///< GL_VERSION
  bool software = false;
  bool usable = false;
  std::string problem;                    ///< why not
  std::uint64_t storage_block_bytes = 0;  ///< as in Capabilities; 0: not known
  int timestamp_bits = 0;                 ///< likewise
};
/// Tries every device; never throws. Empty with `*problem` set if there is no EGL at all.
std::vector<DeviceListing> list_devices(std::string* problem);

}  // namespace encore::renderer::gl
