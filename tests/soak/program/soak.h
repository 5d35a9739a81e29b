#pragma once

#include "renderer/cpu_tracer.h"
#include "renderer/gl/context.h"
#include "renderer/gpu_tracer.h"
#include "renderer/image.h"
#include "renderer/raster_renderer.h"
#include "tests/soak/program/legs.h"
#include "tests/soak/program/memory_use.h"
#include "tests/soak/program/spot_check.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace encore::test {

struct SoakPlan {
  std::uint64_t seed = 1;
  int size = 64;                  ///< pictures' width and height
  std::size_t checked_rays = 24;  ///< a frame
  /// The product of all choices is dealt out to this many slices; round k takes slice k modulo
  /// `slices_used`. So the whole product passes once in `slices` rounds where both are the same.
  std::size_t slices = 1;
  std::size_t slices_used = 1;

  /// Rounds that memory is not judged by: each slice has to have come once, and the pools of
  /// TBB's threads fill for four rounds or so, whoever comes to do what.
  [[nodiscard]] std::size_t warm_up() const { return slices_used > 4 ? slices_used : 4; }
};

struct SoakTally {
  std::uint64_t rounds = 0;
  std::uint64_t legs = 0;
  std::uint64_t frames = 0;
  std::uint64_t builds = 0;
  std::uint64_t updates = 0;
  std::uint64_t device_refits = 0;
  SpotCheckTally checks;
  std::uint64_t pictures = 0;  ///< held to the same picture by other means
  std::uint64_t wrong_pictures = 0;
  std::string first_wrong_picture;
  std::vector<MemoryUse> memory;  ///< after each round, with no scene loaded
};

/// Bounds of what verdict() lets pass, as shares.
inline constexpr double kMostInUseDrift = 0.01;
inline constexpr double kMostResidentDrift = 0.05;
inline constexpr double kMostLooseDifferences = 0.02;
inline constexpr std::size_t kRoundsForResident = 6;
/// What is wrong with a soak, a line each; empty: nothing. Memory is judged after a first pass over
/// the slices: bytes in use, by the least-squares line and from first to last; resident bytes by
/// the line, once there are enough rounds.
std::vector<std::string> verdict(const SoakTally& tally, const SoakPlan& plan);

/// Draws every leg's frames, one renderer a device for all of them, and holds rays and pictures to
/// the truth.
class Soak {
 public:
  /// `context`: null for a machine without OpenGL.
  Soak(const SoakPlan& plan, const std::shared_ptr<renderer::gl::Context>& context);
  ~Soak();

  /// One round; ends early, without noting memory, when go_on() says no between two legs.
  void round(const std::function<bool()>& go_on = [] { return true; });
  [[nodiscard]] const SoakTally& tally() const { return tally_; }
  [[nodiscard]] const std::vector<Leg>& legs() const { return legs_; }

 private:
  struct LiveScene;
  struct Frame;
  struct PictureKey {
    std::string scene;
    std::size_t rays;
    int frame;
    auto operator<=>(const PictureKey&) const = default;
  };

  void run(const Leg& leg);
  void begin(const Leg& leg, Frame& frame);
  void go_on(const Leg& leg, Frame& frame);
  void check_hits(const Leg& leg, Frame& frame);
  void check_picture(const Leg& leg, const Frame& frame);
  const renderer::Image& reference(const Leg& leg, const Frame& frame);
  void settle();
  [[nodiscard]] renderer::Renderer& renderer_of(SoakDevice device);
  [[nodiscard]] LiveScene& scene_of(const std::string& name);

  SoakPlan plan_;
  std::vector<Leg> legs_;
  SoakTally tally_;
  renderer::CpuTracer cpu_;
  renderer::CpuTracer reference_tracer_;
  std::unique_ptr<renderer::GpuTracer> gpu_;
  std::unique_ptr<renderer::RasterRenderer> raster_;
  std::unique_ptr<LiveScene> tiny_;  ///< what renderers hold between rounds
  // Of the round.
  std::map<std::string, std::unique_ptr<LiveScene>> scenes_;
  std::map<PictureKey, renderer::Image> references_;
  std::uint64_t check_seed_ = 0;
};

}  // namespace encore::test
