#pragma once

#include "renderer/camera_rays.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace encore::renderer {

/// Sends a frame to the device in pieces (bands of rows), so that none keeps it busy for longer
/// than a driver's watchdog allows (2 s by default on Windows, 10 s on some Linux drivers).
///
/// How many rows a piece may have is learnt: the first frame of a program and size starts with a
/// few rows and waits for each piece, doubling while pieces stay short; later frames are cut by
/// what the last one took and sent without waiting in between. Most frames are one piece.
class PacedDispatch {
 public:
  /// How long a piece should take at most. Far below any watchdog's limit, as some rows of a
  /// picture cost many times the average; far above what a submission costs.
  static constexpr double kPieceS = 0.1;

  /// The device and the time as this class sees them; replaced by tests.
  struct Device {
    std::function<void()>
        flush;  ///< starts what was given to the device as a submission of its own
    std::function<void(const std::string& doing, double timeout_s)> finish;  ///< and waits for it
    std::function<double()> now;                                             ///< in seconds
  };
  /// The current OpenGL context and the steady clock.
  PacedDispatch();
  explicit PacedDispatch(Device device) : device_(std::move(device)) {}

  /// Sends a frame of width x height pixels: calls `piece` for bands that cover it from top to
  /// bottom, and returns when the device has done them all. `key` identifies what is being run (the
  /// program, the size): another key means learning anew. Throws GlError if a piece takes longer
  /// than the limit; `doing` is for that message.
  void run(std::uint64_t key, int width, int height,
           const std::function<void(const PixelRect&)>& piece, const std::string& doing);

  /// Pieces that have not been sent when `*flag` turns true are not; null: never.
  void set_cancel_flag(const std::atomic<bool>* flag) { cancel_ = flag; }
  [[nodiscard]] bool complete() const { return complete_; }
  /// Pieces of the last frame.
  [[nodiscard]] int pieces() const { return pieces_; }

 private:
  using Piece = std::function<void(const PixelRect&)>;
  [[nodiscard]] bool cancelled();
  void learn(int width, int height, const Piece& piece, const std::string& doing);
  void send(int width, int height, const Piece& piece, const std::string& doing);

  Device device_;
  const std::atomic<bool>* cancel_ = nullptr;
  bool complete_ = true;
  std::uint64_t key_ = 0;
  int most_rows_ = 0;  ///< of a piece, as learnt; 0: not yet
  int pieces_ = 0;
};

}  // namespace encore::renderer
