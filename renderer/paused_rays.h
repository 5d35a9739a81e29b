#pragma once

#include "renderer/camera_rays.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"

#include <cstdint>
#include <functional>

namespace encore::renderer {

/// The two programs that trace the same rays on a device that ends a shader's loops early.
struct PausingPrograms {
  const gl::Program* first = nullptr;  ///< in which long rays give up
  /// The one in which they pause and go on (ENCORE_RESUMABLE), ready to be sent; asked for only if
  /// there are such rays.
  std::function<const gl::Program&()> resumable;
};

/// The host's part of shaders/pausing.glsl: sends a piece of a picture again until none of its rays
/// is left. Waits for the device each time.
class PausedRays {
 public:
  /// After how many rounds of its loops a ray is to pause. Mesa's software rasterisers end all
  /// loops of an invocation's group after 65,535 rounds of any of its (at most 16) members, each of
  /// which may go on for less than 2,000 rounds before it finds a place to pause.
  static constexpr std::uint32_t kPauseAfter = 2048;

  /// Sends a part of a piece with a program, which it has to put into use.
  using Send = std::function<void(const gl::Program&, const PixelRect&)>;

  /// Traces the rays of a piece of a picture of that width. `words`: what a paused ray needs, in
  /// 32-bit words; `most`: bytes of the largest storage buffer.
  void run(const PausingPrograms& programs, const PixelRect& piece, int width, std::uint32_t words,
           std::uint64_t most, const Send& send);

 private:
  /// Returns how many rays are left.
  std::uint32_t send_once(const gl::Program& program, const PixelRect& part, int first_slot,
                          const Send& send);

  std::uint32_t words_ = 0;
  gl::Buffer slots_{"the rays that have paused"};
  gl::Buffer count_{"the number of rays that have paused"};
};

}  // namespace encore::renderer
