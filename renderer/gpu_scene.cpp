#include "renderer/gpu_scene.h"

#include "renderer/texture_lookup.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/path_types.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace encore::renderer {

namespace {

gpu::Material to_gpu(const scene::Material& material, std::uint32_t texture) {
  return {.diffuse = material.diffuse,
          .shininess = std::max(0.0F, material.shininess),
          .specular = material.specular,
          .texture = texture,
          .glow = material.emission + kAmbientLight * material.ambient,
          .reserved1 = 0};
}

gpu::Bounce bounce_of(const scene::Material& material) {
  return {.specular = material.specular,
          .reflectivity = material.reflectivity,
          .opacity = material.opacity,
          .index_of_refraction = material.index_of_refraction,
          .reserved0 = 0,
          .reserved1 = 0};
}

gpu::Light to_gpu(const scene::Light& light) {
  return {.position = light.position, .reserved0 = 0, .color = light.color, .reserved1 = 0};
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

/// Overwrites the values of a range in place.
template <class T>
void send_range(gl::Buffer& buffer, const std::vector<T>& values, const scene::TriangleRange& range,
                Transfer& sum) {
  const auto bytes = std::as_bytes(std::span(values).subspan(range.first, range.count));
  buffer.write(bytes, range.first * sizeof(T));
  sum.uploaded_bytes += bytes.size();
}

using Textures = std::vector<std::shared_ptr<const scene::Texture>>;

/// Each texture that a material wears, once.
Textures worn_textures(const scene::Scene& scene) {
  Textures worn;
  for (const scene::Material& material : scene.materials) {
    const auto& texture = material.diffuse_texture;
    if (texture != nullptr && std::find(worn.begin(), worn.end(), texture) == worn.end()) {
      worn.push_back(texture);
    }
  }
  return worn;
}

std::uint32_t number_of(const Textures& textures, const scene::Material& material) {
  const auto found = std::find(textures.begin(), textures.end(), material.diffuse_texture);
  return found == textures.end() ? ENCORE_NO_TEXTURE
                                 : static_cast<std::uint32_t>(found - textures.begin());
}

std::string buffer_name(int binding, std::string_view structure) {
  const char* what = "the memory";
  if (binding == ENCORE_BINDING_NODES) what = "the nodes";
  if (binding == ENCORE_BINDING_REFERENCES) what = "the triangle references";
  if (binding == ENCORE_BINDING_CELL_STARTS) what = "the cells";
  if (binding == ENCORE_BINDING_CELL_PLANES) what = "the cell boundaries";
  return std::string(what) + " of " + std::string(structure);
}

}  // namespace

GpuScene::GpuScene(std::shared_ptr<gl::Context> context, bool with_structure)
    : context_(gl::made_current(std::move(context))),
      with_structure_(with_structure),
      timer_(context_->capabilities().timestamp_bits) {}

Transfer GpuScene::upload_all(const RenderInput& input) {
  if (input.scene == nullptr || input.triangles == nullptr ||
      (with_structure_ && input.structure == nullptr)) {
    throw std::invalid_argument(with_structure_
                                    ? "the GPU tracer needs a scene, its triangles and a structure"
                                    : "the GPU needs a scene and its triangles");
  }
  context_->make_current();
  input_ = input;
  scene_version_.reset();
  triangle_version_.reset();
  topology_version_.reset();
  structure_version_.reset();
  structure_buffers_.clear();
  textures_.clear();
  return upload();
}

Transfer GpuScene::upload_changes() {
  if (input_.scene == nullptr) throw std::logic_error("the GPU was not given a scene");
  if (changed()) {
    context_->make_current();
    return upload();
  }
  rays_ = wanted_rays_;
  Transfer nothing;
  if (context_->capabilities().timestamp_bits > 0) nothing.device_s = 0.0;
  return nothing;
}

bool GpuScene::changed() const {
  const scene::TriangleList& list = *input_.triangles;
  return scene_version_ != input_.scene->version() || triangle_version_ != list.version ||
         topology_version_ != list.topology_version ||
         needs_ != scene::needs_of(*input_.scene, list, wanted_rays_) ||
         (with_structure_ && structure_version_ != input_.structure->version());
}

Transfer GpuScene::upload() {
  const scene::TriangleList& list = *input_.triangles;
  const scene::Needs before =
      std::exchange(needs_, scene::needs_of(*input_.scene, list, wanted_rays_));
  shading_ = shading_needs(needs_);
  rays_ = wanted_rays_;

  Transfer sum;
  timer_.begin();
  if (topology_version_ != list.topology_version) {
    send_triangles(sum);
  } else {
    // What shading did not ask for until now was never sent; if it does not fit, nothing counts.
    const auto version = std::exchange(topology_version_, std::nullopt);
    if (needs_.normals && !before.normals) send(normals_, bytes_of(list.normals), sum);
    if (needs_.colors && !before.colors) send(colors_, bytes_of(list.colors), sum);
    if (needs_.textures && !before.textures) send(texcoords_, bytes_of(list.texcoords), sum);
    topology_version_ = version;
    if (triangle_version_ != list.version) send_ranges(sum);
  }
  if (with_structure_ && structure_version_ != input_.structure->version()) send_structure(sum);
  const bool bounces = needs_.reflections || needs_.refractions;
  if (scene_version_ != input_.scene->version() || needs_.textures != before.textures ||
      (bounces && !(before.reflections || before.refractions))) {
    send_materials(sum);
  }
  timer_.end();
  gl::finish("sending the scene to the device");
  sum.device_s = timer_.seconds();
  context_->check("sending the scene to the device");
  return sum;
}

void GpuScene::send(gl::Buffer& buffer, std::span<const std::byte> bytes, Transfer& sum) {
  buffer.reserve(bytes.size(), context_->capabilities().storage_block_bytes);
  if (!bytes.empty()) buffer.write(bytes);
  sum.uploaded_bytes += bytes.size();
}

void GpuScene::send_triangles(Transfer& sum) {
  const scene::TriangleList& list = *input_.triangles;
  topology_version_.reset();  // the copies are of no use if one of them does not fit
  send(triangles_, bytes_of(list.triangles), sum);
  if (needs_.normals) send(normals_, bytes_of(list.normals), sum);
  if (needs_.colors) send(colors_, bytes_of(list.colors), sum);
  if (needs_.textures) send(texcoords_, bytes_of(list.texcoords), sum);
  triangle_count_ = static_cast<std::uint32_t>(list.triangles.size());
  triangle_version_ = list.version;
  topology_version_ = list.topology_version;
}

void GpuScene::send_ranges(Transfer& sum) {
  const scene::TriangleList& list = *input_.triangles;
  for (const scene::TriangleRange& range : scene::changed_since(list, *triangle_version_)) {
    send_range(triangles_, list.triangles, range, sum);
    if (needs_.normals) send_range(normals_, list.normals, range, sum);
    if (needs_.colors) send_range(colors_, list.colors, range, sum);
    if (needs_.textures) send_range(texcoords_, list.texcoords, range, sum);
  }
  triangle_version_ = list.version;
}

void GpuScene::send_structure(Transfer& sum) {
  const accel::AccelerationStructure& structure = *input_.structure;
  structure_version_.reset();
  const accel::GpuBuffers buffers = structure.gpu_buffers();
  if (structure_buffers_.empty()) {
    for (const accel::GpuBuffer& part : buffers) {
      structure_buffers_.push_back(
          {part.binding, gl::Buffer(buffer_name(part.binding, structure.name()))});
    }
  }
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    send(structure_buffers_[i].buffer, buffers[i].bytes, sum);
  }
  structure_ = structure.gpu_parameters();
  structure_block_.reserve(sizeof structure_, std::numeric_limits<std::uint64_t>::max());
  structure_block_.write(std::as_bytes(std::span(&structure_, 1)));
  structure_version_ = structure.version();
}

