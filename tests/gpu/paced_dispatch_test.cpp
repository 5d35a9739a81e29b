// Frames are cut so that no piece keeps a device busy for long, whatever its speed.
#include "renderer/paced_dispatch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

namespace {

using encore::renderer::PacedDispatch;
using encore::renderer::PixelRect;

/// A device that takes a given time for every row and each submission, and a clock that it moves.
class FakeDevice {
 public:
  explicit FakeDevice(double a_row_s, double submission_s = 0.0)
      : row_s(a_row_s), submission_s_(submission_s) {}

  PacedDispatch::Device device() {
    return {.flush = [this] { submit(); },
            .finish =
                [this](const std::string&, double timeout_s) {
                  submit();
                  now_s += busy_s_;
                  longest_wait_allowed = timeout_s;
                  busy_s_ = 0.0;
                  ++waits;
                },
            .now = [this] { return now_s; }};
  }

  /// Runs a frame and expects every row to be covered exactly once, in whole rows of groups.
  void frame(PacedDispatch& dispatch, std::uint64_t key, int width, int height) {
    pieces.clear();
    longest_s = 0.0;
    waits = 0;
    int next = 0;
    dispatch.run(
        key, width, height,
        [&](const PixelRect& piece) {
          EXPECT_EQ(piece.x0, 0);
          EXPECT_EQ(piece.x1, width);
          EXPECT_EQ(piece.y0, next);
          EXPECT_GT(piece.y1, piece.y0);
          EXPECT_EQ(piece.y0 % 8, 0);
          EXPECT_TRUE(piece.y1 % 8 == 0 || piece.y1 == height);
          next = piece.y1;
          pieces.push_back(piece);
          submission_rows_ += piece.height();
        },
        "a test");
    if (dispatch.complete()) {
      EXPECT_EQ(next, height);
    }
    EXPECT_EQ(dispatch.pieces(), static_cast<int>(pieces.size()));
    EXPECT_EQ(submission_rows_, 0) << "something was sent and not waited for";
  }

  double row_s;
  double now_s = 50.0;
  double longest_s = 0.0;  ///< of the frame's submissions
  double longest_wait_allowed = 0.0;
  int waits = 0;
  std::vector<PixelRect> pieces;

 private:
  void submit() {
    const double time_s = submission_s_ + row_s * submission_rows_;
    longest_s = std::max(longest_s, time_s);
    busy_s_ += time_s;
    submission_rows_ = 0;
  }

