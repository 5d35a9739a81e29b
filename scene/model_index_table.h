#pragma once

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace encore::scene {

/// Numbers distinct keys in the order of their first appearance: a hash table with open addressing
/// that keeps nothing but the keys and their numbers. `Hash` gives 64 bits for a key; it need not
/// be good in the low bits.
template <typename Key, typename Hash>
class IndexTable {
 public:
  explicit IndexTable(Hash hash) : hash_(hash), slots_(64, kEmpty) {}

  /// The number of `key`, and whether it is new. Throws std::length_error beyond 32-bit numbers.
  std::pair<std::uint32_t, bool> insert(const Key& key) {
    if ((keys_.size() + 1) * 2 > slots_.size()) grow();
    std::uint32_t& slot = slots_[find(key)];
    if (slot != kEmpty) return {slot, false};
    if (keys_.size() >= kEmpty - 1) throw std::length_error("more keys than 32-bit numbers");
    slot = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
    return {slot, true};
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFU;

  std::size_t find(const Key& key) const {
    const std::size_t mask = slots_.size() - 1;
    std::uint64_t h = hash_(key);
    h ^= h >> 32U;
    h *= 0xD6E8FEB86659FD93ULL;
    h ^= h >> 32U;
    std::size_t at = h & mask;
    while (slots_[at] != kEmpty && !(keys_[slots_[at]] == key)) at = (at + 1) & mask;
    return at;
  }

  void grow() {
    slots_.assign(slots_.size() * 2, kEmpty);
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      slots_[find(keys_[i])] = static_cast<std::uint32_t>(i);
    }
  }

  Hash hash_;
  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace encore::scene
