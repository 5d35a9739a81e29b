// Feeds arbitrary bytes to what is read below /sys and /proc; none of it throws. The first byte
// picks: '0' a battery's uevent, '1' two texts of /proc/stat with a line "-" between them, '2' a
// list of processors, '3' the perf PMU of energy (lines: mask, event, scale, unit, type, package).
#include "energy/sources/perf_pmu.h"
#include "energy/sources/power_supply.h"
#include "energy/sources/utilisation_model.h"
#include "tests/fuzz/check_text.h"
#include "tests/support/files.h"

#include <array>

namespace {

using namespace encore;
using namespace encore::energy;

void check_battery(std::string_view uevent) {
  const SensorFiles files(SensorRoot("/nowhere"), [&](std::string_view file) {
    return file.ends_with("/uevent") ? FileText{std::string(uevent), 0} : FileText{{}, ENOENT};
  });
  const SupplySnapshot supply = read_supply(files, "BAT0");
  const auto rate = supply.rate();
  fuzz::require_finite(rate);
  fuzz::require(!rate || *rate > Watts(0));
  for (const auto& energy : {supply.stored(), supply.full(), supply.design()}) {
    fuzz::require_finite(energy);
  }
  fuzz::require_finite(supply.charge_now());
  (void)supply.is_system_battery();
  (void)supply.discharging();
}

void check_load(std::string_view text) {
  const std::size_t split = text.find("\n-\n");
  const auto from = parse_proc_stat(text.substr(0, split));
  if (from) fuzz::require(from->processors >= 1);
  if (split == std::string_view::npos) return;
  const auto to = parse_proc_stat(text.substr(split + 3));
  if (!from || !to) return;
  const auto load = utilisation_between(*from, *to);
  if (!load) return;
  fuzz::require(load->busy >= 0 && load->stolen >= 0 && load->busy + load->stolen <= 1.0 + 1e-9);
}

void check_cpu_list(std::string_view text) {
  const auto cpus = parse_cpu_list(text);
  fuzz::require(!cpus || (!cpus->empty() && cpus->size() <= 65536));
}

void check_pmu(std::string_view text) {
  // Every processor costs a look for its package; a few are as good as thousands.
  const auto mask = parse_cpu_list(text.substr(0, text.find('\n')));
  if (mask && mask->size() > 16) return;
  static const test::TemporaryFolder folder;
  constexpr std::string_view kPmu = "sys/bus/event_source/devices/power";
  constexpr std::array<std::string_view, 6> kFiles = {
      "cpumask", "events/energy-pkg", "events/energy-pkg.scale", "events/energy-pkg.unit", "type",
      ""};
  for (const std::string_view file : kFiles) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string name = file.empty()
                                 ? "sys/devices/system/cpu/cpu0/topology/physical_package_id"
                                 : std::string(kPmu).append("/").append(file);
    folder.write(name, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  for (const PerfEvent& event : list_perf_events(SensorRoot(folder.path()))) {
    fuzz::require(!event.problem.empty() || (event.scale > 0 && event.scale <= 10));
    const SourceInfo info = describe_perf_event(event);
    fuzz::require_finite(info.energy_step);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = fuzz::choice_of(data, size, 4);
  if (!input) return 0;
  switch (input->which) {
    case 0:
      check_battery(input->text);
      break;
    case 1:
      check_load(input->text);
      break;
    case 2:
      check_cpu_list(input->text);
      break;
    default:
      check_pmu(input->text);
      break;
  }
  return 0;
}
