#include "app/window/overlay_picture.h"

#include "accel/inspect/node_table.h"
#include "accel/inspect/ray_path.h"
#include "renderer/camera_rays.h"
#include "renderer/heatmap_palette.h"
#include "scene/camera_basis.h"
#include "ui/overlay_range.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::app {

namespace {

constexpr std::uint32_t kMostInSoftware = 6'000;
constexpr std::uint32_t kMostMoving = 1'500;
constexpr std::uint32_t kNoValue = 0xFF808080U;
constexpr std::uint32_t kSelected = 0xFF30D8FFU;  // orange-yellow; red is the lowest byte
constexpr std::uint32_t kRayBefore = 0xFF50A0FFU;
constexpr std::uint32_t kRayAfter = 0x80A0A0A0U;
constexpr std::uint32_t kHitColor = 0xFF4040FFU;
constexpr std::uint32_t kFrustum = 0xC0E0C060U;

std::uint32_t with_opacity(std::uint32_t rgba, float opacity) {
  const auto alpha = static_cast<std::uint32_t>(std::clamp(opacity, 0.0F, 1.0F) * 255.0F + 0.5F);
  return (rgba & 0x00FFFFFFU) | (alpha << 24U);
}

renderer::OverlayMode mode_of(ui::HiddenLines hidden) {
  switch (hidden) {
    case ui::HiddenLines::hidden:
      return renderer::OverlayMode::hidden_line;
    case ui::HiddenLines::dimmed:
      return renderer::OverlayMode::dimmed;
    case ui::HiddenLines::x_ray:
      break;
  }
  return renderer::OverlayMode::x_ray;
}

accel::NodeView3d view_of(const OverlayScene& scene) {
  const scene::CameraBasis basis = scene::camera_basis(scene.camera);
  const glm::dvec3 eye(scene.camera.eye);
  if (scene.camera.orthographic()) {
    return accel::orthographic_view(eye, basis.forward, basis.up,
                                    double(scene.camera.orthographic_height), scene.width,
                                    scene.height);
  }
  return accel::perspective_view(eye, basis.forward, basis.up,
                                 double(scene.camera.vertical_fov_degrees), scene.width,
                                 scene.height);
}

/// The section plane as the overlay takes it: what is on its positive side is cut away.
std::optional<glm::vec4> section_of(const OverlayScene& scene) {
  const ui::OverlaySettings& settings = scene.settings;
  if (!settings.section || !scene.output->nodes) return std::nullopt;
  const scene::Bounds& bounds = scene.output->nodes->bounds();
  const int axis = std::clamp(settings.section_axis, 0, 2);
  const float at =
      bounds.min[axis] + (bounds.max[axis] - bounds.min[axis]) * settings.section_position;
  glm::vec4 plane(0.0F);
  plane[axis] = settings.section_flipped ? -1.0F : 1.0F;
  plane.w = settings.section_flipped ? at : -at;
  return plane;
}

}  // namespace

OverlayPicture::OverlayPicture(std::shared_ptr<renderer::gl::Context> context)
    : overlay_(context), software_(context->capabilities().software) {}

bool OverlayPicture::same(const OverlayScene& scene) const {
  const auto& a = drawn_;
  const auto& b = scene;
  return any_ && a.output == b.output && a.camera == b.camera && a.width == b.width &&
         a.height == b.height && a.background == b.background &&
         a.background_serial == b.background_serial && a.distances == b.distances &&
         a.settings == b.settings && a.with_nodes == b.with_nodes &&
         a.selected_node == b.selected_node && a.ray_step == b.ray_step &&
         a.with_ray == b.with_ray && (!software_ || a.moving == b.moving) &&
         a.other_camera == b.other_camera && a.other_aspect == b.other_aspect;
}

void OverlayPicture::send_nodes(const OverlayScene& scene) {
  const auto& table = scene.output->nodes;
  const auto& values = scene.output->node_values;
  const bool other_nodes = table != sent_nodes_;
  const bool other_colors = values != sent_values_ ||
                            scene.settings.opacity != drawn_.settings.opacity ||
                            scene.settings.first_depth != drawn_.settings.first_depth ||
                            scene.settings.last_depth != drawn_.settings.last_depth;
  if (!other_nodes && !other_colors && any_) return;
  colors_.assign(table->size(), with_opacity(kNoValue, scene.settings.opacity * 0.5F));
  if (values && values->count > 0 && values->values.size() == table->size()) {
    const auto range = ui::overlay_range(scene.settings, *values);
    const double low = double(range[0]);
    const double span = std::max(double(range[1]) - low, 1e-30);
    const auto codes = renderer::palette_codes(renderer::Palette::rainbow);
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      const float value = values->values[i];
      if (std::isnan(value)) continue;
      const double place = (double(value) - low) / span;
      colors_[i] = with_opacity(codes[renderer::palette_place(place)], scene.settings.opacity);
    }
  }
  ++version_;
  if (other_nodes) {
    std::vector<renderer::OverlayBox> boxes(table->size());
    const auto records = table->records();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i] = {records[i].bounds.min, colors_[i], records[i].bounds.max, 0};
    }
    overlay_.set_boxes(boxes, version_);
  }
  overlay_.set_box_colors(colors_, version_);
  sent_nodes_ = table;
  sent_values_ = values;
}

