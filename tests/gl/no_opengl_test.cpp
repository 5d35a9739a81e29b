// What is said on machines without a usable OpenGL: each is imitated in a process of its own, by
// the environment that the system's EGL library and Mesa heed.
#include "renderer/gl/context.h"
#include "renderer/gl/error.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace encore::renderer::gl {
namespace {

constexpr int kUnavailable = 5;

[[noreturn]] void make_context_with(const char* variable, const char* value) {
  setenv(variable, value, 1);
  try {
    const auto context = make_headless_context();
    std::fprintf(stderr, "all the same: %s\n", context->capabilities().version.c_str());
  } catch (const GlUnavailable& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(kUnavailable);
  }
  std::exit(0);
}

[[noreturn]] void list_devices_with(const char* variable, const char* value) {
  setenv(variable, value, 1);
  std::string problem;
  for (const DeviceListing& device : list_devices(&problem)) {
    std::fprintf(stderr, "%d, %s, %s: %s\n", device.index, device.usable ? "good" : "unusable",
                 device.name.c_str(), device.problem.c_str());
  }
  std::exit(problem.empty() ? 0 : 1);
}

class NoOpenGlTest : public ::testing::Test {
 protected:
  // A new process, in which nothing of OpenGL was loaded yet.
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(NoOpenGlTest, WithoutADriverTheMessageNamesTheWaysOut) {
  EXPECT_EXIT(make_context_with("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null"),
              testing::ExitedWithCode(kUnavailable),
              "^there is no usable OpenGL device; install the GPU's driver.*libgl1-mesa-dri.*"
              "--device cpu.*default display");
}

TEST_F(NoOpenGlTest, WithoutADriverTheListSaysWhy) {
  EXPECT_EXIT(list_devices_with("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null"),
              testing::ExitedWithCode(0), "^0, unusable, EGL's default display: no display");
}

TEST_F(NoOpenGlTest, AnOldOpenGlIsNamedWithTheOneThatIsNeeded) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "under this sanitizer the driver stays loaded, and with it the version it read";
#endif
  std::string problem;
  const auto devices = list_devices(&problem);
  if (devices.empty() || devices[0].version.find("Mesa") == std::string::npos) {
    GTEST_SKIP() << "only Mesa can pretend to be older than it is";
  }
  EXPECT_EXIT(make_context_with("MESA_GL_VERSION_OVERRIDE", "4.1"),
              testing::ExitedWithCode(kUnavailable),
              "^there is no usable OpenGL device.*OpenGL 4.3 is needed.*offers 4.1 ");
  EXPECT_EXIT(list_devices_with("MESA_GL_VERSION_OVERRIDE", "4.1"), testing::ExitedWithCode(0),
              "^0, unusable, .*OpenGL 4.3 is needed.*offers 4.1 ");
}

}  // namespace
}  // namespace encore::renderer::gl
