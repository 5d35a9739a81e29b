#pragma once

#include "accel/inspect/node_measures.h"
#include "accel/inspect/node_table.h"
#include "app/window/pane_output.h"
#include "app/window/pane_request.h"
#include "app/window/pane_tracer.h"
#include "renderer/cpu_tracer.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace encore::app {

/// What a pane tells of its structure: figures, the node table with the overlay's values, the
/// picture of the 3D view, single rays. Each is made when it is asked for, and again when the
/// structure has changed.
class PaneInspection {
 public:
  /// Looks at everything that `request` wants; false if `cancel` cut it short.
  bool look(PaneTracer& tracer, const PaneRequest& request, const std::atomic<bool>* cancel);
  void fill(PaneOutput& output) const;
  void clear();

 private:
  void look_at_figures(PaneTracer& tracer);
  void look_at_nodes(const PaneTracer& tracer, const PaneRequest& request,
                     const std::atomic<bool>* cancel);
  void look_at_rays(const PaneTracer& tracer, const PaneRequest& request);
  void look_at_selection(const PaneTracer& tracer, const PaneRequest& request);
  bool look_from_free_view(const PaneTracer& tracer, const PaneRequest& request,
                           const std::atomic<bool>* cancel);
  [[nodiscard]] ProbeOutput probe(const PaneTracer& tracer, const PickedRay& picked,
                                  bool with_path) const;

  std::optional<std::uint64_t> figures_of_;  ///< PaneTracer::structure_serial()
  std::shared_ptr<const accel::BuildStats> stats_;
  std::optional<double> decay_;

  std::optional<std::uint64_t> nodes_of_;
  std::optional<std::uint64_t> areas_of_;  ///< the build whose areas are kept
  std::vector<double> built_areas_;
  std::shared_ptr<const accel::NodeTable> nodes_;
  std::shared_ptr<const accel::StructureProfile> profile_;
  std::optional<ui::OverlayColor> color_;
  std::shared_ptr<const accel::NodeValues> colors_;
  std::optional<std::uint32_t> selected_;
  std::uint64_t selected_of_ = 0;
  std::vector<std::uint32_t> selected_triangles_;
  std::vector<scene::Triangle> selected_shapes_;

  renderer::CpuTracer free_tracer_;
  std::optional<FreeView> free_;
  std::uint64_t free_of_ = 0;  ///< PaneTracer::content_serial()
  std::shared_ptr<const FreePicture> free_picture_;

  struct Asked {
    Probe pixel;
    scene::Camera camera;
    int width = 0;
    int height = 0;
    std::uint64_t structure = 0;

    friend bool operator==(const Asked&, const Asked&) = default;
  };
  std::optional<Asked> hovered_;
  std::optional<PickedRay> picked_;
  std::uint64_t picked_of_ = 0;  ///< PaneTracer::structure_serial()
  std::optional<ProbeOutput> hover_;
  std::optional<ProbeOutput> pick_;
};

}  // namespace encore::app
