#include "app/stability_report.h"

#include "app/json_text.h"
#include "app/number_text.h"

#include <fmt/format.h>

namespace encore::app {

namespace {

constexpr const char* kLine =
    "{:<20} {:>9} {:<10} {:<15} {:<3} {:<12} {:>8} {:>7} {:>7} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9} "
    "{:>10} {:>7} {}\n";

std::string number(const std::optional<double>& value, double factor, const char* missing) {
  return value ? fmt::format("{:.3g}", *value * factor) : missing;
}

template <class Integer>
std::string whole(const std::optional<Integer>& value, const char* missing) {
  return value ? fmt::format("{}", *value) : missing;
}

std::string json_seconds(const std::optional<double>& value) {
  return value ? json_number(*value) : "null";
}

std::string verdict(const StabilityRow& row) {
  if (!row.broken.empty()) return "BROKEN";
  std::string word = row.mode == accel::IntersectionMode::moller_trumbore ? "reported" : "ok";
  if (row.limited) word += ", limited";
  return word;
}

}  // namespace

void print_stability_header() {
  fmt::print(kLine, "case", "triangles", "structure", "mode", "on", "against", "rays", "missed",
             "false", "other", "excused", "t error", "steps", "build ms", "refit ms",
             "trace us/ray", "bytes/T", "verdict");
}

void print_stability_row(const StabilityRow& row) {
  const StabilityTally& t = row.tally;
  const std::uint64_t other = t.wrong_triangle + t.wrong_distance + t.wrong_occlusion;
  const auto per_ray = row.trace_s && t.rays > 0
                           ? std::optional(*row.trace_s / static_cast<double>(t.rays))
                           : std::nullopt;
  const auto per_triangle =
      row.bytes && row.triangles > 0
          ? std::optional(static_cast<double>(*row.bytes) / static_cast<double>(row.triangles))
          : std::nullopt;
  fmt::print(kLine, row.name, row.triangles, row.structure, accel::to_string(row.mode), row.device,
             row.against, t.rays, t.missed, t.invented, other, t.excused,
             row.against == "closed mesh" ? "-" : fmt::format("{:.1e}", t.largest_error),
             whole(row.most_steps, "-"), number(row.build_s, 1e3, "-"),
             number(row.update_s, 1e3, "-"), number(per_ray, 1e6, "-"),
             number(per_triangle, 1.0, "-"), verdict(row));
  if (!row.broken.empty()) fmt::print("  broken: {}\n", row.broken);
}

std::string json_stability_row(const StabilityRow& row) {
  const StabilityTally& t = row.tally;
  const std::string error = row.against == "closed mesh" ? "null" : json_number(t.largest_error);
  return fmt::format(
      "{{\"case\": {}, \"triangles\": {}, \"structure\": {}, \"intersection\": {}, \"device\": {}, "
      "\"action\": {}, \"against\": {}, \"rays\": {}, \"hits\": {}, \"missed\": {}, "
      "\"invented\": {}, \"wrong_triangle\": {}, \"wrong_distance\": {}, \"wrong_occlusion\": {}, "
      "\"excused\": {}, \"largest_relative_t_error\": {}, \"most_steps\": {}, \"build_s\": {}, "
      "\"refit_s\": {}, \"trace_s\": {}, \"bytes\": {}, \"build_asked_bytes\": {}, "
      "\"references\": {}, \"limited\": {}, \"broken\": {}}}",
      json_text(row.name), row.triangles, json_text(row.structure),
      json_text(accel::to_string(row.mode)), json_text(row.device), json_text(row.action),
      json_text(row.against), t.rays, t.hits, t.missed, t.invented, t.wrong_triangle,
      t.wrong_distance, t.wrong_occlusion, t.excused, error, whole(row.most_steps, "null"),
      json_seconds(row.build_s), json_seconds(row.update_s), json_seconds(row.trace_s),
      whole(row.bytes, "null"), whole(row.asked_bytes, "null"), whole(row.references, "null"),
      row.limited, row.broken.empty() ? "null" : json_text(row.broken));
}

}  // namespace encore::app
