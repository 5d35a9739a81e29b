#include "renderer/cpu_tracer.h"

#include "accel/task_handover.h"
#include "renderer/camera_rays.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>

namespace encore::renderer {

namespace {

using scene::Hit;
using scene::Ray;

// Packets take squares of 8 x 8 of it (accel/wide). This size keeps all workers
// busy to the end of a small image, and a tile's rays and hits (12 KiB) in the first-level cache.
constexpr int kTileWidth = 16;
constexpr int kTileHeight = 16;
constexpr std::size_t kTilePixels = std::size_t{kTileWidth} * kTileHeight;
static_assert(kTilePixels <= kBatchRays);

/// The rays and hits of one tile; lies on the stack of the thread that works on it.
struct TileBuffer {
  std::array<Ray, kTilePixels> ray_store;
  std::array<Hit, kTilePixels> hit_store;
  std::span<Ray> rays;
  std::span<Hit> hits;

  TileBuffer(const CameraFrame& frame, const PixelRect& tile)
      : rays(std::span(ray_store).first(tile.count())),
        hits(std::span(hit_store).first(tile.count())) {
    camera_rays(frame, tile, rays);
  }

  void trace(const accel::AccelerationStructure& structure, const PixelRect& tile) {
    structure.intersect_tile(rays, static_cast<std::size_t>(tile.width()), hits);
  }
};

std::size_t pixel_index(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

/// Copies a tile's values to their places in an image of `width` pixels a row.
template <class T>
void store_tile(const PixelRect& tile, std::span<const T> values, int width, std::vector<T>& all) {
  const auto columns = static_cast<std::size_t>(tile.width());
  for (int y = tile.y0; y < tile.y1; ++y) {
    const auto row = values.subspan(static_cast<std::size_t>(y - tile.y0) * columns, columns);
    std::copy(row.begin(), row.end(), &all[pixel_index(tile.x0, y, width)]);
  }
}

std::uint64_t count_hits(std::span<const Hit> hits) {
  std::uint64_t found = 0;
  for (const Hit& hit : hits) found += hit.found() ? 1 : 0;
  return found;
}

}  // namespace

CpuTracer::CpuTracer(int threads)
    : threads_(threads > 0 ? threads : tbb::this_task_arena::max_concurrency()) {
  // The library never has more threads than processors unless it is told to.
  if (threads_ > tbb::this_task_arena::max_concurrency()) {
    more_threads_.emplace(tbb::global_control::max_allowed_parallelism,
                          static_cast<std::size_t>(threads_));
  }
  if (threads_ > 1) arena_.emplace(threads_);
}

void CpuTracer::init(const RenderInput& input) {
  if (input.scene == nullptr || input.triangles == nullptr || input.structure == nullptr) {
    throw std::invalid_argument("the CPU tracer needs a scene, its triangles and a structure");
  }
  input_ = input;
  refresh();
}

void CpuTracer::refresh() {
  check_ready();
  const scene::Needs needs = scene::needs_of(*input_.scene, *input_.triangles, rays_);
  shade_ = choose_shading(shading_needs(needs));
  paths_.prepare(input_, needs, rays_, threads_);
  samples_ = static_cast<std::uint32_t>(rays_.samples);
}

CameraFrame CpuTracer::frame_for(const scene::Camera& camera, const Image& image) const {
  check_ready();
  const CameraFrame frame = make_camera_frame(camera, image.width, image.height);
  if (image.pixels.size() != PixelRect{0, 0, image.width, image.height}.count()) {
    throw std::invalid_argument("the image holds more or fewer pixels than its size says");
  }
  return frame;
}

void CpuTracer::render(const scene::Camera& camera, Image& image) {
  const CameraFrame frame = frame_for(camera, image);
  if (paths_.needed()) return trace_paths(frame, {.first = 0, .count = samples_}, image);
  cast(frame, image);
}

void CpuTracer::draw(const scene::Camera& camera, int width, int height) {
  picture_.resize(width, height);
  render(camera, picture_);
}

void CpuTracer::draw_samples(const scene::Camera& camera, int width, int height,
                             std::uint32_t first, std::uint32_t count) {
  check_ready();
  if (count == 0 || first >= samples_ || count > samples_ - first) {
    throw std::invalid_argument(fmt::format(
        "samples {} to {} of a picture that has {} a pixel were asked for; ask for at least one "
        "of those, counted from 0",
        first, static_cast<std::uint64_t>(first) + count - (count > 0 ? 1 : 0), samples_));
  }
  picture_.resize(width, height);
  const CameraFrame frame = frame_for(camera, picture_);
  if (paths_.needed()) return trace_paths(frame, {.first = first, .count = count}, picture_);
  cast(frame, picture_);
}

void CpuTracer::cast(const CameraFrame& frame, Image& image) {
  const ShadingScene shading{input_.scene, input_.triangles};
  for_each_tile(image.width, image.height, [&](const PixelRect& tile) {
    TileBuffer buffer(frame, tile);
    buffer.trace(*input_.structure, tile);
    hits_.fetch_add(count_hits(buffer.hits), std::memory_order_relaxed);
    // Shade row by row, as the rows of a tile lie apart in the image.
    const auto columns = static_cast<std::size_t>(tile.width());
    for (int y = tile.y0; y < tile.y1; ++y) {
      const std::size_t first = static_cast<std::size_t>(y - tile.y0) * columns;
      shade_(shading, buffer.rays.subspan(first, columns), buffer.hits.subspan(first, columns),
             {&image.pixels[pixel_index(tile.x0, y, image.width)], columns});
    }
  });
  figures_.emplace();
  (*figures_)[scene::RayKind::camera].rays =
      image.pixels.size() - left_out_.load(std::memory_order_relaxed);
}

void CpuTracer::trace_paths(const CameraFrame& frame, const SampleRange& samples, Image& image) {
  paths_.begin_picture();
  for_each_tile(image.width, image.height, [&](const PixelRect& tile) {
    const int worker = arena_ ? tbb::this_task_arena::current_thread_index() : 0;
    std::array<glm::vec3, kTilePixels> color_store;
    const auto colors = std::span(color_store).first(tile.count());
    if (paths_.draw_tile(frame, tile, samples, worker, cancel_, colors)) {
      store_tile<glm::vec3>(tile, colors, image.width, image.pixels);
    } else {
      complete_.store(false, std::memory_order_relaxed);
    }
  });
  hits_.store(paths_.camera_hits(), std::memory_order_relaxed);
  figures_ = paths_.figures();
}

void CpuTracer::trace_rays(std::span<const Ray> rays, std::span<Hit> hits) {
  check_ready();
  // As if the rays were an image of one row.
  for_each_tile(static_cast<int>(rays.size()), 1, [&](const PixelRect& tile) {
    const auto first = static_cast<std::size_t>(tile.x0);
    input_.structure->intersect(rays.subspan(first, tile.count()),
                                hits.subspan(first, tile.count()));
  });
}

void CpuTracer::trace_hits(const scene::Camera& camera, int width, int height,
                           std::vector<Hit>& hits) {
  check_ready();
  const CameraFrame frame = make_camera_frame(camera, width, height);
  hits.resize(PixelRect{0, 0, width, height}.count());
  for_each_tile(width, height, [&](const PixelRect& tile) {
    TileBuffer buffer(frame, tile);
    buffer.trace(*input_.structure, tile);
    hits_.fetch_add(count_hits(buffer.hits), std::memory_order_relaxed);
    store_tile<Hit>(tile, buffer.hits, width, hits);
  });
}

void CpuTracer::trace_counters(const scene::Camera& camera, int width, int height,
                               std::vector<accel::TraceCounters>& counters) {
  check_ready();
  const CameraFrame frame = make_camera_frame(camera, width, height);
  counters.resize(PixelRect{0, 0, width, height}.count());
  for_each_tile(width, height, [&](const PixelRect& tile) {
    TileBuffer buffer(frame, tile);
    std::array<accel::TraceCounters, kTilePixels> counter_store;
    const auto costs = std::span(counter_store).first(tile.count());
    input_.structure->intersect_counted(buffer.rays, buffer.hits, costs);
    hits_.fetch_add(count_hits(buffer.hits), std::memory_order_relaxed);
    store_tile<accel::TraceCounters>(tile, costs, width, counters);
  });
}

template <class TileWork>
void CpuTracer::for_each_tile(int width, int height, const TileWork& work) {
  const int columns = (width + kTileWidth - 1) / kTileWidth;
  const int rows = (height + kTileHeight - 1) / kTileHeight;
  hits_.store(0, std::memory_order_relaxed);
  complete_.store(true, std::memory_order_relaxed);
  left_out_.store(0, std::memory_order_relaxed);
  const auto run_tile = [&](int index) {
    const int x = index % columns * kTileWidth;
    const int y = index / columns * kTileHeight;
    const PixelRect tile{x, y, std::min(x + kTileWidth, width), std::min(y + kTileHeight, height)};
    if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) {
      complete_.store(false, std::memory_order_relaxed);
      left_out_.fetch_add(tile.count(), std::memory_order_relaxed);
      return;
    }
    work(tile);
  };

  if (!arena_) {
    for (int index = 0; index < columns * rows; ++index) run_tile(index);
    return;
  }
  // One tile a task: tiles differ a hundredfold in cost, and a task costs far less than a tile.
  const auto run_tiles = [&](const tbb::blocked_range<int>& range) {
    for (int index = range.begin(); index < range.end(); ++index) run_tile(index);
  };
  accel::TaskHandover handover;
  arena_->execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, columns * rows, 1),
        [&](const tbb::blocked_range<int>& range) ENCORE_NOT_THREAD_SANITIZED {
          const accel::TaskHandover::Task task(handover);
          run_tiles(range);
        },
        tbb::simple_partitioner());
  });
}

void CpuTracer::check_ready() const {
  if (input_.structure == nullptr) throw std::logic_error("the CPU tracer was not given a scene");
}

}  // namespace encore::renderer
