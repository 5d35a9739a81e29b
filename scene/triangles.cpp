#include "scene/triangles.h"

#include "scene/deform.h"
#include "scene/motion.h"
#include "scene/placement.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace encore::scene {
namespace {

/// What an instance looks like at one time; WrittenInstance keeps it for the next call.
WrittenInstance appearance(const Instance& instance, double time_s) {
  WrittenInstance w;
  w.model = instance.model;
  w.before = instance.transform;
  w.after = instance.placement;
  if (const auto* rigid = std::get_if<RigidMotion>(&instance.motion)) {
    w.before = pose_at(*rigid, time_s) * instance.transform;
  } else if (const auto* deformer = std::get_if<Deformer>(&instance.motion)) {
    w.phase = deformer_phase(*deformer, time_s);
  } else if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
    if (!sequence->frames.empty()) w.model = sequence->frames[frame_at(*sequence, time_s)];
  }
  return w;
}

bool looks_the_same(const WrittenInstance& a, const WrittenInstance& b) {
  return a.model == b.model && a.phase == b.phase && a.before == b.before && a.after == b.after;
}

/// Calls `visit` with every mesh that an instance may show.
template <class Visit>
void for_each_mesh(const Instance& instance, Visit&& visit) {
  if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
    for (const auto& frame : sequence->frames) visit(frame->mesh);
    if (!sequence->frames.empty()) return;
  }
  if (instance.model) visit(instance.model->mesh);
}

/// Whether one of the materials that an instance may show has a texture.
bool wears_texture(const Scene& scene, const Instance& instance) {
  std::size_t count = 0;
  if (instance.model) count = instance.model->materials.size();
  if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
    for (const auto& frame : sequence->frames) count = std::max(count, frame->materials.size());
  }
  const std::size_t first = std::min<std::size_t>(instance.first_material, scene.materials.size());
  const std::size_t last =
      std::min(first + std::max<std::size_t>(count, 1), scene.materials.size());
  return std::any_of(scene.materials.begin() + static_cast<std::ptrdiff_t>(first),
                     scene.materials.begin() + static_cast<std::ptrdiff_t>(last),
                     [](const Material& m) { return m.diffuse_texture != nullptr; });
}

bool same_connectivity(const WrittenInstance& a, const WrittenInstance& b) {
  if (a.first != b.first || a.count != b.count || a.left_out != b.left_out ||
      a.left_out_pattern != b.left_out_pattern) {
    return false;
  }
  if (a.model == b.model) return true;
  return a.model && b.model && a.model->mesh.triangles == b.model->mesh.triangles;
}

/// Stores `value` only if it differs, bit for bit; tells whether it did.
template <class T>
bool store(T& place, const T& value) {
  if (std::memcmp(&place, &value, sizeof(T)) == 0) return false;
  place = value;
  return true;
}

/// Empties a vector and gives its memory back.
template <class T>
void release(std::vector<T>& v) {
  std::vector<T>().swap(v);
}

/// One call of update_triangles.
class Update {
 public:
  Update(const Scene& scene, TriangleList& list) : scene_(scene), list_(list) {}

  TriangleChange run(double time_s);

 private:
  void prepare();
  void place_vertices(const Instance& instance, WrittenInstance& now);
  void write(const Instance& instance, WrittenInstance& now);
  void write_attributes(const Mesh& mesh, std::size_t place, const glm::uvec3& corners);
  void resize_arrays(std::size_t count);

  const Scene& scene_;
  TriangleList& list_;
  bool edited_ = false;   ///< the scene is not the one that was written: look at every instance
  bool changed_ = false;  ///< some value in the list differs from before
  bool topology_ = false;
  bool with_normals_ = false;
  bool with_colors_ = false;
  bool with_texcoords_ = false;
  std::size_t end_ = 0;  ///< triangles written so far
};

void Update::resize_arrays(std::size_t count) {
  list_.triangles.resize(count);
  if (with_normals_) list_.normals.resize(count);
  if (with_colors_) list_.colors.resize(count);
  if (with_texcoords_) list_.texcoords.resize(count);
}

