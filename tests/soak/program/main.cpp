// encore_soak: draws everything in every way for as long as it is told to, and says in the end
// whether a hit was wrong or memory drifted. scripts/soak.sh runs it under sanitizers.
#include "renderer/gl/error.h"
#include "tests/soak/program/soak.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace {

using Clock = std::chrono::steady_clock;
using encore::test::MemoryUse;
using encore::test::Soak;
using encore::test::SoakPlan;
using encore::test::SoakTally;

constexpr double kMebibyte = 1024.0 * 1024.0;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void print(const SoakTally& tally, double seconds) {
  const MemoryUse now = encore::test::memory_use();
  fmt::print(
      "{:6.1f} min: {} rounds, {} legs, {} frames, {} builds, {} updates, {} refits on the "
      "device, {} rays and {} pictures checked, {} and {} wrong, {:.1f} MiB resident\n",
      seconds / 60.0, tally.rounds, tally.legs, tally.frames, tally.builds, tally.updates,
      tally.device_refits, tally.checks.rays, tally.pictures, tally.checks.wrong,
      tally.wrong_pictures, static_cast<double>(now.resident) / kMebibyte);
  std::fflush(stdout);
}

void print_memory(const SoakTally& tally, const SoakPlan& plan) {
  for (std::size_t i = 0; i < tally.memory.size(); ++i) {
    fmt::print("after round {}: {:.3f} MiB in use, {:.1f} MiB resident{}\n", i + 1,
               static_cast<double>(tally.memory[i].in_use) / kMebibyte,
               static_cast<double>(tally.memory[i].resident) / kMebibyte,
               i < plan.warm_up() ? " (warm-up, not judged)" : "");
  }
  if (tally.memory.size() < plan.warm_up() + 2) {
    fmt::print(
        "memory was not judged: that takes {} rounds, and {} were completed; run longer or "
        "with more --slices\n",
        plan.warm_up() + 2, tally.memory.size());
    return;
  }
  std::vector<double> in_use;
  std::vector<double> resident;
  for (std::size_t i = plan.warm_up(); i < tally.memory.size(); ++i) {
    in_use.push_back(static_cast<double>(tally.memory[i].in_use));
    resident.push_back(static_cast<double>(tally.memory[i].resident));
  }
  const auto used = encore::test::drift_of(in_use);
  const auto held = encore::test::drift_of(resident);
  fmt::print(
      "drift over {} rounds: in use {:+.0f} bytes a round ({:+.3f} % in all), resident "
      "{:+.0f} bytes a round ({:+.2f} % in all)\n",
      in_use.size(), used.per_round, used.whole * 100.0, held.per_round, held.whole * 100.0);
}

std::shared_ptr<encore::renderer::gl::Context> opengl(bool wanted) {
  if (!wanted) return nullptr;
  try {
    return encore::renderer::gl::make_headless_context();
  } catch (const encore::renderer::gl::GlUnavailable& error) {
    fmt::print("on the CPU alone: {}\n", error.what());
    return nullptr;
  }
}

int soak(const SoakPlan& plan, double minutes, std::uint64_t most_rounds, bool with_opengl) {
  const auto context = opengl(with_opengl);
  if (context) {
    fmt::print("OpenGL: {}\n", context->capabilities().renderer);
  }
  Soak soak(plan, context);
  fmt::print("{} legs in {} slices, seed {}\n", soak.legs().size(), plan.slices, plan.seed);
  const auto start = Clock::now();
  double next_line = 60.0;
  const auto go_on = [&] {
    const double seconds = seconds_since(start);
    if (seconds >= next_line) {
      print(soak.tally(), seconds);
      next_line += 60.0;
    }
    return most_rounds > 0 || seconds < minutes * 60.0;
  };
  while (go_on() && (most_rounds == 0 || soak.tally().rounds < most_rounds)) soak.round(go_on);

  print(soak.tally(), seconds_since(start));
  print_memory(soak.tally(), plan);
  const SoakTally& tally = soak.tally();
  fmt::print("mode moller-trumbore: {} of {} rays found another triangle than brute force\n",
             tally.checks.loose_differing, tally.checks.loose);
  const auto problems = encore::test::verdict(tally, plan);
  for (const std::string& problem : problems) fmt::print("PROBLEM: {}\n", problem);
  fmt::print("verdict: {}\n", problems.empty() ? "nothing wrong" : "see above");
  return problems.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Draws every moving sample scene with every structure, policy, device, intersection "
      "mode and kind of ray, again and again.");
  double minutes = 60.0;
  std::uint64_t rounds = 0;
  bool no_opengl = false;
  SoakPlan plan{.slices = 8, .slices_used = 8};
  app.add_option("--minutes", minutes, "how long")->check(CLI::PositiveNumber);
  app.add_option("--rounds", rounds, "this many rounds instead, however long they take");
  app.add_option("--seed", plan.seed, "of order and rays");
  app.add_option("--size", plan.size, "pixels of a picture's side")->check(CLI::Range(16, 4096));
  app.add_option("--slices", plan.slices, "rounds that everything is dealt out to")
      ->check(CLI::Range(1, 1000));
  app.add_option("--slices-used", plan.slices_used, "slices that rounds take turns with; 0: all")
      ->check(CLI::Range(0, 1000));
  app.add_flag("--no-opengl", no_opengl, "the CPU alone");
  plan.slices_used = 0;
  CLI11_PARSE(app, argc, argv);
  if (plan.slices_used == 0) plan.slices_used = plan.slices;
  plan.slices_used = std::min(plan.slices_used, plan.slices);
  try {
    return soak(plan, minutes, rounds, !no_opengl);
  } catch (const std::exception& error) {
    fmt::print(stderr, "encore_soak: {}\n", error.what());
    return 2;
  }
}
