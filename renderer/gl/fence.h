#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace encore::renderer::gl {

/// Sends everything given to the device so far and waits until it is done. Throws GlError if that
/// takes longer than `timeout_s`; `doing` says what was waited for.
void finish(const std::string& doing, double timeout_s = 60.0);

/// Reads the device's clock before and after some work, without making the host wait.
/// GL_TIME_ELAPSED is not used: llvmpipe reports 0 for compute shaders, where time stamps are
/// right.
class Timer {
 public:
  /// Does nothing at all where `timestamp_bits` is 0.
  explicit Timer(int timestamp_bits);
  ~Timer();
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  void begin();
  void end();
  /// Seconds between the last begin() and end(); waits for the device if it is not there yet, so
  /// ask after a finish(). Empty if there is no clock, or it ran backwards.
  [[nodiscard]] std::optional<double> seconds() const;

 private:
  std::uint32_t queries_[2] = {0, 0};
};

}  // namespace encore::renderer::gl
