#include "app/gpu_verification_report.h"

#include "app/json_text.h"
#include "renderer/difference_image.h"
#include "renderer/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace encore::app {

namespace {

std::string describe_hit(const scene::Hit& hit) {
  if (!hit.found()) return "no hit";
  return fmt::format("triangle {} at t = {:.9g}, u = {:.9g}, v = {:.9g}", hit.triangle, hit.t,
                     hit.u, hit.v);
}

std::string describe_clearance(const std::optional<double>& clearance) {
  return clearance ? fmt::format("{:.3g} of the triangle", *clearance) : "unknown";
}

void print_mismatch(const DeviceMismatch& m) {
  const scene::Ray& r = m.ray;
  fmt::print(
      "  first mismatch, {} ({}): origin ({:.9g}, {:.9g}, {:.9g}), direction ({:.9g}, {:.9g}, "
      "{:.9g}), t in ({:.9g}, {:.9g}]\n    CPU    {}\n    GPU    {}\n    oracle {}; edge clearance "
      "{}\n",
      m.kind, to_string(m.difference.explanation), r.origin.x, r.origin.y, r.origin.z,
      r.direction.x, r.direction.y, r.direction.z, r.t_min, r.t_max, describe_hit(m.expected),
      describe_hit(m.found), describe_hit(m.difference.oracle),
      describe_clearance(m.difference.clearance));
}

std::string json_hit(const scene::Hit& hit) {
  if (!hit.found()) return "null";
  return fmt::format("{{\"triangle\": {}, \"t\": {}, \"u\": {}, \"v\": {}}}", hit.triangle,
                     json_number(hit.t), json_number(hit.u), json_number(hit.v));
}

std::string json_vector(const glm::vec3& v) {
  return fmt::format("[{}, {}, {}]", json_number(v.x), json_number(v.y), json_number(v.z));
}

std::string json_mismatch(const std::optional<DeviceMismatch>& m) {
  if (!m) return "null";
  return fmt::format(
      "{{\"kind\": {}, \"explanation\": {}, \"origin\": {}, \"direction\": {}, \"t_min\": {}, "
      "\"t_max\": {}, \"cpu\": {}, \"gpu\": {}, \"oracle\": {}, \"edge_clearance\": {}}}",
      json_text(m->kind), json_text(to_string(m->difference.explanation)),
      json_vector(m->ray.origin), json_vector(m->ray.direction), json_number(m->ray.t_min),
      json_number(m->ray.t_max), json_hit(m->expected), json_hit(m->found),
      json_hit(m->difference.oracle),
      m->difference.clearance ? json_number(*m->difference.clearance) : "null");
}

double share_of_pixels(const DeviceRow& row) {
  return row.pixels == 0 ? 0.0 : double(row.differing_pixels) / double(row.pixels);
}

/// A scene's name as part of a file's name.
std::string file_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return c < 0x80 && std::isalnum(c) == 0 && c != '-' && c != '.'; },
      '_');
  return name;
}

}  // namespace

void DeviceVerificationSums::add(const DeviceRow& row) {
  pixels += row.pixels;
  rays += row.hits.rays - row.pixels;
  differences += row.hits.mismatches();
  unexplained += row.unexplained();
  if (!row.problem.empty()) {
    ++uncompared_rows;
  } else if (!row.passed()) {
    ++failed_rows;
  }
}

void print_device_header() {
  fmt::print(
      "{:<15} {:>9}  {:<11} {:<7} {:>7} {:>7} {:>8} {:>7} {:>8} {:>9} {:>9} {:>9} {:>11} "
      "{:>8} {:>8} {:>8}\n",
      "scene", "triangles", "structure", "action", "pixels", "rays", "hits", "missed", "invented",
      "triangle", "distance", "explained", "unexplained", "pixels %", "RMSE", "largest");
}

void print_device_row(const std::string& scene, const DeviceRow& row) {
  const accel::HitComparison& h = row.hits;
  if (!row.problem.empty()) {
    fmt::print("{:<15} {:>9}  {:<11} {:<7} not compared: {}\n", scene, row.triangles, row.structure,
               row.action, row.problem);
    return;
  }
  fmt::print(
      "{:<15} {:>9}  {:<11} {:<7} {:>7} {:>7} {:>8} {:>7} {:>8} {:>9} {:>9} {:>9} {:>11} "
      "{:>8.3g} {:>8.2g} {:>8.2g}\n",
      scene, row.triangles, row.structure, row.action, row.pixels, h.rays - row.pixels, h.hits,
      h.missed, h.invented, h.wrong_triangle, h.wrong_distance, row.explained, row.unexplained(),
      100.0 * share_of_pixels(row), row.picture.rmse, row.picture.largest);
  if (row.first) print_mismatch(*row.first);
  if (!row.passed() && row.unexplained() == 0) {
    fmt::print("  {} of {} pixels differ, more than 0.01 %\n", row.differing_pixels, row.pixels);
  }
}

void print_device_sums(const DeviceVerificationSums& sums, bool interrupted) {
  fmt::print("{} pixels and {} rays compared, {} differ, {} unexplained{}{}\n", sums.pixels,
             sums.rays, sums.differences, sums.unexplained,
             sums.uncompared_rows > 0
                 ? fmt::format("; {} rows could not be compared", sums.uncompared_rows)
                 : "",
             interrupted ? " (interrupted)" : "");
}

std::string json_device_row(const std::string& scene, const std::string& device,
                            const DeviceRow& row) {
  const accel::HitComparison& h = row.hits;
  const std::string start = fmt::format(
      "{{\"scene\": {}, \"device\": \"gpu\", \"device_name\": {}, \"against\": \"cpu\", "
      "\"triangles\": {}, \"structure\": {}, \"action\": {}",
      json_text(scene), json_text(device), row.triangles, json_text(row.structure),
      json_text(row.action));
  if (!row.problem.empty()) {
    return fmt::format("{}, \"passed\": false, \"problem\": {}}}", start, json_text(row.problem));
  }
  return fmt::format(
      "{}, \"pixels\": {}, \"differing_pixels\": {}, \"rays\": {}, \"hits\": {}, \"missed\": {}, "
      "\"invented\": {}, \"wrong_triangle\": {}, \"wrong_distance\": {}, \"explained\": {}, "
      "\"unexplained\": {}, \"rmse\": {}, \"largest_difference\": {}, \"passed\": {}, "
      "\"problem\": null, \"first_mismatch\": {}}}",
      start, row.pixels, row.differing_pixels, h.rays - row.pixels, h.hits, h.missed, h.invented,
      h.wrong_triangle, h.wrong_distance, row.explained, row.unexplained(),
      json_number(row.picture.rmse), json_number(row.picture.largest), row.passed(),
      json_mismatch(row.first));
}

void write_device_pictures(const std::filesystem::path& folder, const std::string& scene,
                           const DeviceRow& row, const renderer::Image& expected,
                           const renderer::Image& found, std::span<const std::uint8_t> differs) {
  std::string start = fmt::format("{}-{}", file_name(scene), row.structure);
  if (row.action != "build") start += "-" + row.action;
  renderer::write_png(expected, folder / (start + "-cpu.png"));
  renderer::write_png(found, folder / (start + "-gpu.png"));
  renderer::write_png(renderer::difference_image(expected, found, differs),
                      folder / (start + "-difference.png"));
}

}  // namespace encore::app
