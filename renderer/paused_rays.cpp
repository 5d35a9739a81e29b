#include "renderer/paused_rays.h"

#include "shaders/shared/bindings.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace encore::renderer {

namespace {

// Far more than enough rays to keep a processor busy.
constexpr std::uint64_t kMostSlotBytes = std::uint64_t{32} << 20;

}  // namespace

void PausedRays::run(const PausingPrograms& programs, const PixelRect& piece, int width,
                     std::uint32_t words, std::uint64_t most, const Send& send) {
  words_ = words;
  const std::uint64_t ray_bytes = std::uint64_t{words} * sizeof(std::uint32_t);
  const std::uint64_t rays = std::max(std::min(most, kMostSlotBytes) / ray_bytes, std::uint64_t{1});
  // Whole rows, or parts of a single one where it is too long.
  const auto rows = static_cast<int>(std::clamp<std::uint64_t>(
      rays / static_cast<std::uint64_t>(width), 1, static_cast<std::uint64_t>(piece.height())));
  const auto columns = static_cast<int>(std::min(rays, static_cast<std::uint64_t>(piece.width())));
  const auto slots = static_cast<std::uint64_t>(rows - 1) * static_cast<std::uint64_t>(width) +
                     static_cast<std::uint64_t>(columns);
  slots_.reserve(slots * ray_bytes, most);
  count_.reserve(sizeof(std::uint32_t), most);
  slots_.bind_storage(ENCORE_BINDING_PAUSED_RAYS);
  count_.bind_storage(ENCORE_BINDING_PAUSED_COUNT);
  for (int y = piece.y0; y < piece.y1; y += rows) {
    for (int x = piece.x0; x < piece.x1; x += columns) {
      const PixelRect part{x, y, std::min(x + columns, piece.x1), std::min(y + rows, piece.y1)};
      const int first_slot = part.y0 * width + part.x0;
      std::uint32_t left = send_once(*programs.first, part, first_slot, send);
      while (left > 0) left = send_once(programs.resumable(), part, first_slot, send);
    }
  }
}

std::uint32_t PausedRays::send_once(const gl::Program& program, const PixelRect& part,
                                    int first_slot, const Send& send) {
  program.set("first_slot", first_slot);
  program.set("slot_words", static_cast<int>(words_));
  std::uint32_t left = 0;
  count_.fill(0, sizeof left);
  send(program, part);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  count_.read(std::as_writable_bytes(std::span(&left, 1)));
  return left;
}

}  // namespace encore::renderer
