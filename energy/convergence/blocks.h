#pragma once

#include "energy/units.h"

#include <cstddef>
#include <span>
#include <vector>

namespace encore::energy {

/// An amount over a weight in a stretch of time: seconds over operations, joules over seconds,
/// joules over operations.
struct Block {
  Seconds middle;  ///< of the stretch
  Seconds length;  ///< of what was added; pauses between are not in it
  double amount = 0.0;
  double weight = 0.0;

  [[nodiscard]] double ratio() const { return amount / weight; }
};

/// A series of ratios in bounded memory: blocks of equally many additions. At `capacity` blocks
/// neighbours merge in pairs and later blocks hold twice as many, so that sums and the ratios of
/// long stretches stay exact however long it grows; only detail goes.
class BlockSeries {
 public:
  explicit BlockSeries(std::size_t capacity = 512);

  /// Adds what happened in [start, end]; times rise. An addition without weight waits for the next.
  void add(Seconds start, Seconds end, double amount, double weight);

  /// The full blocks, in order; the last additions may be in none yet.
  [[nodiscard]] std::span<const Block> blocks() const { return blocks_; }
  /// The full blocks and, behind them, what is left.
  [[nodiscard]] std::vector<Block> all() const;
  [[nodiscard]] std::size_t additions_per_block() const { return per_block_; }
  [[nodiscard]] std::size_t additions() const { return additions_; }
  /// Sum of the lengths of everything added.
  [[nodiscard]] Seconds length() const { return length_; }

 private:
  struct Open {
    Block sum;
    std::size_t additions = 0;
    bool empty = true;
  };
  void merge_pairs();

  std::size_t capacity_;
  std::size_t per_block_ = 1;
  std::size_t additions_ = 0;
  Seconds length_;
  std::vector<Block> blocks_;
  Open open_;
};

}  // namespace encore::energy
