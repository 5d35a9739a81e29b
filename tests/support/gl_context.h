#pragma once

#include "renderer/gl/context.h"
#include "renderer/gl/error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace encore::test {

/// This process's one headless OpenGL context; null, with `*why`, if this machine has none.
inline std::shared_ptr<renderer::gl::Context> shared_gl_context(std::string* why = nullptr) {
  struct Attempt {
    std::shared_ptr<renderer::gl::Context> context;
    std::string why;
    Attempt() {
      try {
        context = renderer::gl::make_headless_context();
      } catch (const renderer::gl::GlUnavailable& error) {
        why = error.what();
      }
    }
  };
  static const Attempt attempt;
  if (why != nullptr) *why = attempt.why;
  if (attempt.context) attempt.context->make_current();
  return attempt.context;
}

/// Tests that need OpenGL. They are skipped, aloud, where there is none; with ENCORE_NEED_GL set
/// (as where OpenGL in software is installed on purpose) they fail instead.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    context_ = shared_gl_context(&why);
    if (context_) return;
    if (std::getenv("ENCORE_NEED_GL") != nullptr) FAIL() << why;
    GTEST_SKIP() << why;
  }
  void TearDown() override {
    if (!context_) return;
    context_->make_current();
    context_->check("this test");
  }

  std::shared_ptr<renderer::gl::Context> context_;
};

}  // namespace encore::test