/// After an edit: which attributes the scene has, and room for the largest frame of each instance,
/// so that no later call with the same count allocates.
void Update::prepare() {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  for (const Instance& instance : scene_.instances) {
    std::size_t most = 0;
    const bool textured = wears_texture(scene_, instance);
    for_each_mesh(instance, [&](const Mesh& mesh) {
      most = std::max(most, mesh.triangles.size());
      vertices = std::max(vertices, mesh.positions.size());
      with_normals_ = with_normals_ || !mesh.normals.empty();
      with_colors_ = with_colors_ || !mesh.colors.empty();
      with_texcoords_ = with_texcoords_ || (textured && !mesh.texcoords.empty());
    });
    triangles += most;
  }
  // Attributes that came or went change what lies beside every triangle.
  topology_ = list_.bookkeeping.scene_version == 0 ||
              list_.bookkeeping.instances.size() != scene_.instances.size();
  auto& book = list_.bookkeeping;
  changed_ = with_normals_ != book.has_normals || with_colors_ != book.has_colors ||
             with_texcoords_ != book.has_texcoords;
  book.has_normals = with_normals_;
  book.has_colors = with_colors_;
  book.has_texcoords = with_texcoords_;
  if (!with_normals_) release(list_.normals);
  if (!with_colors_) release(list_.colors);
  if (!with_texcoords_) release(list_.texcoords);
  list_.triangles.reserve(triangles);
  if (with_normals_) list_.normals.reserve(triangles);
  if (with_colors_) list_.colors.reserve(triangles);
  if (with_texcoords_) list_.texcoords.reserve(triangles);
  resize_arrays(list_.triangles.size());
  book.positions.reserve(vertices);
  if (with_normals_) book.vertex_normals.reserve(vertices);
  book.instances.resize(scene_.instances.size());
}

/// Fills the scratch arrays with the mesh's vertices in world space. An explosion moves triangles,
/// not vertices: its `after` is applied later, corner by corner.
void Update::place_vertices(const Instance& instance, WrittenInstance& now) {
  const Mesh& mesh = now.model->mesh;
  const auto* deformer = std::get_if<Deformer>(&instance.motion);
  auto& positions = list_.bookkeeping.positions;
  auto& normals = list_.bookkeeping.vertex_normals;
  // Without a deformer in between the two matrices are one.
  const glm::mat4 first = deformer != nullptr ? now.before : now.after * now.before;
  const PointTransform to_world(first);
  positions.resize(mesh.positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = to_world(mesh.positions[i]);
  normals.resize(mesh.normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    normals[i] = to_world.normal(mesh.normals[i]);
  }
  if (deformer == nullptr) return;

  if (edited_) now.centre = bounds_of_used(mesh, positions).center();
  deform(*deformer, now.phase, now.centre, positions, normals);
  if (now.after == glm::mat4(1.0F)) return;
  const PointTransform last(now.after);
  for (glm::vec3& n : normals) n = last.normal(n);
  if (deformer->kind == Deformer::Kind::explode) return;
  for (glm::vec3& p : positions) p = last(p);
}

void Update::write_attributes(const Mesh& mesh, std::size_t place, const glm::uvec3& corners) {
  const auto three = [&corners](const std::vector<glm::vec3>& of) {
    return std::array<glm::vec3, 3>{of[corners.x], of[corners.y], of[corners.z]};
  };
  if (with_normals_) {
    const auto& normals = list_.bookkeeping.vertex_normals;
    const auto value = normals.empty() ? std::array<glm::vec3, 3>{} : three(normals);
    changed_ |= store(list_.normals[place], value);
  }
  if (with_colors_) {
    const auto& colors = mesh.colors;
    const glm::vec3 one(1.0F);
    const auto value = colors.empty() ? std::array<glm::vec3, 3>{one, one, one} : three(colors);
    changed_ |= store(list_.colors[place], value);
  }
  if (with_texcoords_) {
    const auto& all = mesh.texcoords;
    std::array<glm::vec2, 3> value{};
    if (!all.empty()) value = {all[corners.x], all[corners.y], all[corners.z]};
    changed_ |= store(list_.texcoords[place], value);
  }
}

/// Writes an instance's triangles from `end_` on, leaving out those that no ray can be traced to.
void Update::write(const Instance& instance, WrittenInstance& now) {
  now.first = end_;
  if (!now.model) return;
  const Mesh& mesh = now.model->mesh;
  place_vertices(instance, now);
  const std::size_t room = end_ + mesh.triangles.size();
  if (list_.triangles.size() < room) resize_arrays(room);

  const auto* deformer = std::get_if<Deformer>(&instance.motion);
  const bool explodes = deformer != nullptr && deformer->kind == Deformer::Kind::explode;
  const PointTransform last(now.after);
  const auto& positions = list_.bookkeeping.positions;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& corners = mesh.triangles[i];
    const std::uint32_t material =
        instance.first_material + (mesh.material_of.empty() ? 0U : mesh.material_of[i]);
    Triangle t =
        make_triangle(positions[corners.x], positions[corners.y], positions[corners.z], material);
    if (explodes) {
      const glm::vec3 centroid = (t.v0 + t.v1 + t.v2) / 3.0F;
      const glm::vec3 offset = explode_offset(*deformer, now.phase, now.centre, centroid, i);
      t = make_triangle(last(t.v0 + offset), last(t.v1 + offset), last(t.v2 + offset), material);
    }
    if (!is_traceable(t)) {
      ++now.left_out;
      now.left_out_pattern = (now.left_out_pattern ^ i) * 0x100000001b3ULL + 1;
      continue;
    }
    changed_ |= store(list_.triangles[end_], t);
    write_attributes(mesh, end_, corners);
    ++end_;
  }
  now.count = end_ - now.first;
}

