#include "scene/load_watch.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/scenes.h"
#include "scene/samples/sculpture.h"
#include "scene/samples/stage.h"

namespace encore::scene::samples {

namespace {

constexpr int kDrops = 7;
constexpr int kFrames = 48;

/// Centre of a drop at a share in [0, 1] of the loop: whole numbers of turns along each axis, so
/// that the loop closes.
Vec drop_at(int i, double share) {
  const double phase = double(i) / kDrops;
  const auto swing = [&](int turns, double offset) {
    return portable_sin(2.0 * kPi * (turns * share + offset));
  };
  return {7.6 * swing(1 + i % 2, phase), 7.6 * swing(1 + i / 2 % 2, 2.6 * phase + 0.2),
          4.0 * swing(1, 1.7 * phase + 0.45)};
}

glm::vec3 drop_color(int i) {
  static constexpr float kColors[kDrops][3] = {
      {0.95F, 0.35F, 0.2F}, {0.98F, 0.75F, 0.2F}, {0.35F, 0.75F, 0.35F}, {0.2F, 0.65F, 0.8F},
      {0.3F, 0.4F, 0.9F},   {0.65F, 0.35F, 0.8F}, {0.9F, 0.4F, 0.6F}};
  return {kColors[i][0], kColors[i][1], kColors[i][2]};
}

std::shared_ptr<const Model> drops_at(double share) {
  Sculpture s;
  for (int i = 0; i < kDrops; ++i) s.ball(drop_at(i, share), 2.9 + 0.25 * (i % 4), 2.2);
  // Every frame is sampled with the same cells, so merging drops lose triangles.
  Mesh mesh = s.surface(0.5);
  smooth_normals(mesh);
  // Each vertex mixes the colours of the drops, the nearest weighing most.
  for (const glm::vec3& p : mesh.positions) {
    Vec color(0.0);
    double total = 0.0;
    for (int i = 0; i < kDrops; ++i) {
      const Vec d = widen(p) - drop_at(i, share);
      const double weight = 1.0 / (dot(d, d) * dot(d, d) + 1e-3);
      color += widen(drop_color(i)) * weight;
      total += weight;
    }
    mesh.colors.push_back(narrow(color * (1.0 / total)));
  }
  return make_model("drops", std::move(mesh), {paint("drops", glm::vec3(1.0F), 0.6F, 60.0F)});
}

}  // namespace

Scene wave() {
  constexpr int kLines = 100;
  Mesh cloth = uv_grid(kLines, kLines, false, false, [](double u, double v) {
    return Vec(27.0 * (u - 0.5), 0.0, 27.0 * (0.5 - v));
  });
  // Squares of ten by ten quads, two triangles each, in two colours.
  for (int i = 0; i < kLines * kLines; ++i) {
    const int square = i % kLines / 10 + i / kLines / 10;
    cloth.material_of.insert(cloth.material_of.end(), 2, std::uint32_t(square % 2));
  }
  cloth = moved(std::move(cloth), Frame{}.turned({1.0, 0.0, 0.0}, 38.0));
  smooth_normals(cloth);
  Scene scene = single(
      "wave", std::move(cloth),
      {paint("teal", {0.1F, 0.5F, 0.55F}, 0.4F), paint("cream", {0.95F, 0.9F, 0.78F}, 0.4F)});
  Deformer deformer;
  deformer.kind = Deformer::Kind::wave;
  deformer.axis = narrow(rotate({0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, 38.0));
  deformer.amplitude = 1.4F;
  deformer.wavelength = 13.0F;
  deformer.frequency_hz = 0.5F;
  scene.instances.front().motion = deformer;
  return scene;
}

Scene metaballs() {
  FrameSequence sequence;
  sequence.frames_per_second = 8.0F;
  for (int frame = 0; frame < kFrames; ++frame) {
    const FramePart part{std::size_t(frame), std::size_t(kFrames)};
    sequence.frames.push_back(drops_at(double(frame) / kFrames));
  }
  Scene scene = stage("metaballs");
  place(scene, sequence.frames.front()).motion = std::move(sequence);
  return scene;
}

}  // namespace encore::scene::samples
