#pragma once

#include "accel/settings.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace encore::accel {

/// Counts the requests that a build makes to the system's allocator (thesis Table 3: MC and MS).
struct AllocationCount {
  std::uint64_t requests = 0;
  std::uint64_t bytes = 0;
};

/// A flat array of trivially copyable values for structure memory: uninitialised, counted, and
/// obedient to the memory mode. In `pool` mode memory is kept from build to build and only grows;
/// in `fresh` mode each build starts from nothing. Starts at a cache line.
template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Makes room for exactly `size` uninitialised values; earlier content is lost.
  void reset(std::size_t size, MemoryMode mode, AllocationCount& count) {
    if (mode == MemoryMode::fresh || size > capacity_) {
      data_.reset();  // before allocating, so that the peak holds one block, not two
      capacity_ = 0;
      allocate(size, count);
    }
    size_ = size;
  }

  /// Grows to at least `size` values, doubling the capacity and keeping the content.
  void grow(std::size_t size, AllocationCount& count) {
    if (size > capacity_) {
      Memory old = std::move(data_);
      const std::size_t doubled = capacity_ * 2;
      allocate(size > doubled ? size : doubled, count);
      if (old) std::memcpy(data_.get(), old.get(), size_ * sizeof(T));
    }
    size_ = size;
  }

  /// Forgets values past `size` without giving memory back.
  void shrink(std::size_t size) { size_ = size; }
  void release() {
    data_.reset();
    size_ = capacity_ = 0;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* data() { return data_.get(); }
  [[nodiscard]] const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  [[nodiscard]] std::span<T> span() { return {data_.get(), size_}; }
  [[nodiscard]] std::span<const T> span() const { return {data_.get(), size_}; }
  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(span()); }

 private:
  static constexpr std::align_val_t kLine{64};
  static_assert(alignof(T) <= std::size_t{64});
  struct Free {
    void operator()(T* values) const { ::operator delete[](values, kLine); }
  };
  using Memory = std::unique_ptr<T[], Free>;

  void allocate(std::size_t size, AllocationCount& count) {
    if (size == 0) return;
    data_ = Memory(new (kLine) T[size]);  // default-initialised: no clearing of trivial types
    capacity_ = size;
    ++count.requests;
    count.bytes += size * sizeof(T);
  }

  Memory data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace encore::accel
