#include "renderer/paced_dispatch.h"

#include "renderer/gl/fence.h"
#include "renderer/trace_defines.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

namespace encore::renderer {

namespace {

// A device that needs longer for a piece that should take kPieceS has most likely hung.
constexpr double kPieceLimitS = 60.0;

int round_up(int rows) {
  return (rows + kTraceGroupHeight - 1) / kTraceGroupHeight * kTraceGroupHeight;
}

/// How many rows that cost so much each, in seconds, fit into a piece: whole rows of work groups.
int rows_that_fit(double row_s) {
  constexpr double kMost = 1 << 24;  // beyond every picture
  const double rows = row_s > 0.0 ? std::min(PacedDispatch::kPieceS / row_s, kMost) : kMost;
  return std::max(static_cast<int>(rows) / kTraceGroupHeight, 1) * kTraceGroupHeight;
}

}  // namespace

PacedDispatch::PacedDispatch()
    : device_{.flush = [] { glFlush(); },
              .finish = [](const std::string& doing,
                           double timeout_s) { gl::finish(doing, timeout_s); },
              .now =
                  [] {
                    const auto time = std::chrono::steady_clock::now().time_since_epoch();
                    return std::chrono::duration<double>(time).count();
                  }} {}

void PacedDispatch::run(std::uint64_t key, int width, int height, const Piece& piece,
                        const std::string& doing) {
  complete_ = true;
  pieces_ = 0;
  if (key != key_) most_rows_ = 0;
  key_ = key;
  if (most_rows_ == 0) {
    learn(width, height, piece, doing);
  } else {
    send(width, height, piece, doing);
  }
}

bool PacedDispatch::cancelled() {
  if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) complete_ = false;
  return !complete_;
}

void PacedDispatch::learn(int width, int height, const Piece& piece, const std::string& doing) {
  int rows = kTraceGroupHeight;
  double first_row_s = 0.0;  // of the first piece, whose time may include the driver's compiling
  double row_s = 0.0;        // of the slowest piece after it
  for (int y = 0; y < height && !cancelled();) {
    const int end = std::min(y + rows, height);
    const double start = device_.now();
    piece({0, y, width, end});
    device_.finish(doing, kPieceLimitS);
    const double piece_s = device_.now() - start;
    if (pieces_++ == 0) {
      first_row_s = piece_s / (end - y);
    } else {
      row_s = std::max(row_s, piece_s / (end - y));
    }
    if (piece_s < kPieceS / 2) {
      rows *= 2;
    } else if (piece_s > kPieceS) {
      rows = std::max(round_up(rows / 2), kTraceGroupHeight);
    }
    y = end;
  }
  // A frame that was cut short says too little of its rest.
  if (complete_) most_rows_ = rows_that_fit(pieces_ > 1 ? row_s : first_row_s);
}

void PacedDispatch::send(int width, int height, const Piece& piece, const std::string& doing) {
  // As few pieces as the limit allows, of about the same size.
  const int pieces = (height + most_rows_ - 1) / most_rows_;
  const int rows = round_up((height + pieces - 1) / pieces);
  const double start = device_.now();
  for (int y = 0; y < height && !cancelled(); y += rows) {
    if (pieces_++ > 0) device_.flush();
    piece({0, y, width, std::min(y + rows, height)});
  }
  device_.finish(doing, kPieceLimitS * std::max(pieces_, 1));
  if (complete_) most_rows_ = rows_that_fit((device_.now() - start) / height);
}

}  // namespace encore::renderer
