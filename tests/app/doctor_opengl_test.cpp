// What the doctor says of OpenGL, of machines as they might be and of this one.
#include "app/doctor_opengl.h"

#include "profile_json_check.h"
#include "run_program.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace encore::app {
namespace {

using renderer::gl::DeviceListing;
using test::contains;

DeviceListing gpu() {
  DeviceListing device;
  device.index = 0;
  device.name = "Some \"GPU\"";
  device.version = "4.6.0 Some Driver 1.2";
  device.usable = true;
  device.storage_block_bytes = std::uint64_t{2} << 30;
  device.timestamp_bits = 64;
  return device;
}

DeviceListing locked_gpu() {
  DeviceListing device;
  device.index = 1;
  device.name = "EGL device 1 (/dev/dri/renderD129)";
  device.problem = "no permission for /dev/dri/renderD129";
  return device;
}

TEST(DoctorOpenGl, NamesEachDeviceWithWhatItOffers) {
  const std::string text = opengl_text({{gpu(), locked_gpu()}, ""});
  for (const char* part :
       {"OpenGL device 0  Some \"GPU\": usable", "4.6.0 Some Driver 1.2", "2.0 GiB",
        "timed on the device", "OpenGL device 1  EGL device 1 (/dev/dri/renderD129): not usable",
        "in the way     no permission for /dev/dri/renderD129"}) {
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  }
  EXPECT_FALSE(contains(text, "only the CPU")) << text;
  EXPECT_FALSE(contains(text, "software")) << text;
}

TEST(DoctorOpenGl, WhatIsNotKnownOfADeviceIsNotSaid) {
  const std::string text = opengl_text({{locked_gpu()}, ""});
  for (const char* part : {"version", "largest buffer", "clock", "MiB"}) {
    EXPECT_FALSE(contains(text, part)) << part << "\n" << text;
  }
  const std::string json = opengl_json({{locked_gpu()}, ""});
  EXPECT_TRUE(contains(json, "\"largest_storage_buffer_bytes\": null")) << json;
  EXPECT_TRUE(contains(json, "\"timestamp_clock\": null")) << json;
  EXPECT_TRUE(contains(json, "\"usable\": false, \"problem\": \"\"")) << json;
}

TEST(DoctorOpenGl, SaysSoftwareAndMissingClocks) {
  DeviceListing device = gpu();
  device.software = true;
  device.timestamp_bits = 0;
  const std::string text = opengl_text({{device}, ""});
  EXPECT_TRUE(contains(text, ", software, runs on the CPU: usable")) << text;
  EXPECT_TRUE(contains(text, "clock          none")) << text;
  EXPECT_TRUE(contains(opengl_json({{device}, ""}), "\"timestamp_clock\": false"));
}

TEST(DoctorOpenGl, WhereNoneIsUsableItSaysWhyAndWhatCanBeDone) {
  const std::string unusable = opengl_text({{locked_gpu()}, ""});
  EXPECT_TRUE(contains(unusable, "--device cpu")) << unusable;
  EXPECT_TRUE(contains(unusable, "libgl1-mesa-dri")) << unusable;
  const std::string none = opengl_text({{}, "libEGL.so.1 is missing; install libegl1"});
  EXPECT_TRUE(contains(none, "--device cpu")) << none;
  EXPECT_TRUE(contains(none, "install libegl1")) << none;
}

TEST(DoctorOpenGl, JsonIsJsonWhateverTheNames) {
  for (const OpenGlReport& report :
       {OpenGlReport{{gpu(), locked_gpu()}, ""}, OpenGlReport{{}, "no \"EGL\"\nat all"}}) {
    const std::string json = opengl_json(report);
    EXPECT_TRUE(JsonChecker(json).valid()) << json;
  }
}

/// Runs the doctor on a machine without sensors, perhaps with a variable of the environment set.
ProgramResult doctor(const std::vector<std::string>& more, const char* variable = nullptr,
                     const char* value = nullptr) {
  const auto root = std::filesystem::path(ENCORE_FIXTURES) / "sysfs" / "powercap_empty";
  std::vector<std::string> arguments{"doctor", "--sysfs-root", root, "--seconds", "0.1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  if (variable != nullptr) setenv(variable, value, 1);
  const ProgramResult result = run_encore(arguments);
  if (variable != nullptr) unsetenv(variable);
  return result;
}

TEST(DoctorOpenGlCommand, TellsOfThisMachineWhatIsThere) {
  const OpenGlReport here = examine_opengl();
  const ProgramResult result = doctor({});
  EXPECT_TRUE(contains(result.out, opengl_text(here))) << result.out;
  EXPECT_EQ(result.err, "");
  const ProgramResult json = doctor({"--json"});
  EXPECT_TRUE(JsonChecker(json.out).valid()) << json.out;
  EXPECT_TRUE(contains(json.out, "\"opengl\": " + opengl_json(here))) << json.out;
}

TEST(DoctorOpenGlCommand, WithoutADriverItSaysSoAndStillTellsOfSensors) {
  const ProgramResult result = doctor({}, "__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_TRUE(contains(result.out, "no sensor can be used")) << result.out;
  EXPECT_TRUE(contains(result.out, "only the CPU can trace (--device cpu)")) << result.out;
  EXPECT_EQ(result.err, "");
}

TEST(DoctorOpenGlCommand, WhatNeedsOpenGlExitsWithFiveWithoutIt) {
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
  const ProgramResult result =
      run_encore({"render", "triangle", "--device", "gpu", "--size", "8x8", "-o", "out.png"});
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_TRUE(contains(result.err, "encore: there is no usable OpenGL device; install"))
      << result.err;
}

TEST(DoctorOpenGlCommand, TheExitCodeOfMissingOpenGlIsInTheHelp) {
  EXPECT_TRUE(contains(run_encore({"--help"}).out, "5 no usable OpenGL"));
}

}  // namespace
}  // namespace encore::app
