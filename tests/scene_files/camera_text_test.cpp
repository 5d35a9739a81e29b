// Cameras as a line of text: copied, edited by hand, pasted.
#include "scene/camera_text.h"

#include "support.h"

#include <bit>
#include <cstdint>
#include <random>

namespace encore::scene::test {
namespace {

std::string paste_error(std::string_view text) {
  return error_of([&] { (void)parse_camera_text(text); });
}

TEST(CameraText, IsALineThatAPersonCanRead) {
  EXPECT_EQ(camera_text({}),
            "camera = { eye = [0, 0, 25], target = [0, 0, 0], up = [0, 1, 0], fov = 90 }");
  EXPECT_EQ(camera_text({.eye = {0.1F, -2.5F, 1e-9F}, .orthographic_height = 12.5F}),
            "camera = { eye = [0.1, -2.5, 1e-09], target = [0, 0, 0], up = [0, 1, 0], "
            "orthographic_height = 12.5 }");
}

TEST(CameraText, IsReadBackBitForBit) {
  std::mt19937 random(11);
  const auto number = [&] {
    for (;;) {
      const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      if (std::isfinite(value) && std::abs(value) <= 1e36F) return value;
    }
  };
  for (int i = 0; i < 3000; ++i) {
    Camera camera{.eye = {number(), number(), number()},
                  .target = {number(), number(), number()},
                  .up = {number(), -0.0F, number()}};
    camera.vertical_fov_degrees = static_cast<float>(1 + random() % 178999) / 1000.0F;
    if (i % 2 == 0) camera.orthographic_height = std::abs(number()) + 1e-30F;
    // What the text does not say is that of the base.
    const Camera base{.vertical_fov_degrees = camera.vertical_fov_degrees};
    const Camera read = parse_camera_text(camera_text(camera), base);
    ASSERT_EQ(read, camera) << camera_text(camera);
    ASSERT_TRUE(std::signbit(read.up.y)) << camera_text(camera);
  }
}

TEST(CameraText, NumbersWhoseShortestTextIsRoundedTwiceAreReadBackToo) {
  // As a double, the shortest text of this float lies on the border to its neighbour.
  const Camera camera{.eye = {7.038531e-26F, 0.0F, 1.0F}};
  EXPECT_EQ(parse_camera_text(camera_text(camera)).eye.x, camera.eye.x);
}

TEST(CameraText, MayStandInASceneFile) {
  const Camera camera{.eye = {1, 2, 3}, .up = {0, 0, 1}, .orthographic_height = 7};
  EXPECT_EQ(parse(camera_text(camera) + "\n").camera, camera);
}

TEST(CameraText, IsAcceptedAsItIsCommonlyPasted) {
  const Camera expected{.eye = {1, 2, 3}, .vertical_fov_degrees = 60};
  for (const char* text :
       {"camera = { eye = [1, 2, 3], fov = 60 }", "  {eye=[1,2,3],fov=60}\n",
        "eye = [1, 2, 3], fov = 60", "[camera]\neye = [1, 2, 3]  # here\nfov = 60\n",
        "eye = [1, 2, 3]\r\nfov = 60\r\n",
        "[camera]\neye = [1, 2, 3]\nfov = 60\n[[light]]\nposition = [0, 0, 0]\n"}) {
    EXPECT_EQ(parse_camera_text(text), expected) << text;
  }
}

TEST(CameraText, ChangesOnlyWhatItNames) {
  const Camera base{.eye = {1, 2, 3}, .vertical_fov_degrees = 40, .orthographic_height = 5};
  const Camera moved = parse_camera_text("eye = [4, 5, 6]", base);
  EXPECT_EQ(moved.eye, glm::vec3(4, 5, 6));
  EXPECT_EQ(moved.orthographic_height, 5.0F);
  EXPECT_EQ(moved.vertical_fov_degrees, 40.0F);
  EXPECT_FALSE(parse_camera_text("fov = 50", base).orthographic());
  EXPECT_EQ(parse_camera_text("orthographic_height = 9", base).vertical_fov_degrees, 40.0F);
}

TEST(CameraText, ErrorsNameWhatIsWrong) {
  const std::string example =
      "; write for example camera = { eye = [0, 0, 25], target = [0, 0, 0], up = [0, 1, 0], fov = "
      "90 }";
  EXPECT_EQ(paste_error("fov = 180"),
            "this is no camera: 'fov' must be greater than 0 and less than 180, not 180" + example);
  EXPECT_EQ(paste_error("eye = [1, 2]"),
            "this is no camera: 'eye' must be an array of 3 numbers, not of 2" + example);
  EXPECT_EQ(paste_error("camera = { eey = [1, 2, 3] }"),
            "this is no camera: unknown key 'eey' in [camera]; did you mean 'eye'?" + example);
  EXPECT_EQ(paste_error("{ target = [0, 0, 25] }"),
            "this is no camera: 'eye' and 'target' of the camera must differ" + example);
  EXPECT_TRUE(contains(paste_error("fov = 60, orthographic_height = 3"), "remove one"));
  EXPECT_TRUE(contains(paste_error("camera = {}"), "names none of eye"));
  EXPECT_TRUE(contains(paste_error("  \n"), "empty"));
  EXPECT_TRUE(contains(paste_error(std::string(20000, 'x')), "20000 characters"));
  for (const char* text : {"hello", "[camera", "eye = [1, 2, 3", "{", "camera", "camera = 3",
                           "eye = [nan, 0, 0]", "eye = [1e300, 0, 0]", "\xff\xfe", "fov = \"a\""}) {
    EXPECT_TRUE(paste_error(text).starts_with("this is no camera: ")) << text;
  }
}

}  // namespace
}  // namespace encore::scene::test
