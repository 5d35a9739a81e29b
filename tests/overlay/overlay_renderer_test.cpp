// What an overlay sends, draws and refuses.

#include "renderer/overlay/overlay_renderer.h"

#include "renderer/gl/error.h"
#include "renderer/image_io.h"
#include "renderer/overlay/screen_texture.h"
#include "tests/overlay/overlay_pictures.h"
#include "tests/support/gl_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::OverlayBox;
using renderer::OverlayRenderer;
using renderer::OverlayView;
using renderer::ScreenTexture;
using test::Codes;
using test::drawn;
using test::Everything;
using test::kCamera;
using test::kGreen;
using test::kRed;
using OverlayRendererTest = test::GlTest;

TEST_F(OverlayRendererTest, AMillionBoxesAreSentOnceAndDrawnByIndex) {
  constexpr std::uint32_t kSide = 100;
  std::vector<OverlayBox> boxes;
  boxes.reserve(kSide * kSide * kSide);
  for (std::uint32_t i = 0; i < kSide * kSide * kSide; ++i) {
    const glm::vec3 low(i % kSide, i / kSide % kSide, i / kSide / kSide);
    boxes.push_back({low, kRed, low + 0.5F, 0});
  }
  OverlayRenderer overlay(context_);
  overlay.set_boxes(boxes, 3);
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < 20000; ++i) chosen.push_back(i * 50);
  OverlayView view =
      test::black_view({.eye = {50.0F, 50.0F, 300.0F}, .target = {50, 50, 50}}, 64, 64);
  const Codes codes = drawn(overlay, view, {.boxes = chosen});
  EXPECT_GT(codes.red_sum(), 10000U);
  EXPECT_EQ(overlay.last().boxes, 20000U);
  EXPECT_GE(overlay.last().uploaded_bytes, boxes.size() * sizeof(OverlayBox));

  view.camera.eye.x += 1.0F;
  overlay.set_boxes(boxes, 3);
  drawn(overlay, view, {.boxes = chosen});
  EXPECT_LE(overlay.last().uploaded_bytes, 20000 * sizeof(std::uint32_t) + 256);

  // Other colours alone: four bytes a box.
  const std::vector<std::uint32_t> green(boxes.size(), kGreen);
  overlay.set_box_colors(green, 1);
  const Codes recolored = drawn(overlay, view, {.boxes = chosen});
  EXPECT_EQ(recolored.red_sum(), 0U);
  EXPECT_LE(overlay.last().uploaded_bytes, 4 * boxes.size() + 20000 * sizeof(std::uint32_t) + 256);
  overlay.set_box_colors(green, 1);
  drawn(overlay, view, {.boxes = {}});
  EXPECT_LE(overlay.last().uploaded_bytes, 256U);
}

TEST_F(OverlayRendererTest, OnlyTheBoxesOfTheIndicesAreDrawnInTheirOrder) {
  OverlayRenderer overlay(context_);
  std::vector<OverlayBox> boxes = {Everything::box(), Everything::box(), Everything::box()};
  boxes[0].rgba = kRed;
  boxes[2].rgba = 0xFFFF0000U;
  overlay.set_boxes(boxes, 1);
  OverlayView view = test::black_view(kCamera, 20, 20);
  view.fill_opacity = 1.0F;
  view.edge_px = 0.0F;
  for (const auto& [order, channel] : {std::pair{std::vector<std::uint32_t>{0, 1}, 1},
                                       {std::vector<std::uint32_t>{1, 0}, 0},
                                       {std::vector<std::uint32_t>{1, 0, 2}, 2}}) {
    const auto center = drawn(overlay, view, {.boxes = order}).at(10, 10);
    EXPECT_EQ(center[static_cast<std::size_t>(channel)], 255);
    EXPECT_EQ(center[0] + center[1] + center[2], 255);
  }
}

TEST_F(OverlayRendererTest, FlagsChooseFilledAndBoldBoxes) {
  OverlayRenderer overlay(context_);
  OverlayBox box{glm::vec3(-0.5F), kRed, glm::vec3(0.5F), 0};
  const std::vector<std::uint32_t> first = {0};
  OverlayView view = test::black_view(kCamera, 40, 40);
  view.fill_opacity = 0.5F;
  overlay.set_boxes(std::span(&box, 1), 1);
  const Codes thin = drawn(overlay, view, {.boxes = first});
  EXPECT_EQ(thin.red(20, 20), 0);
  view.fill_all = true;
  // Two faces of half the opacity, one behind the other.
  EXPECT_NEAR(drawn(overlay, view, {.boxes = first}).red(20, 20), 191, 2);
  view.fill_all = false;
  box.flags = renderer::kOverlayBoxFilled;
  overlay.set_boxes(std::span(&box, 1), 2);
  EXPECT_NEAR(drawn(overlay, view, {.boxes = first}).red(20, 20), 191, 2);
  box.flags = renderer::kOverlayBoxBold;
  overlay.set_boxes(std::span(&box, 1), 3);
  EXPECT_GT(drawn(overlay, view, {.boxes = first}).red_sum(), thin.red_sum() * 3 / 2);
}

