#include "energy/sources/discover.h"

#include "energy/sources/perf_energy.h"

#include <exception>
#include <iterator>

namespace encore::energy {

namespace {

template <class Find>
std::vector<Finding> guarded(SourceKind kind, const Find& find) {
  try {
    return find();
  } catch (const std::exception& error) {
    Finding finding;
    finding.info.name = to_string(kind);
    finding.info.kind = kind;
    finding.info.provenance = {Origin::unavailable, error.what()};
    finding.obstacle = Obstacle{error.what(), {}};
    return {finding};
  }
}

void append(std::vector<Finding>& all, std::vector<Finding> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<Finding> discover(const SensorRoot& root, const std::string& nvml_library) {
  std::vector<Finding> all = guarded(SourceKind::rapl, [&] { return find_rapl(root); });
  std::vector<Finding> perf =
      guarded(SourceKind::perf_energy, [&] { return find_perf_energy(root); });
  set_repeated_aside(perf, all);
  append(all, std::move(perf));
  append(all, guarded(SourceKind::battery, [&] { return find_batteries(root); }));
  append(all, guarded(SourceKind::hwmon, [&] { return find_hwmon(root); }));
  append(all, guarded(SourceKind::nvml, [&] { return find_nvml(root, nvml_library); }));
  return all;
}

}  // namespace encore::energy
