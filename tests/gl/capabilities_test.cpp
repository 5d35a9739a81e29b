// What counts as software and as good enough; needs no OpenGL.
#include "renderer/gl/capabilities.h"

#include "renderer/gl/error.h"
#include "renderer/gl/shader_source.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>

namespace encore::renderer::gl {
namespace {

using test::contains;

TEST(SoftwareRenderer, IsKnownByItsName) {
  for (const char* name :
       {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer", "Mesa DRI swrast",
        "SWR (LLVM 9.0, 256 bits)", "Google SwiftShader", "Microsoft Basic Render Driver",
        "D3D12 (Microsoft Basic Render Driver)", "GDI Generic",
        "zink (llvmpipe (LLVM 15.0.6, 256 bits))", "zink Vulkan 1.3(llvmpipe (MESA_LLVMPIPE))",
        "virgl (llvmpipe (LLVM 15.0.6, 256 bits))", "virgl (LLVMPIPE (LLVM 12.0.0, 256 bits))",
        "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)",
        "Apple Software Renderer", "lavapipe"}) {
    EXPECT_TRUE(is_software_renderer(name)) << name;
  }
}

TEST(SoftwareRenderer, HardwareIsNot) {
  for (const char* name :
       {"NVIDIA GeForce RTX 3090/PCIe/SSE2", "NVIDIA H100 80GB HBM3/PCIe/SSE2",
        "AMD Radeon RX 6800 XT (navi21, LLVM 15.0.6, DRM 3.49, 6.1.0)", "Radeon RX 580 Series",
        "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "Intel(R) Iris(R) Xe Graphics", "NVC1",
        "zink Vulkan 1.3(NVIDIA GeForce GTX 1080 (NVIDIA_PROPRIETARY))", "D3D12 (NVIDIA GeForce)",
        "virgl (AMD Radeon RX 580)", "Mali-G78", "V3D 7.1.7", "Apple M1 (G13G B1)", ""}) {
    EXPECT_FALSE(is_software_renderer(name)) << name;
  }
}

Capabilities good() {
  Capabilities found;
  found.renderer = "Some GPU";
  found.version = "4.3.0 Some Driver 1.2";
  found.major = 4;
  found.minor = 3;
  found.compute_storage_blocks = 16;
  found.storage_bindings = 64;
  return found;
}

std::string refusal(const Capabilities& found) {
  try {
    require_compute(found);
  } catch (const GlUnavailable& error) {
    return error.what();
  }
  return {};
}

TEST(RequireCompute, TakesOpenGl43AndLater) {
  Capabilities found = good();
  EXPECT_EQ(refusal(found), "");
  found.minor = 6;
  EXPECT_EQ(refusal(found), "");
  found.major = 5;
  found.minor = 0;
  EXPECT_EQ(refusal(found), "");
}

TEST(RequireCompute, RefusesOlderOnesNamingBothVersionsAndTheWayOut) {
  Capabilities found = good();
  found.version = "4.1 Some Driver 0.9";
  found.minor = 1;
  const std::string message = refusal(found);
  for (const char* part :
       {"OpenGL 4.3", "4.1 Some Driver 0.9", "Some GPU", "--gl-device", "--device cpu"}) {
    EXPECT_TRUE(contains(message, part)) << part << "\n" << message;
  }
  found.major = 3;
  found.minor = 9;
  EXPECT_NE(refusal(found), "");
}

TEST(RequireCompute, RefusesTooFewStorageBuffers) {
  Capabilities found = good();
  found.compute_storage_blocks = 10;
  EXPECT_EQ(refusal(found), "");
  found.compute_storage_blocks = 9;
  EXPECT_TRUE(contains(refusal(found), "10 storage buffers")) << refusal(found);
  EXPECT_TRUE(contains(refusal(found), "offers 9 ")) << refusal(found);
}

TEST(RequireCompute, CountsOnEveryBindingPointThatAllScenesUse) {
  const auto files = shader_files();
  const auto bindings = std::find_if(files.begin(), files.end(), [](const ShaderFile& file) {
    return file.name == "shared/bindings.h";
  });
  ASSERT_NE(bindings, files.end());
  const std::string text(bindings->text);
  // Textures are asked for where a scene has some (GpuTracer), so that a device without room for
  // them still draws all others.
  const std::regex pattern(R"(#define ENCORE_BINDING_(?!TEX)\w+ (\d+))");
  int largest = -1;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    largest = std::max(largest, std::stoi((*it)[1]));
  }
  ASSERT_GE(largest, 1);
  Capabilities found = good();
  found.storage_bindings = largest + 1;
  EXPECT_EQ(refusal(found), "");
  found.storage_bindings = largest;
  EXPECT_NE(refusal(found), "");
}

}  // namespace
}  // namespace encore::renderer::gl