TriangleChange Update::run(double time_s) {
  auto& book = list_.bookkeeping;
  edited_ = book.scene_version != scene_.version();
  const std::size_t old_count = list_.triangles.size();
  if (edited_) {
    prepare();
  } else {
    with_normals_ = book.has_normals;
    with_colors_ = book.has_colors;
    with_texcoords_ = book.has_texcoords;
  }

  // Write what looks different or has to lie elsewhere than last time.
  std::uint64_t left_out = 0;
  for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
    WrittenInstance now = appearance(scene_.instances[i], time_s);
    WrittenInstance& before = book.instances[i];
    if (!edited_ && before.first == end_ && looks_the_same(before, now)) {
      end_ += before.count;
    } else {
      now.centre = before.centre;
      const bool changed_before = std::exchange(changed_, false);
      write(scene_.instances[i], now);
      const bool moved_places = !same_connectivity(before, now);
      now.version = changed_ || moved_places ? list_.version + 1 : before.version;
      changed_ = changed_ || changed_before;
      topology_ = topology_ || moved_places;
      before = std::move(now);
    }
    left_out += before.left_out;
  }
  resize_arrays(end_);
  list_.dropped_non_finite = left_out;
  book.scene_version = scene_.version();
  // A static scene is written once: the scratch space is not needed again.
  if (edited_ && !scene_.animated()) {
    release(book.positions);
    release(book.vertex_normals);
  }

  topology_ = topology_ || old_count != end_;
  if (!topology_ && !changed_) return TriangleChange::none;
  ++list_.version;
  if (!topology_) return TriangleChange::moved;
  ++list_.topology_version;
  return TriangleChange::topology;
}

}  // namespace

Bounds TriangleList::bounds() const {
  Bounds b;
  for (const Triangle& t : triangles) b.extend(bounds_of(t));
  return b;
}

std::vector<TriangleRange> changed_since(const TriangleList& list, std::uint64_t version) {
  std::vector<TriangleRange> ranges;
  for (const WrittenInstance& instance : list.bookkeeping.instances) {
    if (instance.version <= version || instance.count == 0) continue;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == instance.first) {
      ranges.back().count += instance.count;
    } else {
      ranges.push_back({instance.first, instance.count});
    }
  }
  return ranges;
}

TriangleChange update_triangles(const Scene& scene, double time_s, TriangleList& list) {
  return Update(scene, list).run(wrapped_time(time_s, scene.duration_s()));
}

}  // namespace encore::scene
