// Loading can be followed and ended wherever a reader looks; what was asked for then loads as ever.
#include "scene/load_watch.h"

#include "scene/model_child_process.h"
#include "scene/model_input.h"
#include "scene/obj_reader.h"
#include "scene/ply_reader.h"
#include "tests/readers/reader_test.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <string>

namespace encore::scene {
namespace {

constexpr int kVertices = 24'000;

/// A strip of triangles.
std::string obj_text() {
  std::string text;
  for (int i = 0; i < kVertices; ++i) {
    text += "v " + std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n";
  }
  for (int i = 3; i <= kVertices; ++i) {
    text +=
        "f " + std::to_string(i - 2) + " " + std::to_string(i - 1) + " " + std::to_string(i) + "\n";
  }
  return text;
}

std::string ply_text() {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(kVertices) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(kVertices - 2) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < kVertices; ++i) {
    text += std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n";
  }
  for (int i = 2; i < kVertices; ++i) {
    text +=
        "3 " + std::to_string(i - 2) + " " + std::to_string(i - 1) + " " + std::to_string(i) + "\n";
  }
  return text;
}

/// Cancels at every look in turn; progress must grow from look to look.
void expect_cancellable(const std::function<Model()>& read, std::uint64_t least_looks) {
  const Model whole = read();
  LoadWatch watch;
  {
    const LoadScope scope(&watch);
    read();
  }
  EXPECT_EQ(watch.progress, 1.0F);
  const std::uint64_t looks = watch.looks;
  ASSERT_GE(looks, least_looks);
  float last = 0.0F;
  for (std::uint64_t look = 1; look <= looks; ++look) {
    watch.last_look = look;
    const LoadScope scope(&watch);
    EXPECT_THROW(read(), LoadCancelled) << look;
    EXPECT_GE(watch.progress, last) << look;
    last = watch.progress;
  }
  EXPECT_GT(last, 0.5F);
  EXPECT_LT(last, 1.0F);
  const Model again = read();
  EXPECT_EQ(again.mesh.positions.size(), whole.mesh.positions.size());
  EXPECT_EQ(again.mesh.triangles, whole.mesh.triangles);
}

TEST(LoadWatch, ObjFilesCanBeCancelledAtEveryLook) {
  const std::string text = obj_text();
  expect_cancellable([&] { return read_obj(text, "strip.obj", {}); }, 12);
}

TEST(LoadWatch, PlyFilesCanBeCancelledAtEveryLook) {
  const std::string text = ply_text();
  expect_cancellable([&] { return read_ply(text, "strip.ply"); }, 12);
}

TEST(LoadWatch, FilesFromDiskAreFollowedByName) {
  const TemporaryFolder folder;
  const auto path = folder.write("strip.obj", obj_text());
  expect_cancellable([&] { return read_model(path); }, 12);
  LoadWatch watch;
  const LoadScope scope(&watch);
  EXPECT_EQ(watch.doing(), "");
  read_model(path);
  EXPECT_EQ(watch.doing(), "strip.obj");
}

TEST(LoadWatch, WhatAssimpReadsIsCancelledByItsFlag) {
  std::atomic<bool> cancel{true};
  LoadWatch watch;
  watch.cancel = &cancel;
  for (const char* name : {"square.3ds", "triangle.stl", "mirrored.gltf"}) {
    const LoadScope scope(&watch);
    EXPECT_THROW(read_model(fixture(name)), LoadCancelled) << name;
  }
  cancel = false;
  const LoadScope scope(&watch);
  EXPECT_EQ(read_model(fixture("square.3ds")).mesh.triangles.size(), 2U);
}

TEST(LoadWatch, AChildProcessThatHangsIsEnded) {
  LoadWatch watch;
  watch.last_look = 3;
  const LoadScope scope(&watch);
  const ChildResult result = run_in_child(
      [] {
        for (;;) pause();
        return std::string();
      },
      {256U << 20U, 60, 600});
  EXPECT_EQ(result.outcome, ChildResult::Outcome::cancelled);
  EXPECT_EQ(watch.looks, 3U);
}

TEST(LoadWatch, InAChildProcessNobodyLooks) {
  LoadWatch watch;
  watch.last_look = ~std::uint64_t{0} - 1;
  const LoadScope scope(&watch);
  const ChildResult result = run_in_child(
      [&watch] {
        watch.last_look = 0;
        check_load();
        return std::string("read");
      },
      {256U << 20U, 60, 600});
  EXPECT_EQ(result.outcome, ChildResult::Outcome::finished);
  EXPECT_EQ(result.bytes, "read");
}

TEST(LoadWatch, WithoutOneNothingIsLookedAt) {
  EXPECT_NO_THROW(check_load());
  EXPECT_NO_THROW(report_load(0.5));
  note_load("nobody hears it");
  const LoadScope none(nullptr);
  EXPECT_NO_THROW(check_load());
}

TEST(LoadWatch, PartsWithinPartsAndScopesWithinScopes) {
  LoadWatch watch;
  LoadWatch inner;
  {
    const LoadScope scope(&watch);
    {
      const LoadPart half(0.0, 0.5, "first, ");
      report_load(0.5);
      EXPECT_FLOAT_EQ(watch.progress, 0.25F);
      const LoadPart rest(0.5, 1.0, "rest, ");
      note_load("file");
      EXPECT_EQ(watch.doing(), "first, rest, file");
      report_load(1.0);
      EXPECT_FLOAT_EQ(watch.progress, 0.5F);
      report_load(0.0);
      EXPECT_FLOAT_EQ(watch.progress, 0.5F) << "never back";
      const LoadScope nested(&inner);
      report_load(0.75);
      EXPECT_FLOAT_EQ(inner.progress, 0.75F);
    }
    EXPECT_FLOAT_EQ(inner.progress, 1.0F);
    note_load("file");
    EXPECT_EQ(watch.doing(), "file");
    report_load(0.75);
    EXPECT_FLOAT_EQ(watch.progress, 0.75F);
  }
  EXPECT_FLOAT_EQ(watch.progress, 1.0F);
}

TEST(LoadWatch, AnErrorLeavesProgressWhereItWas) {
  LoadWatch watch;
  try {
    const LoadScope scope(&watch);
    read_obj("", "empty.obj", {});
    FAIL();
  } catch (const InputError&) {
    EXPECT_LT(watch.progress, 1.0F);
  }
}

}  // namespace
}  // namespace encore::scene