void GpuScene::send_materials(Transfer& sum) {
  const scene::Scene& scene = *input_.scene;
  scene_version_.reset();
  if (needs_.textures) send_textures(sum);
  const Textures& textures = needs_.textures ? textures_ : Textures{};
  std::vector<gpu::Material> materials;
  std::vector<gpu::Bounce> bounces;
  materials.reserve(scene.materials.size() + 1);
  const auto add = [&](const scene::Material& material) {
    materials.push_back(to_gpu(material, number_of(textures, material)));
    if (needs_.reflections || needs_.refractions) bounces.push_back(bounce_of(material));
  };
  for (const scene::Material& material : scene.materials) add(material);
  // Triangles whose material does not exist take the last one.
  add(scene::Material{});
  std::vector<gpu::Light> lights;
  lights.reserve(scene.lights.size());
  for (const scene::Light& light : scene.lights) lights.push_back(to_gpu(light));

  const std::uint64_t before = sum.uploaded_bytes;
  send(materials_, bytes_of(materials), sum);
  if (!bounces.empty()) send(bounces_, bytes_of(bounces), sum);
  send(lights_, bytes_of(lights), sum);
  sum.converted_bytes += sum.uploaded_bytes - before;
  material_count_ = static_cast<std::uint32_t>(materials.size());
  light_count_ = static_cast<std::uint32_t>(lights.size());
  scene_version_ = scene.version();
}

