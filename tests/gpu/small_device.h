#pragma once

#include "renderer/gl/context.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace encore::renderer::test {

/// A device whose storage buffers are small, on the context of another.
class SmallDevice final : public gl::Context {
 public:
  SmallDevice(std::shared_ptr<gl::Context> context, std::uint64_t storage_block_bytes)
      : context_(std::move(context)) {
    context_->make_current();
    capabilities_ = context_->capabilities();
    capabilities_.storage_block_bytes = storage_block_bytes;
    capabilities_.texture_size = 64;
  }
  void make_current() override { context_->make_current(); }
  void allow(std::uint64_t storage_block_bytes) {
    capabilities_.storage_block_bytes = storage_block_bytes;
  }
  void allow_blocks(int blocks) { capabilities_.compute_storage_blocks = blocks; }

 private:
  std::shared_ptr<gl::Context> context_;
};

}  // namespace encore::renderer::test
