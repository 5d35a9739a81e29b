#include "app/render_report.h"

#include "app/json_text.h"
#include "app/number_text.h"
#include "renderer/difference_image.h"

#include <fmt/format.h>

namespace encore::app {

namespace {

std::string json_optional(const std::optional<double>& value) {
  return value ? json_number(*value) : "null";
}

template <class Integer>
std::string json_count(const std::optional<Integer>& value) {
  return value ? fmt::format("{}", *value) : "null";
}

std::string json_text_or_null(const std::string& text) {
  return text.empty() ? "null" : json_text(text);
}

std::optional<double> million_rays_per_s(const RenderReport& r) {
  if (!traces_rays(r.figures.device)) return std::nullopt;
  const double pixels = double(r.size.width) * double(r.size.height);
  const double rays = r.figures.rays ? double(r.figures.rays->rays()) : pixels;
  return rays / (1000.0 * r.figures.draw_ms);
}

/// The kinds of rays that there were: how many, and their share of the time.
std::string json_rays(const DrawFigures& f) {
  if (!f.rays) return "null";
  std::string json = "{";
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    const auto kind = static_cast<scene::RayKind>(i);
    const std::optional<double> share = f.rays->share(kind);
    json += fmt::format("{}{}: {{\"rays\": {}, \"ms\": {}}}", i > 0 ? ", " : "",
                        json_text(scene::to_string(kind)), (*f.rays)[kind].rays,
                        json_optional(share ? std::optional(*share * f.draw_ms) : std::nullopt));
  }
  return json + "}";
}

std::string json_heatmap(const RenderReport& r, const RenderOptions& options) {
  const auto& c = r.costs;
  if (!c) return "null";
  return fmt::format(
      "{{\"quantity\": {}, \"min\": {}, \"median\": {}, \"percentile_99\": {}, \"max\": {}, "
      "\"mean\": {}}}",
      json_text(options.heatmap), c->min, c->median, c->percentile_99, c->max,
      json_number(c->mean));
}

std::string json_comparison(const std::optional<RenderComparison>& c,
                            const RenderOptions& options) {
  if (!c) return "null";
  const renderer::ImageDifference& d = c->difference;
  return fmt::format(
      "{{\"device\": {}, \"device_name\": {}, \"trace_ms\": {}, \"rmse\": {}, \"largest\": {}, "
      "\"largest_x\": {}, \"largest_y\": {}, \"differing_pixels\": {}, \"differing_hits\": {}, "
      "\"difference\": {}}}",
      json_text(to_string(c->figures.device)), json_text_or_null(c->figures.device_name),
      json_number(c->figures.draw_ms), json_number(d.rmse), json_number(d.largest), d.largest_x,
      d.largest_y, d.differing, json_count(c->differing_hits),
      json_text_or_null(options.difference));
}

void print_json(const RenderReport& r, const RenderOptions& options) {
  const DrawFigures& f = r.figures;
  const bool sent = f.transfer_ms.has_value();
  fmt::print(
      "{{\"file\": {}, \"scene\": {}, \"triangles\": {}, \"time_s\": {}, \"device\": {}, "
      "\"device_name\": {}, \"structure\": {}, \"width\": {}, \"height\": {}, \"threads\": {}, "
      "\"build_ms\": {}, \"transfer_bytes\": {}, \"converted_bytes\": {}, \"transfer_ms\": {}, "
      "\"transfer_device_ms\": {}, \"warm_up_ms\": {}, \"trace_ms\": {}, \"trace_device_ms\": {}, "
      "\"million_rays_per_s\": {}, \"rays\": {}, \"hits\": {}, \"heatmap\": {}, \"comparison\": "
      "{}}}\n",
      json_text(options.out), json_text(r.scene), r.triangles, json_number(options.time_s),
      json_text(to_string(f.device)), json_text_or_null(f.device_name),
      json_text_or_null(r.structure), r.size.width, r.size.height, json_count(f.threads),
      json_optional(r.build_ms), sent ? fmt::format("{}", f.transfer_bytes) : "null",
      sent ? fmt::format("{}", f.converted_bytes) : "null", json_optional(f.transfer_ms),
      json_optional(f.transfer_device_ms), json_optional(f.warm_up_ms), json_number(f.draw_ms),
      json_optional(f.draw_device_ms), json_optional(million_rays_per_s(r)), json_rays(f),
      json_count(f.hits), json_heatmap(r, options), json_comparison(r.comparison, options));
}

std::string device_text(const DrawFigures& f) {
  if (f.device == Device::cpu) return "the CPU";
  return fmt::format("{} ({})", f.device == Device::gpu ? "the GPU" : "raster", f.device_name);
}

std::string device_clock(const std::optional<double>& ms) {
  return ms ? fmt::format(" ({:.2f} ms by the device's clock)", *ms) : "";
}

/// ", shadow 65536 rays (12.3 ms)" for each kind of rays beyond the camera's.
std::string ray_text(const DrawFigures& f) {
  if (!f.rays) return {};
  std::string text;
  for (std::size_t i = 1; i < scene::kRayKinds; ++i) {
    const auto kind = static_cast<scene::RayKind>(i);
    if ((*f.rays)[kind].rays == 0) continue;
    text += fmt::format(", {} {} rays", (*f.rays)[kind].rays, scene::to_string(kind));
    if (const auto share = f.rays->share(kind)) {
      text += fmt::format(" ({:.2f} ms)", *share * f.draw_ms);
    }
  }
  return text;
}

std::string picture_line(const RenderReport& r, const RenderOptions& options) {
  const DrawFigures& f = r.figures;
  std::string line = fmt::format("{}: {}x{}", options.out, r.size.width, r.size.height);
  if (f.device != Device::cpu) line += " by " + device_text(f);
  if (traces_rays(f.device)) {
    line += fmt::format(", {}, build {:.2f} ms", r.structure, r.build_ms.value_or(0.0));
  }
  if (f.transfer_ms) {
    line += fmt::format(", sent {} in {:.2f} ms{}", bytes_text(f.transfer_bytes), *f.transfer_ms,
                        device_clock(f.transfer_device_ms));
  }
  line += fmt::format(", {} {:.2f} ms{}", traces_rays(f.device) ? "trace" : "draw", f.draw_ms,
                      device_clock(f.draw_device_ms));
  if (f.warm_up_ms) {
    line += fmt::format(" after one warm-up frame ({:.2f} ms with compiling)", *f.warm_up_ms);
  }
  if (const auto rate = million_rays_per_s(r)) line += fmt::format(", {:.2f} Mrays/s", *rate);
  if (f.hits) line += fmt::format(", {} hits", *f.hits);
  return line + ray_text(f);
}

void print_comparison(const RenderComparison& c, const RenderReport& r,
                      const RenderOptions& options, Terminal& terminal) {
  const renderer::ImageDifference& d = c.difference;
  const std::string hits =
      c.differing_hits ? fmt::format("; hits differ in {}", *c.differing_hits) : "";
  terminal.info(fmt::format(
      "against {}, {} {:.2f} ms: RMSE {:.3g}, largest channel difference {:.3g}{}, {} of {} "
      "pixels differ{}",
      device_text(c.figures), traces_rays(c.figures.device) ? "trace" : "draw", c.figures.draw_ms,
      d.rmse, d.largest,
      d.largest > 0.0 ? fmt::format(" at ({}, {})", d.largest_x, d.largest_y) : "", d.differing,
      std::uint64_t(r.size.width) * std::uint64_t(r.size.height), hits));
  if (options.difference.empty()) return;
  terminal.info(fmt::format(
      "{}: black equal; dark to light {:g} to {:g}, largest channel of linear RGB, logarithmic{}",
      options.difference, renderer::kDifferenceFirst, renderer::kDifferenceLast,
      c.differing_hits ? "; magenta where hits differ" : ""));
}

}  // namespace

void print_render_report(const RenderReport& report, const RenderOptions& options,
                         Terminal& terminal) {
  if (options.json) return print_json(report, options);
  terminal.info(picture_line(report, options));
  if (const auto& c = report.costs) {
    terminal.info(fmt::format(
        "{} a ray: min {}, median {}, mean {:.2f}, 99th percentile {} (last colour), max {}",
        options.heatmap, c->min, c->median, c->mean, c->percentile_99, c->max));
  }
  if (report.comparison) print_comparison(*report.comparison, report, options, terminal);
}

}  // namespace encore::app
