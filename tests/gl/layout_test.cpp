// The shared structs lie in memory in GLSL as in C++: each member is read by name on the device
// from bytes that C++ wrote, in the last of several elements, and must be what stands at its C++
// offset.
#include "compute.h"
#include "renderer/gl/shader_source.h"
#include "shaders/shared/gpu_types.h"
#include "tests/support/gl_context.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace encore::renderer::gl {
namespace {

using LayoutTest = test::GlTest;

struct Member {
  const char* name;
  std::size_t offset;
  std::size_t size;
};
#define MEMBER(type, name)                                    \
  Member {                                                    \
#name, offsetof(gpu::type, name), sizeof(gpu::type::name) \
  }

/// How a shader sends any member back, bit for bit.
constexpr const char* kSend = R"(
layout(local_size_x = 1) in;
layout(std430, binding = 1) writeonly buffer Answer { uint answer[]; };
uint sent = 0u;
void send(uint x) { answer[sent] = x; ++sent; }
void send(uvec3 x) { send(x.x); send(x.y); send(x.z); }
void send(float x) { send(floatBitsToUint(x)); }
void send(vec3 x) { send(x.x); send(x.y); send(x.z); }
void send(double x) { uvec2 bits = unpackDouble2x32(x); send(bits.x); send(bits.y); }
void send(dvec3 x) { send(x.x); send(x.y); send(x.z); }
)";

constexpr std::size_t kElements = 3;

/// The words of all elements; each is a normal float, and two of them are a normal double.
std::vector<std::uint32_t> distinct_words(std::size_t count) {
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < count; ++i) {
    words.push_back(std::bit_cast<std::uint32_t>(1000.0F + static_cast<float>(i)));
  }
  return words;
}

void expect_same_layout(const char* type, std::size_t size, const std::vector<Member>& members,
                        bool uniform) {
  std::string text = assemble_shader("shared/gpu_types.h", {}).text + kSend;
  text += uniform ? "layout(std140, binding = 0) uniform " : "layout(std430, binding = 0) buffer ";
  text += std::string("Elements { ") + type + " elements" + (uniform ? "[3]" : "[]") + "; };\n";
  text += "void main() {\n";
  for (const Member& member : members)
    text += std::string("send(elements[2].") + member.name + ");\n";
  text += "}\n";
  SCOPED_TRACE(text.substr(text.find("layout(std")));

  const auto words = distinct_words(kElements * size / 4);
  Buffer elements("the elements");
  Buffer answer("the answer");
  elements.reserve(kElements * size, 1 << 20);
  elements.write(std::as_bytes(std::span(words)));
  answer.reserve(1024, 1 << 20);
  answer.fill(0, 1024);
  uniform ? elements.bind_uniform(0) : elements.bind_storage(0);
  answer.bind_storage(1);
  test_support::run(test_support::compute_program(text), 1);

  std::vector<std::uint32_t> expected;
  std::size_t covered = 0;
  for (const Member& member : members) {
    EXPECT_EQ(member.offset, covered) << member.name << " is preceded by padding";
    covered = member.offset + member.size;
    const std::size_t first = (2 * size + member.offset) / 4;
    for (std::size_t i = 0; i < member.size / 4; ++i) expected.push_back(words[first + i]);
  }
  EXPECT_EQ(covered, size);
  EXPECT_EQ(test_support::words_of(answer, expected.size()), expected);
}

TEST_F(LayoutTest, Triangle) {
  expect_same_layout(
      "Triangle", sizeof(gpu::Triangle),
      {MEMBER(Triangle, v0), MEMBER(Triangle, material), MEMBER(Triangle, v1),
       MEMBER(Triangle, reserved0), MEMBER(Triangle, v2), MEMBER(Triangle, reserved1)},
      false);
}

TEST_F(LayoutTest, BvhNode) {
  expect_same_layout(
      "BvhNode", sizeof(gpu::BvhNode),
      {MEMBER(BvhNode, min), MEMBER(BvhNode, first), MEMBER(BvhNode, max), MEMBER(BvhNode, count)},
      false);
}

TEST_F(LayoutTest, KdNode) {
  expect_same_layout("KdNode", sizeof(gpu::KdNode), {MEMBER(KdNode, data), MEMBER(KdNode, flags)},
                     false);
}

TEST_F(LayoutTest, Hit) {
  expect_same_layout("Hit", sizeof(gpu::Hit),
                     {MEMBER(Hit, t), MEMBER(Hit, triangle), MEMBER(Hit, u), MEMBER(Hit, v)},
                     false);
}

TEST_F(LayoutTest, Ray) {
  expect_same_layout(
      "Ray", sizeof(gpu::Ray),
      {MEMBER(Ray, origin), MEMBER(Ray, t_min), MEMBER(Ray, direction), MEMBER(Ray, t_max)}, false);
}

TEST_F(LayoutTest, Material) {
  expect_same_layout(
      "Material", sizeof(gpu::Material),
      {MEMBER(Material, diffuse), MEMBER(Material, shininess), MEMBER(Material, specular),
       MEMBER(Material, texture), MEMBER(Material, glow), MEMBER(Material, reserved1)},
      false);
}

TEST_F(LayoutTest, Light) {
  expect_same_layout("Light", sizeof(gpu::Light),
                     {MEMBER(Light, position), MEMBER(Light, reserved0), MEMBER(Light, color),
                      MEMBER(Light, reserved1)},
                     false);
}

TEST_F(LayoutTest, StructureParametersInAUniformBlock) {
  using gpu::StructureParameters;
  expect_same_layout(
      "StructureParameters", sizeof(gpu::StructureParameters),
      {MEMBER(StructureParameters, min), MEMBER(StructureParameters, depth),
       MEMBER(StructureParameters, max), MEMBER(StructureParameters, references),
       MEMBER(StructureParameters, cells), MEMBER(StructureParameters, first_plane_y),
       MEMBER(StructureParameters, smallest_gap), MEMBER(StructureParameters, first_plane_z)},
      true);
}

TEST_F(LayoutTest, CameraParametersInAUniformBlock) {
  expect_same_layout("CameraParameters", sizeof(gpu::CameraParameters),
                     {MEMBER(CameraParameters, forward), MEMBER(CameraParameters, center_x),
                      MEMBER(CameraParameters, right), MEMBER(CameraParameters, center_y),
                      MEMBER(CameraParameters, up), MEMBER(CameraParameters, orthographic),
                      MEMBER(CameraParameters, reserved0), MEMBER(CameraParameters, origin),
                      MEMBER(CameraParameters, material_count),
                      MEMBER(CameraParameters, background), MEMBER(CameraParameters, light_count)},
                     true);
}

}  // namespace
}  // namespace encore::renderer::gl
