// Figures as the panels see them: nothing that is missing becomes a number.
#include "app/window/figures_view.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

using Labels = std::vector<std::string>;

TEST(ShortLabels, LeaveOutWhatAllShareButStructureAndDevice) {
  const auto configuration = [](const char* device, const char* structure, const char* policy,
                                const char* height, const char* update_case) {
    return std::vector<energy::KeyValue>{
        {"scene", "toys"}, {"device", device}, {"structure", structure},    {"policy", policy},
        {"width", "256"},  {"height", height}, {"update_case", update_case}};
  };
  const auto kd = configuration("cpu", "kd-sah", "rebuild", "256", "");
  const auto bvh = configuration("gpu", "bvh-median", "rebuild", "256", "real");
  EXPECT_EQ(short_labels({kd, bvh}), (Labels{"cpu, kd-sah", "gpu, bvh-median, real"}));
  EXPECT_EQ(short_labels({kd}), Labels{"cpu, kd-sah"});
  const auto tall = configuration("cpu", "kd-sah", "refit", "512", "");
  EXPECT_EQ(short_labels({kd, tall}),
            (Labels{"cpu, kd-sah, rebuild, 256x256", "cpu, kd-sah, refit, 256x512"}));
  EXPECT_EQ(short_labels({}), Labels{});
}

TEST(FiguresView, MissingEnergiesStayMissingAndSayWhy) {
  Figures figures;
  LiveFigures one;
  one.configuration = {{"scene", "toys"}};
  one.name = "toys";
  one.summary.configuration = one.configuration;
  one.summary.operations = 4;
  one.summary.mean = energy::Seconds(0.02);
  one.energy = {energy::Origin::unavailable, "no sensor"};
  figures.configurations.push_back(one);
  const auto views = views_of(figures);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_EQ(views[0].mean_s, std::optional(0.02));
  EXPECT_FALSE(views[0].joules.value.has_value());
  EXPECT_FALSE(views[0].watts.value.has_value());
  EXPECT_EQ(views[0].joules.provenance.origin, energy::Origin::unavailable);
  EXPECT_EQ(views[0].joules.provenance.detail, "no sensor");
}

TEST(FiguresView, ErrorsAreThoseOfTheConfiguration) {
  Figures figures;
  for (const char* scene : {"toys", "mug"}) {
    LiveFigures one;
    one.configuration = {{"scene", scene}};
    one.name = scene;
    one.summary.configuration = one.configuration;
    one.summary.operations = 1;
    one.summary.mean = energy::Seconds(1.0);
    energy::ConvergenceRow row;
    row.configuration = one.configuration;
    row.elapsed = energy::Seconds(scene[0] == 't' ? 2.0 : 3.0);
    row.quantity = "time_per_operation";
    row.relative_ci95 = 0.5;
    one.convergence.push_back(row);
    row.quantity = "joules_per_operation";
    row.relative_ci95.reset();
    one.convergence.push_back(row);
    figures.configurations.push_back(one);
  }
  const auto views = views_of(figures);
  ASSERT_EQ(views.size(), 2U);
  ASSERT_EQ(views[1].time_error.size(), 1U);
  EXPECT_EQ(views[1].time_error[0].elapsed_s, 3.0);
  EXPECT_TRUE(views[1].joules_error.empty());
}

}  // namespace
}  // namespace encore::app