void OverlayPicture::choose_nodes(const OverlayScene& scene) {
  const ui::OverlaySettings& settings = scene.settings;
  accel::NodeQuery query;
  accel::NodeFilter& filter = query.filter;
  const bool tree = scene.output->nodes->kind() == accel::NodeKind::boxes ||
                    scene.output->nodes->kind() == accel::NodeKind::split_planes;
  if (tree) {
    filter.first_depth = static_cast<std::uint32_t>(std::max(settings.first_depth, 0));
    filter.last_depth = static_cast<std::uint32_t>(std::max(settings.last_depth, 0));
    filter.leaves = settings.leaves;
    filter.inner = settings.inner_nodes;
    filter.empty_leaves = settings.empty_leaves;
    filter.split_axes = settings.plane_axes;
  }
  filter.min_triangles = static_cast<std::uint32_t>(std::max(settings.least_triangles, 0));
  if (const auto plane = section_of(scene)) {
    // Nodes that are cut away altogether need not be drawn; the plane clips the others.
    accel::NodeSection section;
    section.plane.normal = -glm::dvec3(glm::vec3(*plane));
    section.plane.offset = -double(plane->w);
    filter.section = section;
  }
  if (settings.selected_subtree && scene.selected_node &&
      *scene.selected_node < scene.output->nodes->size()) {
    filter.subtree = *scene.selected_node;
  }
  query.view = view_of(scene);
  query.smallest_pixels = settings.smallest_pixels;
  query.budget = static_cast<std::uint32_t>(std::max(settings.most_nodes, 1));
  // Drawn by the window's own thread on the processor, more would hold the window up.
  if (software_)
    query.budget = std::min(query.budget, scene.moving ? kMostMoving : kMostInSoftware);
  query.order = accel::NodeOrder::farthest_first;
  selection_ = accel::select_nodes(*scene.output->nodes, query);
}

void OverlayPicture::add_planes(const OverlayScene& scene) {
  const accel::NodeTable& table = *scene.output->nodes;
  if (table.kind() != accel::NodeKind::split_planes || !scene.settings.planes) return;
  for (const std::uint32_t node : selection_.nodes) {
    const auto corners = accel::clipped_plane(table[node]);
    if (!corners) continue;
    renderer::OverlayQuad quad;
    std::copy(corners->begin(), corners->end(), quad.corners);
    quad.rgba = with_opacity(colors_[node], scene.settings.opacity * 0.12F);
    quads_.push_back(quad);
  }
}

void OverlayPicture::add_selection(const OverlayScene& scene) {
  if (!scene.selected_node || !scene.output->nodes ||
      *scene.selected_node >= scene.output->nodes->size()) {
    return;
  }
  const scene::Bounds& box = (*scene.output->nodes)[*scene.selected_node].bounds;
  const auto corner = [&box](int i) {
    return glm::vec3((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                     (i & 4) != 0 ? box.max.z : box.min.z);
  };
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) {
      if ((i & bit) == 0) segments_.push_back({corner(i), corner(i | bit), kSelected, 2.5F});
    }
  }
  for (const scene::Triangle& triangle : scene.output->selected_shapes) {
    renderer::OverlayTriangle shape;
    shape.corners[0] = triangle.v0;
    shape.corners[1] = triangle.v1;
    shape.corners[2] = triangle.v2;
    shape.rgba = with_opacity(kSelected, 0.35F);
    triangles_.push_back(shape);
  }
}

