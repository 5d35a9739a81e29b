#include "renderer/gl/context.h"

#include "renderer/gl/error.h"
#include "renderer/gl/error_queue.h"
#include "renderer/gl/gl_libraries.h"
#include "renderer/gl/headless_context.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <exception>
#include <stdexcept>
#include <utility>

namespace encore::renderer::gl {

namespace {

class AdoptedContext final : public Context {
 public:
  AdoptedContext() {
    capabilities_ = read_capabilities();
    require_compute(capabilities_);
  }
  /// The window keeps it current in its thread.
  void make_current() override {}
};

/// Throws GlUnavailable with the reason, but no way out, if it is of no use.
std::shared_ptr<Context> start_usable(const EglCandidate& candidate) {
  const EglCurrentGuard before;
  auto context = start_headless_context(candidate);
  const std::string obstacle = compute_obstacle(context->capabilities());
  if (!obstacle.empty()) throw GlUnavailable(obstacle);
  return context;
}

constexpr const char* kWayOut =
    "install the GPU's driver, or libegl-mesa0 and libgl1-mesa-dri (Debian, Ubuntu) for OpenGL in "
    "software, or use --device cpu";

DeviceListing try_candidate(const EglCandidate& candidate, int index) {
  DeviceListing listing;
  listing.index = index;
  listing.name = candidate.name;
  listing.software = candidate.software;
  try {
    const auto context = start_headless_context(candidate);
    const Capabilities& found = context->capabilities();
    listing.name = found.renderer;
    listing.version = found.version;
    listing.software = found.software;
    listing.storage_block_bytes = found.storage_block_bytes;
    listing.timestamp_bits = found.timestamp_bits;
    listing.problem = compute_obstacle(found);
    listing.usable = listing.problem.empty();
  } catch (const std::exception& error) {
    listing.problem = error.what();
  }
  return listing;
}

}  // namespace

std::shared_ptr<Context> made_current(std::shared_ptr<Context> context) {
  if (!context) throw std::invalid_argument("there is no OpenGL context to draw in");
  context->make_current();
  return context;
}

void Context::check(const std::string& doing) {
  const std::string reset = capabilities_.robust ? reset_reason() : std::string();
  const GLenum error = discard_errors();
  if (!reset.empty() || error == GL_CONTEXT_LOST) {
    throw GlError(fmt::format(
        "{}: the graphics driver reset {} and its work is lost ({}); use smaller pictures "
        "(--size), update the driver, or use --device cpu",
        doing, capabilities_.device_name(), reset.empty() ? error_name(error) : reset));
  }
  if (error == GL_OUT_OF_MEMORY) {
    throw GlError(fmt::format(
        "{}: {} has no memory left; close other programs that use it, use a smaller scene or "
        "picture, or --device cpu",
        doing, capabilities_.device_name()));
  }
  if (error != GL_NO_ERROR) {
    throw GlError(
        fmt::format("{}: {} (OpenGL {}) reports {}; update the driver or use --device cpu", doing,
                    capabilities_.device_name(), capabilities_.version, error_name(error)));
  }
}

std::shared_ptr<Context> make_headless_context(std::optional<int> device) {
  const auto candidates = egl_candidates();
  const auto count = static_cast<int>(candidates.size());
  if (device && (*device < 0 || *device >= count)) {
    throw GlUnavailable(fmt::format(
        "there is no OpenGL device {}; 'encore doctor' lists those that there are", *device));
  }
  std::vector<std::string> reasons;
  for (int i = device.value_or(0); i < (device ? *device + 1 : count); ++i) {
    const EglCandidate& candidate = candidates[static_cast<std::size_t>(i)];
    try {
      auto context = start_usable(candidate);
      context->make_current();
      return context;
    } catch (const GlUnavailable& error) {
      reasons.push_back(fmt::format("{}: {}", candidate.name, error.what()));
    }
  }
  if (device)
    throw GlUnavailable(fmt::format("OpenGL device {}, {}; {}", *device, reasons.at(0), kWayOut));
  throw GlUnavailable(fmt::format("there is no usable OpenGL device; {}. Tried:\n  {}", kWayOut,
                                  fmt::join(reasons, "\n  ")));
}

std::shared_ptr<Context> adopt_current_context() {
  require_gl_libraries(false);
  return std::make_shared<AdoptedContext>();
}

std::vector<DeviceListing> list_devices(std::string* problem) {
  std::vector<DeviceListing> devices;
  try {
    const auto candidates = egl_candidates();
    const EglCurrentGuard before;
    bool device_starts = false;
    for (const EglCandidate& candidate : candidates) {
      // The other ways lead to the same devices again.
      if (candidate.kind != EglCandidate::Kind::device && device_starts) break;
      devices.push_back(try_candidate(candidate, static_cast<int>(devices.size())));
      device_starts = device_starts || !devices.back().version.empty();
    }
  } catch (const std::exception& error) {
    if (problem != nullptr) *problem = error.what();
  }
  return devices;
}

}  // namespace encore::renderer::gl
