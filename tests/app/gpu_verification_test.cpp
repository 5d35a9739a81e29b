// What is held to the CPU is caught lying, whatever the lie, and is not blamed for rounding.
#include "app/gpu_verification.h"

#include "accel/make_structure.h"
#include "app/interrupt.h"
#include "renderer/cpu_tracer.h"
#include "renderer/gl/error.h"
#include "scene/sample_scenes.h"
#include "tests/app/lying_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace encore::app {
namespace {

using scene::Hit;
using scene::Ray;
using test::CpuDevice;
using test::LyingTracer;

constexpr int kSide = 48;

DeviceVerificationPlan small_plan() {
  return {.size = {kSide, kSide}, .rays_per_kind = 100};
}

std::vector<DeviceRow> verify(const std::string& name, renderer::Tracer& device,
                              const std::vector<accel::StructureSpec>& specs = {
                                  accel::default_spec(accel::StructureKind::bvh_median)}) {
  const auto scene = scene::make_sample_scene(name);
  renderer::CpuTracer reference(1);
  return verify_device(*scene, specs, small_plan(), reference, device, {});
}

/// The only row of a static scene whose device lies like this at pixels that hit (or, with
/// `of_misses`, at those that miss), from the 11th such pixel on and so many times.
DeviceRow row_with_lie(const std::function<void(Hit&)>& change, int times = 1,
                       bool of_misses = false) {
  int seen = 0;
  LyingTracer device([&](const Ray* ray, std::size_t, Hit& hit) {
    if (ray != nullptr || hit.found() == of_misses) return;
    const int index = seen++;
    if (index >= 10 && index < 10 + times) change(hit);
  });
  const auto rows = verify("mug", device);
  EXPECT_EQ(rows.size(), 1U);
  EXPECT_GE(seen, 10 + times);
  return rows.front();
}

TEST(GpuVerification, AnHonestDevicePassesWithNothingToExplain) {
  std::vector<accel::StructureSpec> specs;
  for (const accel::StructureKind kind : accel::all_structure_kinds()) {
    if (kind != accel::StructureKind::brute) specs.push_back(accel::default_spec(kind));
  }
  LyingTracer device;
  const auto rows = verify("mug", device, specs);
  ASSERT_EQ(rows.size(), 6U);
  for (const DeviceRow& row : rows) {
    EXPECT_TRUE(row.passed()) << row.structure;
    EXPECT_EQ(row.action, "build");
    EXPECT_EQ(row.pixels, std::uint64_t{kSide * kSide});
    EXPECT_GT(row.hits.rays, row.pixels + 700);
    EXPECT_GT(row.hits.hits, 100U);
    EXPECT_EQ(row.hits.mismatches(), 0U);
    EXPECT_EQ(row.picture.largest, 0.0);
    EXPECT_FALSE(row.first.has_value());
  }
}

TEST(GpuVerification, AMovingSceneIsComparedAfterRefitAndRebuildOnTheDevice) {
  LyingTracer device;
  const auto rows = verify("toys", device);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].action, "build");
  EXPECT_EQ(rows[1].action, "refit");
  EXPECT_EQ(rows[2].action, "rebuild");
  for (const DeviceRow& row : rows) EXPECT_TRUE(row.passed()) << row.action;
  // The refit comes after the new triangles, and the rebuild is sent.
  EXPECT_EQ(device.calls(), "ihfrhfh");
}

TEST(GpuVerification, StructuresThatCannotRefitAreOnlyRebuilt) {
  LyingTracer device;
  const auto rows = verify("toys", device, {accel::default_spec(accel::StructureKind::grid_box)});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].action, "rebuild");
  EXPECT_EQ(device.calls(), "ihfh");
}

TEST(GpuVerification, AForgottenRefitIsSeen) {
  /// A device that keeps its old triangles when told to refit.
  class Forgetful final : public CpuDevice {
   public:
    void init(const renderer::RenderInput& input) override {
      triangles_ = *input.triangles;
      structure_ = accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
      structure_->build(triangles_.triangles);
      CpuDevice::init({input.scene, &triangles_, structure_.get()});
    }
    void refresh() override {}
    [[nodiscard]] bool can_refit() const override { return true; }
    void refit() override {}

   private:
    scene::TriangleList triangles_;
    std::unique_ptr<accel::AccelerationStructure> structure_;
  } device;
  const auto rows = verify("toys", device);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_TRUE(rows[0].passed());
  EXPECT_FALSE(rows[1].passed());
  EXPECT_GT(rows[1].unexplained(), 10U);
  EXPECT_GT(rows[1].picture.rmse, 0.0);
  EXPECT_FALSE(rows[2].passed());
}