void OverlayPicture::add_ray(const OverlayScene& scene) {
  if (!scene.with_ray || !scene.output->pick) return;
  const ProbeOutput& pick = *scene.output->pick;
  const scene::Bounds& bounds = scene.output->bounds;
  const glm::vec3 extent = bounds.max - bounds.min;
  const float size = std::isfinite(glm::length(extent)) ? glm::length(extent) : 1.0F;
  const float end = pick.pixel.found ? static_cast<float>(pick.pixel.distance)
                                     : glm::length(pick.ray.origin - bounds.center()) + size;
  const auto at = [&pick](float t) { return pick.ray.origin + pick.ray.direction * t; };
  // Up to where the current step has got.
  float now = end;
  if (pick.path && scene.ray_step < pick.path->steps.size()) {
    const accel::RayStep& step = pick.path->steps[scene.ray_step];
    now = std::isfinite(step.enter) ? std::clamp(step.enter, 0.0F, end) : 0.0F;
    if (!std::isfinite(step.enter)) {
      for (std::size_t i = scene.ray_step; i-- > 0;) {
        if (!std::isfinite(pick.path->steps[i].enter)) continue;
        now = std::clamp(pick.path->steps[i].enter, 0.0F, end);
        break;
      }
    }
    if (step.triangle != scene::kNoHit) points_.push_back({at(now), kHitColor, 9.0F});
  }
  segments_.push_back({at(0.0F), at(now), kRayBefore, 2.5F});
  segments_.push_back({at(now), at(end), kRayAfter, 1.5F});
  points_.push_back({at(now), kRayBefore, 7.0F});
  if (pick.pixel.found) points_.push_back({at(end), kHitColor, 7.0F});
}

void OverlayPicture::add_frustum(const OverlayScene& scene) {
  if (!scene.other_camera) return;
  const scene::Camera& camera = *scene.other_camera;
  const scene::CameraBasis basis = scene::camera_basis(camera);
  const double far = glm::length(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
  const double half = scene::picture_height_at_target(camera) / 2.0;
  const glm::dvec3 middle = glm::dvec3(camera.eye) + basis.forward * far;
  std::array<glm::vec3, 4> corners;
  std::array<glm::vec3, 4> starts;
  for (int i = 0; i < 4; ++i) {
    const double x = (i == 0 || i == 3) ? -1.0 : 1.0;
    const double y = i < 2 ? 1.0 : -1.0;
    const glm::dvec3 offset = basis.right * (x * half * scene.other_aspect) + basis.up * (y * half);
    corners[std::size_t(i)] = glm::vec3(middle + offset);
    starts[std::size_t(i)] =
        camera.orthographic() ? glm::vec3(glm::dvec3(camera.eye) + offset) : camera.eye;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    segments_.push_back({starts[i], corners[i], kFrustum, 1.2F});
    segments_.push_back({corners[i], corners[(i + 1) % 4], kFrustum, 1.2F});
  }
  points_.push_back({camera.eye, kFrustum, 8.0F});
}

std::uint32_t OverlayPicture::draw(const OverlayScene& scene) {
  if (same(scene)) return overlay_.texture();
  boxes_.clear();
  quads_.clear();
  segments_.clear();
  points_.clear();
  triangles_.clear();
  selection_ = {};
  if (scene.with_nodes && scene.output->nodes && !scene.output->nodes->empty()) {
    send_nodes(scene);
    choose_nodes(scene);
    if (scene.settings.boxes) boxes_ = selection_.nodes;
    add_planes(scene);
  }
  add_selection(scene);
  add_ray(scene);
  add_frustum(scene);
  if (scene.distances != drawn_.distances || !any_) {
    if (scene.distances) {
      overlay_.set_depth(*scene.distances, scene.distances_width, scene.distances_height);
    } else {
      overlay_.clear_depth();
    }
  }
  renderer::OverlayView view;
  view.camera = scene.camera;
  view.width = scene.width;
  view.height = scene.height;
  view.mode = mode_of(scene.settings.hidden);
  view.section_plane = section_of(scene);
  view.background_texture = scene.background;
  view.edge_px = scene.settings.line_pixels;
  view.fill_all = scene.settings.filled;
  drawn_ = scene;
  any_ = true;
  return overlay_.draw(view, {boxes_, quads_, segments_, points_, triangles_});
}

std::optional<std::uint32_t> OverlayPicture::node_at(int x, int y) const {
  if (!any_ || !drawn_.output || !drawn_.output->nodes || drawn_.width <= 0) return std::nullopt;
  if (x < 0 || y < 0 || x >= drawn_.width || y >= drawn_.height) return std::nullopt;
  const auto frame = renderer::make_camera_frame(drawn_.camera, drawn_.width, drawn_.height);
  std::array<scene::Ray, 1> ray;
  renderer::camera_rays(frame, {x, y, x + 1, y + 1}, ray);
  const std::uint32_t node = accel::pick_node(*drawn_.output->nodes, selection_.nodes, ray[0]);
  if (node == accel::kNoNode) return std::nullopt;
  return node;
}

}  // namespace encore::app
