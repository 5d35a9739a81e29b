#include "scene/obj_library.h"

#include <tiny_obj_loader.h>

namespace encore::scene {

std::size_t count_obj_triangles(const std::filesystem::path& path) {
  tinyobj::ObjReader reader;
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  config.vertex_color = false;
  if (!reader.ParseFromFile(path.string(), config)) return 0;
  std::size_t corners = 0;
  for (const tinyobj::shape_t& shape : reader.GetShapes()) corners += shape.mesh.indices.size();
  return corners / 3;
}

}  // namespace encore::scene
