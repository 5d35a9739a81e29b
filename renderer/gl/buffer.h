#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace encore::renderer::gl {

/// A buffer on the device. Its memory grows when needed (by half again at least) and never shrinks;
/// nothing is allocated while it suffices.
class Buffer {
 public:
  /// `name` says in messages what it holds ("the nodes of bvh-median"). Nothing is allocated yet.
  explicit Buffer(std::string name) : name_(std::move(name)) {}
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&&) = delete;

  /// Makes room for `bytes` (at least 16) and forgets what was there if it has to grow. Throws
  /// GlError if that is more than `most` (Capabilities::storage_block_bytes), naming both, or if
  /// the device has no memory left.
  void reserve(std::size_t bytes, std::uint64_t most);
  /// Overwrites from `offset` on; must fit into what was reserved.
  void write(std::span<const std::byte> bytes, std::size_t offset = 0);
  /// Fetches from `offset` on; waits until the device has written it.
  void read(std::span<std::byte> bytes, std::size_t offset = 0) const;
  /// Fills the first `bytes` (a multiple of 4) with a 32-bit value, on the device.
  void fill(std::uint32_t value, std::size_t bytes);

  void bind_storage(int binding) const;
  void bind_uniform(int binding) const;
  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

 private:
  std::string name_;
  std::uint32_t id_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace encore::renderer::gl