  double submission_s_;
  double busy_s_ = 0.0;
  int submission_rows_ = 0;
};

TEST(PacedDispatch, CoversEveryRowOnceAtOddSizes) {
  for (const double row_s : {0.0, 1e-5, 1e-3, 0.02, 1.0}) {
    FakeDevice fake(row_s);
    PacedDispatch dispatch(fake.device());
    for (const int height : {1, 7, 8, 9, 53, 480, 1081}) {
      SCOPED_TRACE(height);
      for (int frame = 0; frame < 3; ++frame) {
        fake.frame(dispatch, static_cast<std::uint64_t>(height), 37, height);
      }
    }
  }
}

TEST(PacedDispatch, ASlowDeviceGetsManyShortPieces) {
  FakeDevice fake(0.003);  // 33 rows in a tenth of a second; the frame takes 3.24 s
  PacedDispatch dispatch(fake.device());
  for (int frame = 0; frame < 4; ++frame) {
    fake.frame(dispatch, 1, 1920, 1080);
    EXPECT_LE(fake.longest_s, PacedDispatch::kPieceS * 1.0001);
    EXPECT_GE(fake.pieces.size(), 33U);
    EXPECT_LE(fake.pieces.size(), 70U);
    // Only learning waits for each piece.
    EXPECT_EQ(fake.waits, frame == 0 ? static_cast<int>(fake.pieces.size()) : 1);
  }
  EXPECT_GT(fake.longest_wait_allowed, 3.24);
}

TEST(PacedDispatch, ADeviceTooSlowForAnyPieceGetsTheSmallest) {
  FakeDevice fake(0.5);
  PacedDispatch dispatch(fake.device());
  for (int frame = 0; frame < 2; ++frame) {
    fake.frame(dispatch, 1, 640, 64);
    EXPECT_EQ(fake.pieces.size(), 8U);
  }
}

TEST(PacedDispatch, AFastDeviceGetsWholeFramesOnceThatIsKnown) {
  FakeDevice fake(2e-6, 1e-5);
  PacedDispatch dispatch(fake.device());
  fake.frame(dispatch, 1, 1920, 1080);
  EXPECT_GT(fake.pieces.size(), 1U);
  EXPECT_LT(fake.pieces.size(), 10U);
  for (int frame = 0; frame < 3; ++frame) {
    fake.frame(dispatch, 1, 1920, 1080);
    EXPECT_EQ(fake.pieces.size(), 1U);
    EXPECT_EQ(fake.waits, 1);
  }
}

TEST(PacedDispatch, ADriverThatCompilesInTheFirstPieceIsNotTakenForSlow) {
  FakeDevice fake(1e-5);
  PacedDispatch dispatch(fake.device());
  bool first = true;
  dispatch.run(
      1, 64, 64,
      [&](const PixelRect&) {
        if (first) fake.now_s += 0.2;
        first = false;
      },
      "a test");
  fake.frame(dispatch, 1, 64, 64);
  EXPECT_EQ(fake.pieces.size(), 1U);
}

TEST(PacedDispatch, PiecesOfAFrameAreOfAboutTheSameSize) {
  FakeDevice fake(0.001);  // 96 rows a piece at most
  PacedDispatch dispatch(fake.device());
  for (int frame = 0; frame < 2; ++frame) fake.frame(dispatch, 1, 64, 104);
  ASSERT_EQ(fake.pieces.size(), 2U);
  EXPECT_EQ(fake.pieces[0].height(), 56);
  EXPECT_EQ(fake.pieces[1].height(), 48);
}

TEST(PacedDispatch, AnotherKeyIsLearntAnew) {
  FakeDevice fake(1e-6);
  PacedDispatch dispatch(fake.device());
  for (int frame = 0; frame < 2; ++frame) fake.frame(dispatch, 1, 64, 256);
  EXPECT_EQ(fake.pieces.size(), 1U);
  fake.frame(dispatch, 2, 64, 256);
  EXPECT_GT(fake.pieces.size(), 1U);
  EXPECT_EQ(fake.pieces.front().height(), 8);
}

TEST(PacedDispatch, PiecesFollowWhatTheLastFrameCost) {
  FakeDevice fake(1e-5);
  PacedDispatch dispatch(fake.device());
  for (int frame = 0; frame < 2; ++frame) fake.frame(dispatch, 1, 64, 256);
  EXPECT_EQ(fake.pieces.size(), 1U);
  fake.row_s = 0.004;
  fake.frame(dispatch, 1, 64, 256);
  fake.frame(dispatch, 1, 64, 256);
  EXPECT_LE(fake.longest_s, PacedDispatch::kPieceS);
  fake.row_s = 1e-5;
  fake.frame(dispatch, 1, 64, 256);
  fake.frame(dispatch, 1, 64, 256);
  EXPECT_EQ(fake.pieces.size(), 1U);
}

TEST(PacedDispatch, CancellingSendsNothingMore) {
  for (const int learnt_frames : {0, 2}) {
    FakeDevice fake(0.01);  // 8 rows a piece
    PacedDispatch dispatch(fake.device());
    std::atomic<bool> cancel{false};
    dispatch.set_cancel_flag(&cancel);
    for (int frame = 0; frame < learnt_frames; ++frame) fake.frame(dispatch, 1, 64, 256);
    int pieces = 0;
    dispatch.run(
        1, 64, 256, [&](const PixelRect&) { cancel = ++pieces == 3; }, "a test");
    EXPECT_EQ(pieces, 3);
    EXPECT_EQ(dispatch.pieces(), 3);
    EXPECT_FALSE(dispatch.complete());
    cancel = false;
    fake.frame(dispatch, 1, 64, 256);
    EXPECT_TRUE(dispatch.complete());
    EXPECT_EQ(fake.pieces.size(), 32U);
  }
}

}  // namespace
