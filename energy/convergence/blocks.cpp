#include "energy/convergence/blocks.h"

#include <algorithm>

namespace encore::energy {

namespace {

Block merged(const Block& a, const Block& b) {
  Block both;
  both.length = a.length + b.length;
  // The middle of both, each counting as it is long; exact for neighbours without a pause.
  const double share = both.length.value > 0 ? b.length / both.length : 0.5;
  both.middle = a.middle + (b.middle - a.middle) * share;
  both.amount = a.amount + b.amount;
  both.weight = a.weight + b.weight;
  return both;
}

}  // namespace

BlockSeries::BlockSeries(std::size_t capacity)
    : capacity_(std::max<std::size_t>(capacity, 2) & ~1U) {
  blocks_.reserve(capacity_);
}

void BlockSeries::add(Seconds start, Seconds end, double amount, double weight) {
  const Block addition{start + (end - start) * 0.5, end - start, amount, weight};
  open_.sum = open_.empty ? addition : merged(open_.sum, addition);
  open_.empty = false;
  length_ += end - start;
  if (!(open_.sum.weight > 0.0)) return;
  ++additions_;
  if (++open_.additions < per_block_) return;
  blocks_.push_back(open_.sum);
  open_ = {};
  if (blocks_.size() == capacity_) merge_pairs();
}

void BlockSeries::merge_pairs() {
  for (std::size_t i = 0; i + 1 < blocks_.size(); i += 2) {
    blocks_[i / 2] = merged(blocks_[i], blocks_[i + 1]);
  }
  blocks_.resize(blocks_.size() / 2);
  per_block_ *= 2;
}

std::vector<Block> BlockSeries::all() const {
  std::vector<Block> all = blocks_;
  if (open_.additions > 0) all.push_back(open_.sum);
  return all;
}

}  // namespace encore::energy
