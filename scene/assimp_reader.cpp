#include "scene/assimp_reader.h"

#include "scene/model_index_table.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace encore::scene {

namespace {

// All that tells one vertex from another, compared bit for bit.
using VertexBits = std::array<std::uint32_t, 11>;

std::uint64_t hash_of(const VertexBits& bits) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const std::uint32_t word : bits) hash = (hash ^ word) * 0x100000001B3ULL;
  return hash;
}

glm::vec3 color(const aiColor3D& c) {
  const auto part = [](float v) { return std::isfinite(v) ? std::max(v, 0.0F) : 0.0F; };
  return glm::vec3(part(c.r), part(c.g), part(c.b));
}

Material convert(const aiMaterial& from) {
  Material to;
  aiString name;
  if (from.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) to.name = name.C_Str();
  aiColor3D c;
  if (from.Get(AI_MATKEY_COLOR_DIFFUSE, c) == AI_SUCCESS) to.diffuse = color(c);
  if (from.Get(AI_MATKEY_COLOR_SPECULAR, c) == AI_SUCCESS) to.specular = color(c);
  if (from.Get(AI_MATKEY_COLOR_AMBIENT, c) == AI_SUCCESS) {
    const glm::vec3 ambient = color(c);
    for (int i = 0; i < 3; ++i) to.ambient[i] = std::min(ambient[i], 1.0F);
  }
  if (from.Get(AI_MATKEY_COLOR_EMISSIVE, c) == AI_SUCCESS) to.emission = color(c);
  float value = 0.0F;
  const auto get = [&from, &value](const char* key, unsigned type, unsigned index) {
    return from.Get(key, type, index, value) == AI_SUCCESS && std::isfinite(value);
  };
  if (get(AI_MATKEY_SHININESS)) to.shininess = std::max(value, 0.0F);
  if (get(AI_MATKEY_OPACITY)) to.opacity = std::clamp(value, 0.0F, 1.0F);
  if (get(AI_MATKEY_REFRACTI) && value > 0.0F) to.index_of_refraction = value;
  // What glTF calls transmission is what others call 1 - opacity.
  if (get(AI_MATKEY_TRANSMISSION_FACTOR) && value > 0.0F) {
    to.opacity *= 1.0F - std::min(value, 1.0F);
  }
  if (get(AI_MATKEY_REFLECTIVITY)) to.reflectivity = std::clamp(value, 0.0F, 1.0F);
  return to;
}

/// The diffuse texture that a material names; empty if there is none.
std::string texture_of(const aiMaterial& from) {
  for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR}) {
    aiString path;
    if (from.GetTexture(type, 0, &path) == AI_SUCCESS && path.length > 0) return path.C_Str();
  }
  return {};
}

class SceneMerger {
 public:
  explicit SceneMerger(const aiScene& scene)
      : scene_(scene), assembler_(packed_.model.mesh), vertices_(&hash_of) {}