TEST(GpuVerification, EachKindOfLieIsCountedAndUnexplained) {
  const DeviceRow missed = row_with_lie([](Hit& hit) { hit = Hit{}; });
  EXPECT_EQ(missed.hits.missed, 1U);
  const DeviceRow invented = row_with_lie([](Hit& hit) { hit = {5.0F, 0, 0.25F, 0.25F}; }, 1, true);
  EXPECT_EQ(invented.hits.invented, 1U);
  // Right distance, wrong triangle.
  const DeviceRow triangle = row_with_lie([](Hit& hit) { hit.triangle ^= 64U; });
  EXPECT_EQ(triangle.hits.wrong_triangle, 1U);
  // No such triangle.
  const DeviceRow garbage = row_with_lie([](Hit& hit) { hit.triangle = 0x7FFFFFFFU; });
  EXPECT_EQ(garbage.hits.wrong_triangle, 1U);
  const DeviceRow distance = row_with_lie([](Hit& hit) { hit.t *= 1.000001F; });
  EXPECT_EQ(distance.hits.wrong_distance, 1U);
  const DeviceRow u = row_with_lie([](Hit& hit) { hit.u += 1e-6F; });
  EXPECT_EQ(u.hits.wrong_distance, 1U);
  const DeviceRow v = row_with_lie([](Hit& hit) { hit.v = std::nanf(""); });
  EXPECT_EQ(v.hits.wrong_distance, 1U);
  const DeviceRow nan = row_with_lie([](Hit& hit) { hit.t = std::nanf(""); });
  EXPECT_EQ(nan.hits.wrong_distance, 1U);
  const DeviceRow miss = row_with_lie([](Hit& hit) { hit.t = 1.0F; }, 1, true);
  EXPECT_EQ(miss.hits.wrong_distance, 1U);

  for (const DeviceRow* row :
       {&missed, &invented, &triangle, &garbage, &distance, &u, &v, &nan, &miss}) {
    EXPECT_EQ(row->hits.mismatches(), 1U);
    EXPECT_EQ(row->differing_pixels, 1U);
    EXPECT_EQ(row->unexplained(), 1U);
    EXPECT_FALSE(row->passed());
    ASSERT_TRUE(row->first.has_value());
    EXPECT_TRUE(row->first->kind.starts_with("pixel (")) << row->first->kind;
    // The oracle sides with the CPU.
    EXPECT_EQ(row->first->difference.oracle.triangle, row->first->expected.triangle);
  }
}

TEST(GpuVerification, LiesAboutRaysCountButAreNoPixels) {
  LyingTracer device([](const Ray* ray, std::size_t index, Hit& hit) {
    if (ray != nullptr && index == 7 && hit.found()) hit.t *= 1.5F;
  });
  const DeviceRow row = verify("mug", device).front();
  EXPECT_GT(row.hits.wrong_distance, 2U);
  EXPECT_EQ(row.unexplained(), row.hits.wrong_distance);
  EXPECT_EQ(row.differing_pixels, 0U);
  EXPECT_FALSE(row.passed());
  EXPECT_TRUE(row.first->kind.ends_with(" ray")) << row.first->kind;
}

TEST(GpuVerification, AnswersThatWereNeverWrittenDiffer) {
  LyingTracer device;
  device.fall_silent();
  const DeviceRow row = verify("mug", device).front();
  EXPECT_EQ(row.hits.mismatches(), row.hits.rays - row.pixels);
  EXPECT_EQ(row.unexplained(), row.hits.mismatches());
}

TEST(GpuVerification, OneRoundingIsExplainedButNotTooManyOfThem) {
  const auto up = [](Hit& hit) { hit.t = std::nextafter(hit.t, 1e30F); };
  const DeviceRow one = row_with_lie(up);
  EXPECT_EQ(one.hits.wrong_distance, 1U);
  EXPECT_EQ(one.explained, 1U);
  EXPECT_EQ(one.unexplained(), 0U);
  EXPECT_EQ(one.first->difference.explanation, Explanation::rounding);
  // One of 48 x 48 pixels is more than 0.01 %.
  EXPECT_FALSE(one.passed());
  const DeviceRow two_steps = row_with_lie([&](Hit& hit) { up(hit), up(hit); });
  EXPECT_EQ(two_steps.unexplained(), 1U);
}

