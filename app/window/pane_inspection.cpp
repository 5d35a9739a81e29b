#include "app/window/pane_inspection.h"

#include "accel/inspect/node_measures.h"
#include "accel/inspect/node_table.h"
#include "accel/inspect/ray_path.h"
#include "renderer/overlay/screen_texture.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace encore::app {

namespace {

/// Triangles of a selected node that are listed and shown.
constexpr std::size_t kMostSelected = 20'000;
/// Steps of a ray's path that are listed.
constexpr std::size_t kMostSteps = 20'000;

accel::NodeMeasure measure_of(ui::OverlayColor color) {
  switch (color) {
    case ui::OverlayColor::depth:
      return accel::NodeMeasure::depth;
    case ui::OverlayColor::leaf_size:
      return accel::NodeMeasure::references;
    case ui::OverlayColor::sah:
      return accel::NodeMeasure::sah_share;
    case ui::OverlayColor::overlap:
      return accel::NodeMeasure::overlap;
    case ui::OverlayColor::decay:
      return accel::NodeMeasure::refit_decay;
  }
  return accel::NodeMeasure::depth;
}

bool is_cancelled(const std::atomic<bool>* cancel) {
  return cancel != nullptr && cancel->load(std::memory_order_relaxed);
}

}  // namespace

void PaneInspection::clear() {
  figures_of_.reset();
  stats_.reset();
  decay_.reset();
  nodes_of_.reset();
  areas_of_.reset();
  built_areas_.clear();
  nodes_.reset();
  profile_.reset();
  color_.reset();
  colors_.reset();
  selected_.reset();
  selected_triangles_.clear();
  selected_shapes_.clear();
  free_.reset();
  free_picture_.reset();
  hovered_.reset();
  picked_.reset();
  hover_.reset();
  pick_.reset();
}

void PaneInspection::look_at_figures(PaneTracer& tracer) {
  // Of a tree that the device built nothing is known.
  if (tracer.structure() == nullptr || tracer.built_on_device()) {
    stats_.reset();
    figures_of_.reset();
    return;
  }
  if (figures_of_ == tracer.structure_serial()) return;
  stats_ = std::make_shared<const accel::BuildStats>(tracer.structure()->stats());
  figures_of_ = tracer.structure_serial();
}

void PaneInspection::look_at_nodes(const PaneTracer& tracer, const PaneRequest& request,
                                   const std::atomic<bool>* cancel) {
  const accel::AccelerationStructure* structure = tracer.structure();
  if (!request.nodes || structure == nullptr) {
    nodes_.reset();
    profile_.reset();
    colors_.reset();
    nodes_of_.reset();
    color_.reset();
    decay_.reset();
    return;
  }
  if (nodes_of_ != tracer.structure_serial()) {
    auto table = std::make_shared<accel::NodeTable>(accel::NodeTable::make(*structure, cancel));
    if (table->cancelled()) return;
    nodes_ = std::move(table);
    profile_ = std::make_shared<const accel::StructureProfile>(accel::profile_of(*nodes_));
    nodes_of_ = tracer.structure_serial();
    color_.reset();
    if (areas_of_ != tracer.build_serial()) {
      // The first table after a build. Where refits came before anybody looked, decay counts from
      // the first look.
      built_areas_ = structure->can_refit() ? accel::node_areas(*nodes_) : std::vector<double>{};
      areas_of_ = tracer.build_serial();
    }
    decay_ = structure->can_refit() ? accel::sah_decay(*nodes_, built_areas_) : std::nullopt;
  }
  if (color_ != request.node_color) {
    colors_ = std::make_shared<const accel::NodeValues>(
        accel::measure_nodes(*nodes_, measure_of(request.node_color), built_areas_));
    color_ = request.node_color;
  }
}

void PaneInspection::look_at_selection(const PaneTracer& tracer, const PaneRequest& request) {
  if (!request.selected_node || !nodes_ || *request.selected_node >= nodes_->size()) {
    selected_.reset();
    selected_triangles_.clear();
    selected_shapes_.clear();
    return;
  }
  if (selected_ == request.selected_node && selected_of_ == tracer.structure_serial()) return;
  selected_ = request.selected_node;
  selected_of_ = tracer.structure_serial();
  selected_triangles_ = nodes_->triangles_below(*tracer.structure(), *selected_, kMostSelected)
                            .value_or(std::vector<std::uint32_t>{});
  selected_shapes_.clear();
  for (const std::uint32_t triangle : selected_triangles_) {
    selected_shapes_.push_back(tracer.triangles().triangles.at(triangle));
  }
}