TEST_F(OverlayRendererTest, NothingAtAllIsThePlainBackground) {
  OverlayRenderer overlay(context_);
  EXPECT_EQ(overlay.texture(), 0U);
  std::vector<std::uint8_t> rgba;
  EXPECT_THROW(overlay.read(rgba), std::logic_error);
  overlay.set_boxes({}, 1);
  OverlayView view = test::black_view(kCamera, 7, 5);
  view.background_rgba = 0x00102030U;
  const Codes codes = drawn(overlay, view, {});
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) EXPECT_EQ(codes.at(x, y), (std::array{0x30, 0x20, 0x10, 255}));
  }
}

TEST_F(OverlayRendererTest, ThePictureBelowIsShownAsItIs) {
  ScreenTexture below(context_);
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 4 * 12 * 9; ++i) pixels.push_back(static_cast<std::uint8_t>(37 * i % 251));
  below.upload(pixels, 12, 9);
  OverlayRenderer overlay(context_);
  OverlayView view = test::black_view(kCamera, 12, 9);
  view.background_texture = below.texture();
  Codes codes = drawn(overlay, view, {});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    ASSERT_EQ(codes.rgba[i], i % 4 == 3 ? 255 : pixels[i]) << i;
  }
  // Of another size: every pixel takes what is at its place.
  view.width = 24;
  view.height = 18;
  codes = drawn(overlay, view, {});
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 24; ++x) {
      const auto i = static_cast<std::size_t>(4 * (y / 2 * 12 + x / 2));
      ASSERT_EQ(codes.red(x, y), pixels[i]) << x << ", " << y;
    }
  }
}

TEST_F(OverlayRendererTest, LinearPicturesBelowAreCoded) {
  constexpr std::array<float, 12> kValues = {0.0F, 0.002F, 0.01F, 0.5F, 1.0F, 3.0F,
                                             0.2F, 0.7F,   -1.0F, 0.1F, 0.9F, 0.05F};
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 4, 1);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 4, 1, GL_RGB, GL_FLOAT, kValues.data());
  glBindTexture(GL_TEXTURE_2D, 0);
  OverlayRenderer overlay(context_);
  OverlayView view = test::black_view(kCamera, 4, 1);
  view.background_texture = texture;
  view.background_is_linear = true;
  const Codes codes = drawn(overlay, view, {});
  for (std::size_t i = 0; i < kValues.size(); ++i) {
    EXPECT_NEAR(codes.rgba[4 * (i / 3) + i % 3], renderer::to_srgb8(kValues[i]), 1) << i;
  }
  glDeleteTextures(1, &texture);
}

TEST_F(OverlayRendererTest, SizesChangeAndBadRequestsAreRefused) {
  OverlayRenderer overlay(context_);
  const Everything all;
  const OverlayBox box = Everything::box();
  overlay.set_boxes(std::span(&box, 1), 1);
  // There and back: names of textures may come again.
  for (const auto& [width, height] :
       {std::pair{16, 16}, {40, 9}, {16, 16}, {1, 1}, {200, 100}, {16, 16}}) {
    const Codes codes = drawn(overlay, test::black_view(kCamera, width, height), all.items());
    EXPECT_GT(codes.red_sum(), 0U) << width << " x " << height;
  }
  const auto refused = [&](OverlayView view) {
    EXPECT_THROW(overlay.draw(view, all.items()), std::invalid_argument);
  };
  const OverlayView good = test::black_view(kCamera, 16, 16);
  OverlayView bad = good;
  bad.width = 0;
  refused(bad);
  bad = good;
  bad.height = -3;
  refused(bad);
  bad = good;
  bad.edge_px = std::nanf("");
  refused(bad);
  bad = good;
  bad.section_plane = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
  refused(bad);
  bad = good;
  bad.camera.target = bad.camera.eye;
  refused(bad);
  const std::vector<std::uint32_t> beyond = {0, 1};
  EXPECT_THROW(overlay.draw(good, {.boxes = beyond}), std::invalid_argument);
  EXPECT_THROW(overlay.set_box_colors(beyond, 9), std::invalid_argument);
  EXPECT_THROW(overlay.set_depth(std::vector<float>(3), 2, 2), std::invalid_argument);
  EXPECT_THROW(overlay.set_depth(std::span<const float>(), 0, 0), std::invalid_argument);
  bad = good;
  bad.width = context_->capabilities().texture_size + 1;
  EXPECT_THROW(overlay.draw(bad, all.items()), renderer::gl::GlError);
  EXPECT_THROW(OverlayRenderer(nullptr), std::invalid_argument);
  EXPECT_GT(drawn(overlay, good, all.items()).red_sum(), 0U) << "and it goes on";
}

TEST_F(OverlayRendererTest, AnImageOfItGivesTheSameCodes) {
  const Everything all;
  const OverlayBox box = Everything::box();
  OverlayRenderer overlay(context_);
  overlay.set_boxes(std::span(&box, 1), 1);
  const Codes codes = drawn(overlay, test::black_view(kCamera, 24, 16), all.items());
  renderer::Image image;
  overlay.read(image);
  ASSERT_EQ(image.width, 24);
  ASSERT_EQ(image.height, 16);
  std::vector<std::uint8_t> again(codes.rgba.size());
  renderer::picture_to_rgba8(image, again);
  EXPECT_EQ(again, codes.rgba);
}

}  // namespace
