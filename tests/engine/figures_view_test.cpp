// Figures as the panels see them: nothing that is missing becomes a number.
#include "app/window/figures_view.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

using Labels = std::vector<std::string>;

TEST(ShortLabels, LeaveOutWhatAllShare) {
  EXPECT_EQ(short_labels({"toys, kd-sah, cpu, 256x256", "toys, bvh-median, gpu, 256x256"}),
            (Labels{"kd-sah, cpu", "bvh-median, gpu"}));
  EXPECT_EQ(short_labels({"toys, kd-sah", "toys, bvh-median, gpu"}),
            (Labels{"toys, kd-sah", "toys, bvh-median, gpu"}));
  EXPECT_EQ(short_labels({"toys, kd-sah"}), Labels{"toys, kd-sah"});
  EXPECT_EQ(short_labels({"a, b", "a, b"}), (Labels{"a, b", "a, b"}));
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