bool PaneInspection::look_from_free_view(const PaneTracer& tracer, const PaneRequest& request,
                                         const std::atomic<bool>* cancel) {
  if (!request.free || tracer.structure() == nullptr) {
    free_.reset();
    free_picture_.reset();
    return true;
  }
  if (free_ == request.free && free_of_ == tracer.content_serial()) return true;
  const FreeView& view = *request.free;
  free_tracer_.init({tracer.scene().get(), &tracer.triangles(), tracer.structure()});
  free_tracer_.set_cancel_flag(cancel);
  renderer::Image image;
  image.resize(view.width, view.height);
  free_tracer_.render(view.camera, image);
  if (!free_tracer_.complete()) return false;
  free_tracer_.set_cancel_flag(nullptr);
  std::vector<scene::Hit> hits;
  free_tracer_.trace_hits(view.camera, view.width, view.height, hits);
  auto picture = std::make_shared<FreePicture>();
  picture->screen.width = view.width;
  picture->screen.height = view.height;
  picture->screen.rgba.resize(image.pixels.size() * 4);
  renderer::picture_to_rgba8(image, picture->screen.rgba);
  picture->distances.reserve(hits.size());
  for (const scene::Hit& hit : hits) {
    picture->distances.push_back(hit.found() ? hit.t : std::numeric_limits<float>::infinity());
  }
  picture->camera = view.camera;
  free_picture_ = std::move(picture);
  free_ = request.free;
  free_of_ = tracer.content_serial();
  return true;
}

ProbeOutput PaneInspection::probe(const PaneTracer& tracer, const PickedRay& picked,
                                  bool with_path) const {
  const accel::AccelerationStructure* structure = tracer.structure();
  const Probe& pixel = picked.pixel;
  ProbeOutput output;
  output.ray = picked.ray;
  const std::array<scene::Ray, 1> ray{picked.ray};
  std::array<scene::Hit, 1> hit;
  std::array<accel::TraceCounters, 1> counters;
  structure->intersect_counted(ray, hit, counters);
  ui::PixelView& view = output.pixel;
  view.x = pixel.x;
  view.y = pixel.y;
  view.found = hit[0].found();
  view.steps = counters[0].steps;
  view.box_tests = counters[0].box_tests;
  view.triangle_tests = counters[0].triangle_tests;
  if (view.found) {
    view.distance = double(hit[0].t);
    view.triangle = hit[0].triangle;
    const std::uint32_t material = tracer.triangles().triangles.at(view.triangle).material;
    if (material < tracer.scene()->materials.size()) {
      view.material = tracer.scene()->materials[material].name;
    }
  }
  if (!with_path) return output;
  auto path = std::make_shared<accel::RayPath>();
  path->most_steps = kMostSteps;
  structure->trace_path(ray[0], hit[0], *path);
  for (const accel::RayStep& step : path->steps) {
    output.sentences.push_back(nodes_ ? accel::describe(step, *nodes_) : std::string());
    std::optional<std::uint32_t> node;
    if (nodes_ && step.place != scene::kNoHit) {
      const std::uint32_t index = nodes_->index_of(step.place);
      if (index != accel::kNoNode) node = index;
    }
    output.nodes.push_back(node);
  }
  output.path = std::move(path);
  return output;
}

void PaneInspection::look_at_rays(const PaneTracer& tracer, const PaneRequest& request) {
  const bool traceable = tracer.structure() != nullptr && !tracer.fitted_on_device();
  const bool inside = request.hover && request.hover->x >= 0 && request.hover->y >= 0 &&
                      request.hover->x < request.width && request.hover->y < request.height;
  if (!inside || !traceable) {
    hover_.reset();
    hovered_.reset();
  } else {
    const Asked asked{*request.hover, request.camera, request.width, request.height,
                      tracer.content_serial()};
    if (hovered_ != asked) {
      hovered_ = asked;
      hover_ = probe(
          tracer,
          {*request.hover, ray_of(request.camera, *request.hover, request.width, request.height)},
          false);
    }
  }
  if (!request.pick || !traceable) {
    pick_.reset();
    picked_.reset();
  } else if (picked_ != request.pick || picked_of_ != tracer.structure_serial()) {
    picked_ = request.pick;
    picked_of_ = tracer.structure_serial();
    pick_ = probe(tracer, *request.pick, true);
  }
}

bool PaneInspection::look(PaneTracer& tracer, const PaneRequest& request,
                          const std::atomic<bool>* cancel) {
  look_at_figures(tracer);
  look_at_nodes(tracer, request, cancel);
  look_at_selection(tracer, request);
  look_at_rays(tracer, request);
  return look_from_free_view(tracer, request, cancel) && !is_cancelled(cancel);
}

void PaneInspection::fill(PaneOutput& output) const {
  output.stats = stats_;
  output.sah_decay = decay_;
  output.nodes = nodes_;
  if (nodes_) output.bounds = nodes_->bounds();
  output.profile = profile_;
  output.node_values = colors_;
  output.selected_triangles = selected_triangles_;
  output.selected_shapes = selected_shapes_;
  output.free = free_picture_;
  output.hover = hover_;
  output.pick = pick_;
}

}  // namespace encore::app
