#include "renderer/gl/buffer.h"

#include "renderer/gl/error.h"
#include "renderer/gl/error_queue.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace encore::renderer::gl {

namespace {

// No shader or draw call looks at this binding, so nothing of the caller's is disturbed.
constexpr GLenum kTarget = GL_COPY_WRITE_BUFFER;

/// "156.3 MiB"
std::string size_text(std::uint64_t bytes) {
  if (bytes < 1024) return fmt::format("{} bytes", bytes);
  constexpr const char* kUnits[] = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  double count = static_cast<double>(bytes) / 1024.0;
  std::size_t unit = 0;
  for (; count >= 1024.0 && unit + 1 < std::size(kUnits); ++unit) count /= 1024.0;
  return fmt::format("{:.4g} {}", count, kUnits[unit]);
}

void check_fits(const std::string& name, std::size_t offset, std::size_t bytes,
                std::size_t capacity) {
  if (offset <= capacity && bytes <= capacity - offset) return;
  throw std::logic_error(fmt::format("{}: bytes {} to {} are not within the {} reserved", name,
                                     offset, offset + bytes, capacity));
}

}  // namespace

Buffer::~Buffer() {
  if (id_ != 0) glDeleteBuffers(1, &id_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : name_(std::move(other.name_)),
      id_(std::exchange(other.id_, 0)),
      capacity_(std::exchange(other.capacity_, 0)) {}

void Buffer::reserve(std::size_t bytes, std::uint64_t most) {
  constexpr std::size_t kLeast = 16;  // as large as any member of a block
  bytes = std::max(bytes, kLeast);
  if (bytes > most) {
    throw GlError(fmt::format(
        "{}: {} are needed, but this device's largest storage buffer is {}; use another "
        "structure, a smaller scene or picture, or --device cpu",
        name_, size_text(bytes), size_text(most)));
  }
  if (bytes <= capacity_) return;

  const auto limit = static_cast<std::size_t>(most);
  std::size_t room = std::min(std::max(bytes, capacity_ + capacity_ / 2), limit);
  room = std::min((room + 3) / 4 * 4, std::max(bytes, limit / 4 * 4));
  if (id_ == 0) glGenBuffers(1, &id_);
  discard_errors();
  capacity_ = 0;
  glBindBuffer(kTarget, id_);
  // This hint keeps it in the device's own memory; others let drivers choose the host's.
  glBufferData(kTarget, static_cast<GLsizeiptr>(room), nullptr, GL_STATIC_COPY);
  const GLenum error = glGetError();
  glBindBuffer(kTarget, 0);
  if (error != GL_NO_ERROR) {
    throw GlError(fmt::format(
        "{}: the device has no room for {} ({}); close other programs that use it, use a smaller "
        "scene or picture, or --device cpu",
        name_, size_text(room), error_name(error)));
  }
  capacity_ = room;
}

void Buffer::write(std::span<const std::byte> bytes, std::size_t offset) {
  check_fits(name_, offset, bytes.size(), capacity_);
  if (bytes.empty()) return;
  // What shaders wrote before must not arrive after this.
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(kTarget, id_);
  glBufferSubData(kTarget, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                  bytes.data());
  glBindBuffer(kTarget, 0);
}

void Buffer::read(std::span<std::byte> bytes, std::size_t offset) const {
  check_fits(name_, offset, bytes.size(), capacity_);
  if (bytes.empty()) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(kTarget, id_);
  glGetBufferSubData(kTarget, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                     bytes.data());
  glBindBuffer(kTarget, 0);
}

void Buffer::fill(std::uint32_t value, std::size_t bytes) {
  check_fits(name_, 0, bytes, capacity_);
  if (bytes % 4 != 0) throw std::logic_error(name_ + ": only whole 32-bit values can be filled");
  if (bytes == 0) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(kTarget, id_);
  glClearBufferSubData(kTarget, GL_R32UI, 0, static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER,
                       GL_UNSIGNED_INT, &value);
  glBindBuffer(kTarget, 0);
}

void Buffer::bind_storage(int binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), id_);
}

void Buffer::bind_uniform(int binding) const {
  glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding), id_);
}

}  // namespace encore::renderer::gl
