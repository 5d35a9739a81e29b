#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace encore::scene {

/// The number that lies at `bytes` (of any alignment); `swap`: with its bytes the other way round.
template <typename Value, bool swap>
inline Value load_bytes(const char* bytes) {
  if constexpr (!swap || sizeof(Value) == 1) {
    Value value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  } else if constexpr (sizeof(Value) == 2) {
    return std::bit_cast<Value>(__builtin_bswap16(load_bytes<std::uint16_t, false>(bytes)));
  } else if constexpr (sizeof(Value) == 4) {
    return std::bit_cast<Value>(__builtin_bswap32(load_bytes<std::uint32_t, false>(bytes)));
  } else {
    return std::bit_cast<Value>(__builtin_bswap64(load_bytes<std::uint64_t, false>(bytes)));
  }
}

}  // namespace encore::scene
