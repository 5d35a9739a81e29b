#pragma once

#include "accel/acceleration_structure.h"
#include "accel/counters.h"
#include "renderer/image.h"
#include "scene/camera.h"
#include "scene/ray.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::renderer {

/// What a renderer draws from. All referenced objects stay the caller's and must outlive the
/// renderer's use of them; the structure must be built over `triangles`. A renderer that traces no
/// rays needs no structure.
struct RenderInput {
  const scene::Scene* scene = nullptr;
  const scene::TriangleList* triangles = nullptr;
  const accel::AccelerationStructure* structure = nullptr;
};

/// What a device was sent the last time that it was.
struct Transfer {
  std::uint64_t converted_bytes = 0;  ///< rewritten into another layout before they were sent
  std::uint64_t uploaded_bytes = 0;
  std::optional<double> device_s;  ///< by the device's own clock, where it has one
};

/// What the rays of one picture came to, by their kind.
struct RayFigures {
  struct Kind {
    std::uint64_t rays = 0;
    /// Time that making and tracing them and shading what they hit took, summed over all workers
    /// (CPU), or of the device (GPU). Only shares of the sum over all kinds mean anything beside
    /// the picture's own time. Nothing where it was not told apart.
    std::optional<double> seconds{};
  };
  std::array<Kind, scene::kRayKinds> kinds{};

  Kind& operator[](scene::RayKind kind) { return kinds[static_cast<std::size_t>(kind)]; }
  const Kind& operator[](scene::RayKind kind) const {
    return kinds[static_cast<std::size_t>(kind)];
  }
  /// All rays of all kinds.
  [[nodiscard]] std::uint64_t rays() const;
  /// Share of the picture's time that a kind took, in [0, 1]; nothing where it was not told apart.
  [[nodiscard]] std::optional<double> share(scene::RayKind kind) const;
};

/// The interface of every renderer (thesis, appendix B): init once a scene and structure, refresh
/// whenever the triangles or the structure changed, draw as often as wanted.
class Renderer {
 public:
  virtual ~Renderer() = default;

  virtual void init(const RenderInput& input) = 0;
  /// Brings device copies up to date after the triangles or structure changed, and returns when the
  /// device has them. CPU: nothing to send.
  virtual void refresh() = 0;
  /// Which rays pictures are made of from now on. Takes effect with the next init() or refresh(),
  /// which leave out what these and the scene do not need (scene/needs.h). Renderers that trace no
  /// rays ignore it.
  virtual void set_rays(const scene::RaySettings& /*rays*/) {}
  /// Draws a picture of that size and returns when it is complete; it stays on the device.
  virtual void draw(const scene::Camera& camera, int width, int height) = 0;
  /// Draws only the samples `first` to `first + count - 1` of each pixel, of the samples that
  /// set_rays() has asked for: the mean of pictures of equal parts is the whole picture. What is
  /// drawn does not depend on what was drawn before. Renderers that trace no rays draw() instead.
  virtual void draw_samples(const scene::Camera& camera, int width, int height,
                            std::uint32_t /*first*/, std::uint32_t /*count*/) {
    draw(camera, width, height);
  }
  /// Fetches the last picture drawn; resizes `image`.
  virtual void read(Image& image) = 0;
  /// Draws into `image` at its size. No allocation after the first frame of a size.
  virtual void render(const scene::Camera& camera, Image& image) {
    draw(camera, image.width, image.height);
    read(image);
  }

  /// Parts of a picture that have not begun when `*flag` turns true are left undone; null: never.
  virtual void set_cancel_flag(const std::atomic<bool>* /*flag*/) {}
  /// Whether the last picture was drawn to its end.
  [[nodiscard]] virtual bool complete() const { return true; }
  /// Rays of the last picture that hit something, where that is counted on the way.
  [[nodiscard]] virtual std::optional<std::uint64_t> last_hits() const { return std::nullopt; }

  /// Rays of the last picture by kind; nothing where none were traced.
  [[nodiscard]] virtual std::optional<RayFigures> last_rays() const { return std::nullopt; }

  /// Whether the renderer works on copies that refresh() has to send.
  [[nodiscard]] virtual bool transfers() const { return false; }
  /// What the last init() or refresh() sent.
  [[nodiscard]] virtual Transfer last_transfer() const { return {}; }
  /// How long the last picture took by the device's own clock, where it has one.
  [[nodiscard]] virtual std::optional<double> last_draw_s() const { return std::nullopt; }
  /// The device by name and, where it is not what the name promises, what it is: "llvmpipe (LLVM
  /// 15.0.6, 256 bits), software, runs on the CPU". Empty: the CPU itself.
  [[nodiscard]] virtual std::string device_name() const { return {}; }
};

/// A renderer that traces rays through an acceleration structure.
class Tracer : public Renderer {
 public:
  /// Whether refit() is there: the device can fit its own copy of the structure to triangles that
  /// moved, without the host's help.
  [[nodiscard]] virtual bool can_refit() const { return false; }
  /// Fits the device's copy to the triangles that the last refresh() sent, and returns when it is
  /// done. The host's structure stays as it was. Throws std::logic_error unless can_refit().
  virtual void refit();

  /// Whether build() is there: the device can build a tree over the triangles that it was sent,
  /// which takes the place of the host's structure until another one is sent.
  [[nodiscard]] virtual bool can_build() const { return false; }
  /// Builds over the triangles that the last refresh() sent, and returns when it is done: rays go
  /// through that tree from now on, and refit() fits it. It is given up when the host's structure
  /// was built or updated, or triangles come, go or change places, with the refresh() that says so.
  /// The host's structure stays as it was. Throws std::logic_error unless can_build().
  virtual void build();

  /// Only the nearest hits, row by row from the top left, without shading; resizes `hits`.
  virtual void trace_hits(const scene::Camera& camera, int width, int height,
                          std::vector<scene::Hit>& hits) = 0;
  /// What the ray of each pixel cost, in the same order; resizes `counters`.
  virtual void trace_counters(const scene::Camera& camera, int width, int height,
                              std::vector<accel::TraceCounters>& counters) = 0;
  /// The nearest hits of any rays; hits.size() == rays.size().
  virtual void trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) = 0;
};

}  // namespace encore::renderer
