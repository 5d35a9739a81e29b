#pragma once

#include "energy/session.h"
#include "renderer/gl/context.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// The graphics device in words, for people and files.
struct GpuInfo {
  /// By name, and what it is where it is no GPU: "llvmpipe (LLVM 15.0.6, 256 bits), software, runs
  /// on the CPU".
  std::string name;
  std::string version;    ///< of OpenGL, as the driver says it
  bool software = false;  ///< it runs on the CPU; not kept in sessions
};

/// As settings of a session, and back; nothing where no graphics device took part.
std::vector<energy::KeyValue> gpu_settings(const std::optional<GpuInfo>& gpu);
std::optional<GpuInfo> gpu_of(const energy::SessionInfo& info);

/// The one OpenGL context of a run: made when something first asks for it, shared from then on. A
/// run that draws on the CPU alone makes none. Used by one thread.
class GpuContext {
 public:
  using Maker = std::function<std::shared_ptr<renderer::gl::Context>(std::optional<int>)>;

  /// `device`: its place in `encore doctor`; none: the best there is. Nothing is made yet.
  explicit GpuContext(std::optional<int> device, Maker make = renderer::gl::make_headless_context);

  /// The context, made current. Throws renderer::gl::GlUnavailable.
  std::shared_ptr<renderer::gl::Context> get();
  /// What it runs on; makes it, too.
  GpuInfo info();
  [[nodiscard]] bool made() const { return context_ != nullptr; }

 private:
  std::optional<int> device_;
  Maker make_;
  std::shared_ptr<renderer::gl::Context> context_;
};

/// --gl-device N.
void add_gl_device_option(CLI::App& command, std::optional<int>& device);

}  // namespace encore::app
