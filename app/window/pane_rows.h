#pragma once

#include "app/window/pane_request.h"
#include "app/workloads.h"
#include "energy/phase_log.h"
#include "energy/session.h"
#include "renderer/renderer.h"
#include "ui/view.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace encore::app {

/// The times of the phases marked in `log`; those that did not happen are missing.
ui::FrameFigures figures_of(const energy::PhaseLog& log);

/// What a frame's rays were by kind; `plain`: their number where nothing is known but that each was
/// a camera ray.
void add_rays(ui::FrameFigures& figures, const std::optional<renderer::RayFigures>& rays,
              std::uint64_t plain);

/// What frames of a request are called in sessions; `forced`: scenes that stand still are followed
/// as if they moved; `software`: the graphics device runs on the CPU. The request has
/// a scene and a device.
WorkloadSpec workload_of(const PaneRequest& request, bool forced, bool software);

/// A frame of explore mode as a row of frames.csv; the log has at least one mark. `built_on`: where
/// the structure of this very frame was built, whatever the request asks for.
energy::FrameRow row_of(const PaneRequest& request, accel::BuildPlace built_on,
                        const energy::PhaseLog& log, std::size_t triangles);

}  // namespace encore::app
