#include "energy/plan.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace encore::energy {

std::string_view to_string(Order order) {
  switch (order) {
    case Order::listed:
      return "listed";
    case Order::abba:
      return "abba";
    case Order::shuffled:
      return "shuffled";
  }
  return "";
}

std::optional<Order> parse_order(std::string_view word) {
  for (const Order order : {Order::listed, Order::abba, Order::shuffled}) {
    if (word == to_string(order)) return order;
  }
  return std::nullopt;
}

Plan quick_plan() {
  return {};
}

Plan settle_plan() {
  Plan plan;
  plan.name = "settle";
  plan.warm_up = Seconds(0.5);
  plan.run = Seconds(3.0);
  plan.idle_before = plan.idle_after = Seconds(2.0);
  plan.mix = Seconds(3.0);
  return plan;
}

Plan thesis_plan() {
  Plan plan;
  plan.name = "thesis";
  plan.warm_up = Seconds(0.0);
  plan.run = Seconds(180.0);
  plan.idle_before = plan.idle_after = Seconds(10.0);
  plan.poll = Seconds(1.0);
  plan.cut_below = Watts(24.0);
  return plan;
}

std::optional<Plan> plan_by_name(std::string_view name) {
  if (name == "quick") return quick_plan();
  if (name == "settle") return settle_plan();
  if (name == "thesis") return thesis_plan();
  return std::nullopt;
}

Plan fit_to_sources(Plan plan, std::span<const SourceInfo> sources) {
  if (sources.empty()) {
    plan.idle_before = plan.idle_after = plan.mix = Seconds(0.0);
    return plan;
  }
  if (plan.name != "settle") return plan;
  Seconds period;
  for (const SourceInfo& source : sources) {
    period = std::max({period, source.update_period, source.smoothing});
  }
  constexpr double kRunPeriods = 41.0;
  constexpr double kIdlePeriods = 40.0;
  constexpr double kMixPeriods = 100.0;
  constexpr Seconds kLongestMix(60.0);
  plan.run = std::max(plan.run, period * kRunPeriods);
  plan.idle_before = plan.idle_after =
      std::clamp(period * kIdlePeriods, Seconds(2.0), Seconds(60.0));
  plan.mix = std::max(plan.mix, period * kMixPeriods);
  if (plan.mix > kLongestMix) plan.mix = Seconds(0.0);
  return plan;
}

Seconds least_duration(const Plan& plan) {
  return (plan.cool_down + plan.idle_before + plan.warm_up + plan.run + plan.mix +
          plan.idle_after) *
         static_cast<double>(plan.repeats);
}

std::vector<std::size_t> measuring_order(const Plan& plan, std::size_t count) {
  std::vector<std::size_t> once(count);
  std::iota(once.begin(), once.end(), std::size_t{0});
  std::vector<std::size_t> order;
  std::mt19937_64 random(plan.order_seed);
  for (std::uint32_t repeat = 0; repeat < plan.repeats; ++repeat) {
    if (plan.order == Order::abba && repeat > 0) std::reverse(once.begin(), once.end());
    if (plan.order == Order::shuffled) {
      // std::shuffle differs from library to library; an order belongs to its seed everywhere.
      for (std::size_t i = once.size(); i > 1; --i) std::swap(once[i - 1], once[random() % i]);
    }
    order.insert(order.end(), once.begin(), once.end());
  }
  return order;
}

}  // namespace encore::energy