void GpuScene::send_textures(Transfer& sum) {
  Textures worn = worn_textures(*input_.scene);
  if (worn == textures_) return;
  textures_.clear();  // the copies are of no use if they do not all fit
  constexpr std::uint64_t kTableWords = 256;
  constexpr std::uint64_t kHeaderWords = 4;
  std::vector<std::uint32_t> head;
  for (std::uint32_t value = 0; value < kTableWords; ++value) {
    head.push_back(std::bit_cast<std::uint32_t>(linear_of_srgb(value)));
  }
  std::uint64_t first = kTableWords + kHeaderWords * worn.size();
  for (const auto& texture : worn) {
    head.insert(head.end(),
                {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(texture->width),
                 static_cast<std::uint32_t>(texture->height), 0U});
    first += texture->texels.size();
  }
  texels_.reserve(first * sizeof(std::uint32_t), context_->capabilities().storage_block_bytes);
  std::uint64_t place = 0;
  const auto append = [&](const std::vector<std::uint32_t>& words) {
    texels_.write(bytes_of(words), place);
    place += words.size() * sizeof(std::uint32_t);
  };
  append(head);
  sum.converted_bytes += place;
  for (const auto& texture : worn) append(texture->texels);
  sum.uploaded_bytes += place;
  textures_ = std::move(worn);
}

void GpuScene::bind() const {
  triangles_.bind_storage(ENCORE_BINDING_TRIANGLES);
  if (needs_.normals) normals_.bind_storage(ENCORE_BINDING_NORMALS);
  if (needs_.colors) colors_.bind_storage(ENCORE_BINDING_COLORS);
  if (needs_.textures) {
    texcoords_.bind_storage(ENCORE_BINDING_TEXCOORDS);
    texels_.bind_storage(ENCORE_BINDING_TEXTURES);
  }
  materials_.bind_storage(ENCORE_BINDING_MATERIALS);
  lights_.bind_storage(ENCORE_BINDING_LIGHTS);
  if (!with_structure_) return;
  for (const StructureBuffer& part : structure_buffers_) part.buffer.bind_storage(part.binding);
  structure_block_.bind_uniform(ENCORE_BINDING_STRUCTURE);
}

void GpuScene::bind_bounces() const {
  bounces_.bind_storage(ENCORE_BINDING_BOUNCES);
}

gl::Buffer* GpuScene::structure_buffer(int binding) {
  for (StructureBuffer& part : structure_buffers_) {
    if (part.binding == binding) return &part.buffer;
  }
  return nullptr;
}

gl::Buffer* GpuScene::nodes() {
  return structure_buffer(ENCORE_BINDING_NODES);
}

gl::Buffer* GpuScene::references() {
  return structure_buffer(ENCORE_BINDING_REFERENCES);
}

}  // namespace encore::renderer
