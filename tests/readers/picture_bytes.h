#pragma once

#include <string>

namespace encore::scene {

/// Two by two texels: red and green above blue and (10, 20, 30), as PNG.
inline std::string png_picture() {
  static constexpr unsigned char kBytes[] = {
      0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49,
      0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02,
      0x00, 0x00, 0x00, 0xFD, 0xD4, 0x9A, 0x73, 0x00, 0x00, 0x00, 0x13, 0x49, 0x44,
      0x41, 0x54, 0x78, 0x9C, 0x63, 0xF8, 0xCF, 0xC0, 0xC0, 0x00, 0xC2, 0x0C, 0xFF,
      0xB9, 0x44, 0xE4, 0x00, 0x1A, 0x58, 0x03, 0x3A, 0x56, 0x63, 0xA2, 0x3C, 0x00,
      0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes)};
}

/// The same as binary PNM.
inline std::string pnm_picture() {
  return std::string("P6 2 2 255\n\xFF\0\0\0\xFF\0\0\0\xFF\x0A\x14\x1E", 23);
}

/// Its texels.
inline constexpr unsigned kPictureTexels[] = {0xFF0000FFU, 0xFF00FF00U, 0xFFFF0000U, 0xFF1E140AU};

/// A glTF triangle that wears the picture at `uri`; texture coordinates (0, 0), (1, 0), (0, 1) as
/// OBJ counts them, from the bottom.
inline std::string gltf_triangle(const std::string& uri) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2,
  "material": 0}]}],
"materials": [{"name": "worn", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
"textures": [{"source": 0}], "images": [{"uri": ")" +
         uri + R"("}],
"accessors": [
  {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
   "max": [1, 1, 0]},
  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
  {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
  {"buffer": 0, "byteOffset": 36, "byteLength": 24},
  {"buffer": 0, "byteOffset": 60, "byteLength": 6}],
"buffers": [{"byteLength": 66, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAIA/AACAPwAAAAAAAAAAAAABAAIA"}]})";
}

}  // namespace encore::scene
