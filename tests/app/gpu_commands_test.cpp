// Drawing and verifying on the graphics device, as a user meets it.
#include "run_program.h"
#include "tests/support/files.h"
#include "tests/support/gl_devices.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace encore::app {
namespace {

using test::contains;

/// Skips aloud where there is no OpenGL to test with.
class GpuCommands : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string why = test::why_no_gl_device();
    if (!why.empty()) GTEST_SKIP() << why;
  }
  test::TemporaryFolder folder_;
};

TEST_F(GpuCommands, VerifyHoldsTheGpuToTheCpuInSmallScenes) {
  const std::filesystem::path images = folder_.path() / "images";
  const ProgramResult result =
      run_encore({"verify", "triangle", "mug", "--device", "gpu", "--size", "48", "--rays", "100",
                  "--structure", "bvh-median,kd-sah", "--images", images});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(result.out.starts_with("GPU: ")) << result.out;
  EXPECT_TRUE(contains(result.out, " 0 differ, 0 unexplained")) << result.out;
  EXPECT_TRUE(contains(result.err, "1e-07 to 1")) << result.err;
  for (const char* name : {"triangle-bvh-median", "triangle-kd-sah", "mug-kd-sah"}) {
    for (const char* end : {"-cpu.png", "-gpu.png", "-difference.png"}) {
      EXPECT_TRUE(test::contents_of(images / (std::string(name) + end)).starts_with("\x89PNG"))
          << name << end;
    }
  }
}

TEST_F(GpuCommands, VerifyOfBothDevicesIsOneJsonArray) {
  const ProgramResult result =
      run_encore({"verify", "triangle", "--device", "cpu,gpu", "--size", "16", "--rays", "20",
                  "--structure", "bvh-median", "--json", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(result.out.starts_with("[\n") && result.out.ends_with("\n]\n")) << result.out;
  for (const char* part : {"\"device\": \"cpu\"", "\"device\": \"gpu\"", "\"device_name\": \"",
                           "\"pixels\": 256", "\"first_mismatch\": null", "\"passed\": true"}) {
    EXPECT_TRUE(contains(result.out, part)) << part << "\n" << result.out;
  }
  EXPECT_TRUE(result.err.empty()) << result.err;
}

TEST_F(GpuCommands, ScenesAboveTheLimitAreLeftOutAloud) {
  const ProgramResult result = run_encore({"verify", "triangle", "mug", "--device", "gpu", "--size",
                                           "8", "--rays", "5", "--max-triangles", "100"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "mug left out: 3450 triangles")) << result.err;
  EXPECT_FALSE(contains(result.out, "mug")) << result.out;
}

TEST_F(GpuCommands, RenderDrawsOnTheGpuAndComparesWithTheCpu) {
  const std::filesystem::path file = folder_.path() / "gpu.png";
  const std::filesystem::path difference = folder_.path() / "difference.png";
  const ProgramResult result =
      run_encore({"render", "mug", "--device", "gpu", "--size", "64", "--out", file, "--compare",
                  "cpu", "--difference", difference});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"by the GPU (", "bvh-median, build ", "sent ", "after one warm-up frame",
                           "against the CPU", "RMSE ", "hits differ in 0", "1e-07 to 1"}) {
    EXPECT_TRUE(contains(result.err, part)) << part << "\n" << result.err;
  }
  EXPECT_TRUE(test::contents_of(file).starts_with("\x89PNG"));
  EXPECT_TRUE(test::contents_of(difference).starts_with("\x89PNG"));
}

TEST_F(GpuCommands, RenderReportsTheDeviceAsJson) {
  const std::filesystem::path file = folder_.path() / "gpu.png";
  const ProgramResult result = run_encore(
      {"render", "mug", "--device", "gpu", "--size", "64", "--out", file, "--json", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"\"device\": \"gpu\"", "\"device_name\": \"", "\"transfer_bytes\": ",
                           "\"warm_up_ms\": ", "\"threads\": null", "\"comparison\": null"}) {
    EXPECT_TRUE(contains(result.out, part)) << part << "\n" << result.out;
  }
  EXPECT_FALSE(contains(result.out, "\"transfer_ms\": null")) << result.out;
}

TEST_F(GpuCommands, HeatmapsComeFromTheGpuToo) {
  const std::filesystem::path file = folder_.path() / "steps.png";
  const ProgramResult result = run_encore(
      {"render", "mug", "--device", "gpu", "--size", "32", "--heatmap", "tests", "--out", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "tests a ray: min ")) << result.err;
  EXPECT_TRUE(test::contents_of(file).starts_with("\x89PNG"));
}

TEST_F(GpuCommands, RasterDrawsWithoutAStructure) {
  const std::filesystem::path file = folder_.path() / "raster.png";
  const ProgramResult result =
      run_encore({"render", "mug", "--device", "raster", "--size", "64", "--out", file, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"\"device\": \"raster\"", "\"structure\": null", "\"build_ms\": null",
                           "\"million_rays_per_s\": null", "\"hits\": null"}) {
    EXPECT_TRUE(contains(result.out, part)) << part << "\n" << result.out;
  }
  EXPECT_TRUE(test::contents_of(file).starts_with("\x89PNG"));
}

TEST(DeviceCommands, WrongUseIsRefusedBeforeAnythingIsDone) {
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const Case cases[] = {
      {{"render", "--out", "x.png", "--device", "gpo"}, "did you mean 'gpu'"},
      {{"render", "--out", "x.png", "--device", "raster", "--heatmap", "steps"}, "raster"},
      {{"render", "--out", "x.png", "--device", "raster", "--structure", "kd-sah"}, "--structure"},
      {{"render", "--out", "x.png", "--compare", "cpu"}, "another device"},
      {{"render", "--out", "x.png", "--compare", "gpu", "--heatmap", "steps"}, "--heatmap"},
      {{"render", "--out", "x.png", "--difference", "y.png"}, "--compare"},
      {{"render", "--out", "x.png", "--compare", "gpu", "--difference", "y.jpg"}, ".png"},
      {{"render", "--out", "x.png", "--device", "gpu", "--structure", "brute"}, "brute"},
      {{"verify", "--device", "gpo"}, "did you mean 'gpu'"},
      {{"verify", "--device", "raster"}, "no hits"},
      {{"verify", "--device", "gpu", "--size", "0"}, "--size"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run_encore(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << c.says << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, c.says)) << result.err;
  }
}

TEST(DeviceCommands, AMissingDeviceIsNamedWithTheWayOut) {
  const test::TemporaryFolder folder;
  const ProgramResult result = run_encore({"render", "triangle", "--device", "gpu", "--gl-device",
                                           "97", "--size", "8", "--out", folder.path() / "x.png"});
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_TRUE(contains(result.err, "OpenGL")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.png"));
}

TEST(DeviceCommands, TheCpuStaysTheDefaultAndSaysNothingOfAnotherDevice) {
  const test::TemporaryFolder folder;
  const ProgramResult result =
      run_encore({"render", "triangle", "--size", "8", "--out", folder.path() / "x.png", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"\"device\": \"cpu\"", "\"device_name\": null", "\"warm_up_ms\": null",
                           "\"transfer_bytes\": null"}) {
    EXPECT_TRUE(contains(result.out, part)) << part << "\n" << result.out;
  }
}

}  // namespace
}  // namespace encore::app