  PackedModel run() {
    find_attributes();
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      packed_.model.materials.push_back(convert(*scene_.mMaterials[i]));
      add_texture(texture_of(*scene_.mMaterials[i]));
    }
    // Depth first, children in their order. A stack of our own: files can nest nodes deeper than
    // calls may nest.
    struct Visit {
      const aiNode* node;
      aiMatrix4x4 parent;
    };
    std::vector<Visit> open;
    if (scene_.mRootNode != nullptr) open.push_back({scene_.mRootNode, aiMatrix4x4()});
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const aiMatrix4x4 transform = visit.parent * visit.node->mTransformation;
      for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
        const unsigned mesh = visit.node->mMeshes[i];
        if (mesh < scene_.mNumMeshes) add_mesh(*scene_.mMeshes[mesh], transform);
      }
      for (unsigned i = visit.node->mNumChildren; i > 0; --i) {
        open.push_back({visit.node->mChildren[i - 1], transform});
      }
    }
    packed_.dropped = assembler_.dropped;
    packed_.dropped.points = points_;
    packed_.dropped.lines = lines_;
    return std::move(packed_);
  }

 private:
  // An attribute of one mesh becomes one of all; the others hold what stands for "none".
  void find_attributes() {
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[i];
      normals_ = normals_ || mesh.HasNormals();
      texcoords_ = texcoords_ || mesh.HasTextureCoords(0);
      colors_ = colors_ || mesh.HasVertexColors(0);
    }
  }

  void add_texture(std::string texture) {
    // "*0" is the first one within the file; others lie there under their names.
    const bool embedded =
        !texture.empty() &&
        (texture.front() == '*' || scene_.GetEmbeddedTexture(texture.c_str()) != nullptr);
    packed_.embedded_textures += embedded ? 1 : 0;
    packed_.textures.push_back(embedded ? std::string() : std::move(texture));
  }

  void add_mesh(const aiMesh& mesh, const aiMatrix4x4& transform) {
    // Normals go by the inverse transpose; a mirroring turns the corners' order around.
    const aiMatrix3x3 linear(transform);
    const bool mirrored = linear.Determinant() < 0.0F;
    aiMatrix3x3 for_normals(linear);
    for_normals.Inverse().Transpose();

    std::vector<std::uint32_t> joined(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      joined[i] = add_vertex(mesh, i, transform, for_normals);
    }
    std::vector<std::uint32_t> corners;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      points_ += face.mNumIndices == 1 ? 1 : 0;
      lines_ += face.mNumIndices == 2 ? 1 : 0;
      if (face.mNumIndices < 3) continue;
      corners.clear();
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned index = face.mIndices[k];
        corners.push_back(index < joined.size() ? joined[index] : kNoVertex);
      }
      if (mirrored) std::reverse(corners.begin(), corners.end());
      assembler_.add(corners, mesh.mMaterialIndex);
    }
    if (mesh.mNumFaces == 0) points_ += mesh.mNumVertices;
  }

  std::uint32_t add_vertex(const aiMesh& mesh, unsigned i, const aiMatrix4x4& transform,
                           const aiMatrix3x3& for_normals) {
    const aiVector3D p = transform * mesh.mVertices[i];
    aiVector3D n(0.0F);
    if (mesh.HasNormals()) {
      n = for_normals * mesh.mNormals[i];
      n.NormalizeSafe();
    }
    aiVector3D t(0.0F);
    if (mesh.HasTextureCoords(0)) t = mesh.mTextureCoords[0][i];
    aiColor4D c(1.0F, 1.0F, 1.0F, 1.0F);
    if (mesh.HasVertexColors(0)) c = mesh.mColors[0][i];

    const float values[] = {p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y, c.r, c.g, c.b};
    VertexBits bits{};
    // Adding zero makes one zero of the two.
    for (std::size_t k = 0; k < bits.size(); ++k) {
      bits[k] = std::bit_cast<std::uint32_t>(values[k] + 0.0F);
    }
    const auto [vertex, is_new] = vertices_.insert(bits);
    if (!is_new) return vertex;
    Mesh& out = packed_.model.mesh;
    out.positions.emplace_back(p.x, p.y, p.z);
    if (normals_) out.normals.emplace_back(n.x, n.y, n.z);
    if (texcoords_) out.texcoords.emplace_back(t.x, t.y);
    if (colors_) out.colors.emplace_back(c.r, c.g, c.b);
    return vertex;
  }

  const aiScene& scene_;
  PackedModel packed_;
  PolygonAssembler assembler_;
  IndexTable<VertexBits, std::uint64_t (*)(const VertexBits&)> vertices_;
  std::uint64_t points_ = 0;
  std::uint64_t lines_ = 0;
  bool normals_ = false;
  bool texcoords_ = false;
  bool colors_ = false;
};

// No post-processing: Assimp joins vertices that are merely close and trips over its own assertions
// when it triangulates odd polygons. Skeletons without a skin are no geometry.
void configure(Assimp::Importer& importer) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
}

PackedModel merge(const Assimp::Importer& importer, const aiScene* scene) {
  if (scene != nullptr) return SceneMerger(*scene).run();
  PackedModel failed;
  failed.error = importer.GetErrorString();
  if (failed.error.empty()) failed.error = "no reason given";
  return failed;
}

}  // namespace

PackedModel import_with_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  configure(importer);
  return merge(importer, importer.ReadFile(path.string(), 0));
}

PackedModel import_with_assimp(std::string_view bytes, const std::string& extension) {
  Assimp::Importer importer;
  configure(importer);
  const std::string hint = extension.starts_with('.') ? extension.substr(1) : extension;
  return merge(importer, importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, hint.c_str()));
}

}  // namespace encore::scene
