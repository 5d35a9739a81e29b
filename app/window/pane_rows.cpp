#include "app/window/pane_rows.h"

#include <optional>

namespace encore::app {

ui::FrameFigures figures_of(const energy::PhaseLog& log) {
  ui::FrameFigures figures;
  const auto add = [](std::optional<double>& sum, double seconds) {
    sum = sum.value_or(0.0) + seconds;
  };
  for (const energy::PhaseSpan& span : log.spans()) {
    const double seconds = (span.end - span.start).value;
    switch (span.phase) {
      case energy::Phase::animate:
        add(figures.animate_s, seconds);
        break;
      case energy::Phase::build:
        add(figures.build_s, seconds);
        break;
      case energy::Phase::update:
        add(figures.update_s, seconds);
        break;
      case energy::Phase::transfer:
        add(figures.transfer_s, seconds);
        break;
      case energy::Phase::render:
        add(figures.render_s, seconds);
        break;
    }
  }
  return figures;
}

void add_rays(ui::FrameFigures& figures, const std::optional<renderer::RayFigures>& rays,
              std::uint64_t plain) {
  if (!rays || rays->rays() == 0) {
    figures.rays = plain;
    figures.kinds = {};
    figures.kinds[0].rays = plain;
    if (plain > 0) figures.kinds[0].share = 1.0;
    return;
  }
  figures.rays = rays->rays();
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    const auto kind = static_cast<scene::RayKind>(i);
    figures.kinds[i].rays = (*rays)[kind].rays;
    figures.kinds[i].share = rays->share(kind);
    // One kind alone took all of the time, whoever measured it.
    if (figures.kinds[i].rays == figures.rays) figures.kinds[i].share = 1.0;
  }
}

WorkloadSpec workload_of(const PaneRequest& request, bool forced, bool software) {
  WorkloadSpec spec;
  spec.scene = request.scene;
  spec.device = *request.device;
  spec.structure = request.structure;
  spec.policy = request.policy;
  spec.size = {request.width, request.height};
  spec.build_on =
      accel::place_of_build(request.build_on, request.structure, request.policy, software);
  spec.threads = request.threads;
  spec.rays = request.rays;
  spec.test = request.scene->animated() ? TestKind::animated
              : forced                  ? TestKind::forced
                                        : TestKind::fixed;
  return spec;
}

energy::FrameRow row_of(const PaneRequest& request, accel::BuildPlace built_on,
                        const energy::PhaseLog& log, std::size_t triangles) {
  WorkloadSpec spec = workload_of(request, false, false);
  spec.build_on = built_on;
  energy::FrameRow row;
  row.time = log.spans().front().start;
  row.configuration = configuration_of(spec, triangles);
  row.operations = 1;
  for (const energy::PhaseSpan& span : log.spans()) {
    std::optional<energy::Seconds>& sum = row.phases[span.phase];
    sum = sum.value_or(energy::Seconds(0.0)) + (span.end - span.start);
  }
  return row;
}

}  // namespace encore::app
