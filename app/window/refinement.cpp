#include "app/window/refinement.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace encore::app {

namespace {

/// What a part is expected to take at most, so that newer requests need not wait.
constexpr double kLongestPart_s = 0.5;

/// Adds a part's figures to those of the parts before.
void add_rays(std::optional<renderer::RayFigures>& sum,
              const std::optional<renderer::RayFigures>& part) {
  if (!sum || !part) {
    sum.reset();
    return;
  }
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    renderer::RayFigures::Kind& into = sum->kinds[i];
    const renderer::RayFigures::Kind& from = part->kinds[i];
    into.rays += from.rays;
    const bool timed = into.seconds && from.seconds;
    into.seconds = timed ? std::optional(*into.seconds + *from.seconds) : std::nullopt;
  }
}

}  // namespace

void Refinement::begin(int samples) {
  view_ = {};
  view_.wanted = std::max(samples, 1);
  picture_.reset();
  rays_.reset();
  seconds_ = 0.0;
}

std::optional<SampleRange> Refinement::next() const {
  if (complete()) return std::nullopt;
  const auto done = static_cast<std::uint32_t>(view_.samples);
  // As far as the next doubling, in steps that meet it: errors are known where samples double.
  std::uint32_t count = done == 0 ? 1 : done & (~done + 1);
  const bool timed = done > 0 && seconds_ > 0.0;
  while (timed && count > 1 && count * seconds_ / done > kLongestPart_s) count /= 2;
  count = std::min(count, static_cast<std::uint32_t>(view_.wanted) - done);
  return SampleRange{done, count};
}

void Refinement::add(const renderer::Image& part, const SampleRange& samples, double seconds,
                     const std::optional<renderer::RayFigures>& rays) {
  if (view_.samples == 0) {
    mean_.reset(part.width, part.height);
    rays_ = rays;
  } else {
    add_rays(rays_, rays);
  }
  mean_.add(part, samples.count);
  seconds_ += seconds;
  view_.samples = static_cast<int>(mean_.samples());
  picture_ = std::make_shared<const renderer::Image>(mean_.mean());
  if (const auto error = mean_.error(); error && mean_.error_samples() == mean_.samples()) {
    view_.errors.push_back({seconds_, view_.samples, *error});
  }
}

}  // namespace encore::app
