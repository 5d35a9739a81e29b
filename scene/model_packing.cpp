#include "scene/model_packing.h"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace encore::scene {

namespace {

class Packer {
 public:
  template <typename Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    append(&value, sizeof(Value));
  }
  void operator()(const std::string& text) { array(text); }
  template <typename Value>
  void operator()(const std::vector<Value>& values) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      array(values);
    } else {
      (*this)(static_cast<std::uint64_t>(values.size()));
      for (const Value& value : values) visit(value, *this);
    }
  }

  std::string bytes;

 private:
  template <typename Array>
  void array(const Array& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    if (!values.empty()) append(values.data(), values.size() * sizeof(values[0]));
  }
  void append(const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  }
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  template <typename Value>
  void operator()(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    take(&value, sizeof(Value));
  }
  void operator()(std::string& text) { array(text); }
  template <typename Value>
  void operator()(std::vector<Value>& values) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      array(values);
    } else {
      std::uint64_t count = 0;
      (*this)(count);
      for (std::uint64_t i = 0; i < count && ok_; ++i) visit(values.emplace_back(), *this);
    }
  }

  [[nodiscard]] bool complete() const { return ok_ && rest_.empty(); }

 private:
  template <typename Array>
  void array(Array& values) {
    std::uint64_t count = 0;
    (*this)(count);
    ok_ = ok_ && count <= rest_.size() / sizeof(values[0]);
    if (!ok_) return;
    values.resize(static_cast<std::size_t>(count));
    if (count > 0) take(values.data(), values.size() * sizeof(values[0]));
  }
  void take(void* data, std::size_t size) {
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) return;
    std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }

  std::string_view rest_;
  bool ok_ = true;
};

// One list of the fields for both ways. A material's texture is not among them: see PackedModel.
template <typename Text, typename Visitor>
requires std::is_same_v<std::remove_const_t<Text>, std::string>
void visit(Text& text, Visitor& visitor) {
  visitor(text);
}

template <typename AnyMaterial, typename Visitor>
requires std::is_same_v<std::remove_const_t<AnyMaterial>, Material>
void visit(AnyMaterial& m, Visitor& visitor) {
  visitor(m.name);
  visitor(m.diffuse);
  visitor(m.specular);
  visitor(m.ambient);
  visitor(m.emission);
  visitor(m.shininess);
  visitor(m.opacity);
  visitor(m.index_of_refraction);
  visitor(m.reflectivity);
  visitor(m.illumination_model);
}

template <typename AnyPacked, typename Visitor>
requires std::is_same_v<std::remove_const_t<AnyPacked>, PackedModel>
void visit(AnyPacked& packed, Visitor& visitor) {
  visitor(packed.error);
  visitor(packed.model.name);
  visitor(packed.model.mesh.positions);
  visitor(packed.model.mesh.normals);
  visitor(packed.model.mesh.texcoords);
  visitor(packed.model.mesh.colors);
  visitor(packed.model.mesh.triangles);
  visitor(packed.model.mesh.material_of);
  visitor(packed.model.materials);
  visitor(packed.model.warnings.messages);
  visitor(packed.dropped.bad_index);
  visitor(packed.dropped.non_finite);
  visitor(packed.dropped.two_corners);
  visitor(packed.dropped.intricate);
  visitor(packed.dropped.points);
  visitor(packed.dropped.lines);
  visitor(packed.dropped.first_bad_index);
  visitor(packed.dropped.first_non_finite);
  visitor(packed.textures);
  visitor(packed.embedded_textures);
}

}  // namespace

std::string pack_model(const PackedModel& packed) {
  Packer packer;
  visit(packed, packer);
  return std::move(packer.bytes);
}

bool unpack_model(std::string_view bytes, PackedModel& packed) {
  Unpacker unpacker(bytes);
  visit(packed, unpacker);
  return unpacker.complete();
}

}  // namespace encore::scene
