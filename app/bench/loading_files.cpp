#include "app/bench/loading_files.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace encore::app::bench {

namespace {

struct VertexHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& v) const {
    return (v[0] * 0x9E3779B97F4A7C15U) ^ (v[1] * 0xC2B2AE3D27D4EB4FU) ^
           (v[2] * 0x165667B19E3779F9U);
  }
};

std::ofstream opened(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot write " + path.string());
  return file;
}

void closed(std::ofstream& file, const std::filesystem::path& path) {
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

void write_header(std::ofstream& file, const scene::Mesh& mesh, std::string_view format) {
  file << fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, mesh.positions.size(), mesh.triangles.size());
}

std::string whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::filesystem::file_size(path), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

/// Counts and where the data begins, of our own headers.
struct PlyStart {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t data = 0;
};

PlyStart ply_start(const std::string& text) {
  const auto count_after = [&](std::string_view words) {
    const std::size_t at = text.find(words) + words.size();
    return static_cast<std::size_t>(std::strtoull(text.c_str() + at, nullptr, 10));
  };
  constexpr std::string_view kEnd = "end_header\n";
  return {count_after("element vertex "), count_after("element face "),
          text.find(kEnd) + kEnd.size()};
}

template <class T>
const char* next_number(const char* at, const char* end, T& value) {
  while (at < end && (*at == ' ' || *at == '\n')) ++at;
  return std::from_chars(at, end, value).ptr;
}

}  // namespace

scene::Mesh indexed_mesh(std::span<const scene::Triangle> triangles) {
  scene::Mesh mesh;
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, VertexHash> known;
  const auto index = [&](const glm::vec3& v) {
    const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(v);
    const auto [place, fresh] =
        known.emplace(bits, static_cast<std::uint32_t>(mesh.positions.size()));
    if (fresh) mesh.positions.push_back(v);
    return place->second;
  };
  for (const scene::Triangle& t : triangles) {
    const std::uint32_t a = index(t.v0);
    const std::uint32_t b = index(t.v1);
    mesh.triangles.emplace_back(a, b, index(t.v2));
  }
  return mesh;
}

void write_binary_ply(const std::filesystem::path& path, const scene::Mesh& mesh) {
  std::ofstream file = opened(path);
  write_header(file, mesh, "binary_little_endian");
  for (const glm::vec3& v : mesh.positions) {
    file.write(reinterpret_cast<const char*>(&v), sizeof v);
  }
  for (const glm::uvec3& t : mesh.triangles) {
    file.put(3);
    file.write(reinterpret_cast<const char*>(&t), sizeof t);
  }
  closed(file, path);
}

void write_ascii_ply(const std::filesystem::path& path, const scene::Mesh& mesh) {
  std::ofstream file = opened(path);
  write_header(file, mesh, "ascii");
  for (const glm::vec3& v : mesh.positions) file << fmt::format("{} {} {}\n", v.x, v.y, v.z);
  for (const glm::uvec3& t : mesh.triangles) file << fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
  closed(file, path);
}

void write_obj(const std::filesystem::path& path, const scene::Mesh& mesh) {
  std::ofstream file = opened(path);
  for (const glm::vec3& v : mesh.positions) file << fmt::format("v {} {} {}\n", v.x, v.y, v.z);
  for (const glm::uvec3& t : mesh.triangles) {
    file << fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  }
  closed(file, path);
}

std::size_t parse_binary_ply(const std::filesystem::path& path) {
  const std::string text = whole(path);
  const PlyStart start = ply_start(text);
  std::vector<glm::vec3> positions(start.vertices);
  std::vector<glm::uvec3> triangles(start.faces);
  const char* at = text.data() + start.data;
  std::memcpy(positions.data(), at, sizeof(glm::vec3) * positions.size());
  at += sizeof(glm::vec3) * positions.size();
  for (glm::uvec3& t : triangles) {
    std::memcpy(&t, at + 1, sizeof t);
    at += 1 + sizeof t;
  }
  return triangles.size();
}

std::size_t parse_ascii_ply(const std::filesystem::path& path) {
  const std::string text = whole(path);
  const PlyStart start = ply_start(text);
  std::vector<glm::vec3> positions(start.vertices);
  std::vector<glm::uvec3> triangles(start.faces);
  const char* at = text.data() + start.data;
  const char* end = text.data() + text.size();
  for (glm::vec3& v : positions) {
    for (int axis = 0; axis < 3; ++axis) at = next_number(at, end, v[axis]);
  }
  for (glm::uvec3& t : triangles) {
    int corners = 0;
    at = next_number(at, end, corners);
    for (int k = 0; k < 3; ++k) at = next_number(at, end, t[k]);
  }
  return triangles.size();
}

}  // namespace encore::app::bench