TEST(GpuVerification, AtMostOnePixelInTenThousandMayDiffer) {
  DeviceRow row;
  row.pixels = 20000;
  row.differing_pixels = 2;
  row.explained = 2;
  row.hits.wrong_distance = 2;
  EXPECT_TRUE(row.passed());
  row.differing_pixels = 3;
  EXPECT_FALSE(row.passed());
  row.differing_pixels = 2;
  row.hits.wrong_distance = 3;
  EXPECT_FALSE(row.passed());
  row.explained = 3;
  EXPECT_TRUE(row.passed());
  row.problem = "it broke";
  EXPECT_FALSE(row.passed());
}

TEST(GpuVerification, TheFirstUnexplainedMismatchIsShownBeforeExplainedOnes) {
  int call = 0;
  const DeviceRow row = row_with_lie(
      [&](Hit& hit) {
        if (++call == 3) {
          hit.t *= 2.0F;
        } else {
          hit.t = std::nextafter(hit.t, 0.0F);
        }
      },
      5);
  EXPECT_EQ(row.hits.wrong_distance, 5U);
  EXPECT_EQ(row.unexplained(), 1U);
  EXPECT_EQ(row.first->found.t, 2.0F * row.first->expected.t);
}

TEST(GpuVerification, WhatTheDeviceCannotHoldIsAProblemOfThatRowAlone) {
  class Small final : public CpuDevice {
   public:
    void init(const renderer::RenderInput& input) override {
      if (input.structure->name() == "kd-sah") throw renderer::gl::GlError("too large: 2 of 1 MiB");
      CpuDevice::init(input);
    }
  } device;
  const auto rows = verify("mug", device,
                           {accel::default_spec(accel::StructureKind::kd_sah),
                            accel::default_spec(accel::StructureKind::kd_median)});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].problem, "too large: 2 of 1 MiB");
  EXPECT_FALSE(rows[0].passed());
  EXPECT_TRUE(rows[1].passed());
}

TEST(GpuVerification, InterruptingKeepsOnlyWholeRows) {
  int calls = 0;
  LyingTracer device([&](const Ray* ray, std::size_t index, Hit& hit) {
    // In the middle of the second structure; what the device says from then on is worth nothing.
    if (ray == nullptr && index == 0 && ++calls == 2) interrupted = true;
    if (interrupted) hit.triangle = 1;
  });
  const auto rows = verify("mug", device,
                           {accel::default_spec(accel::StructureKind::kd_sah),
                            accel::default_spec(accel::StructureKind::bvh_median),
                            accel::default_spec(accel::StructureKind::kd_median)});
  interrupted = false;
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows[0].passed());
}

TEST(GpuVerification, PicturesAndMarksAreHandedOver) {
  const auto scene = scene::make_sample_scene("mug");
  renderer::CpuTracer reference(1);
  int seen = 0;
  LyingTracer device([&](const Ray* ray, std::size_t index, Hit& hit) {
    if (ray == nullptr && index == 100) hit.triangle = 3;
  });
  DeviceVerificationHooks hooks;
  std::vector<double> shares;
  hooks.progress = [&](double share) { shares.push_back(share); };
  hooks.pictures = [&](const DeviceRow& row, const renderer::Image& expected,
                       const renderer::Image& found, std::span<const std::uint8_t> differs) {
    ++seen;
    EXPECT_EQ(row.structure, "bvh-median");
    EXPECT_EQ(expected.width, kSide);
    EXPECT_EQ(found.pixels.size(), std::size_t{kSide * kSide});
    ASSERT_EQ(differs.size(), found.pixels.size());
    for (std::size_t i = 0; i < differs.size(); ++i) EXPECT_EQ(differs[i] != 0, i == 100) << i;
  };
  verify_device(*scene, {accel::default_spec(accel::StructureKind::bvh_median)}, small_plan(),
                reference, device, hooks);
  EXPECT_EQ(seen, 1);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

}  // namespace
}  // namespace encore::app
