#include "energy/sources/power_source.h"

namespace encore::energy {

std::string_view to_string(SourceKind kind) {
  switch (kind) {
    case SourceKind::rapl:
      return "rapl";
    case SourceKind::perf_energy:
      return "perf";
    case SourceKind::battery:
      return "battery";
    case SourceKind::hwmon:
      return "hwmon";
    case SourceKind::nvml:
      return "nvml";
    case SourceKind::meter:
      return "meter";
    case SourceKind::replay:
      return "replay";
    case SourceKind::model:
      return "model";
    case SourceKind::simulated:
      return "simulated";
  }
  return "";
}

std::string_view to_string(Domain domain) {
  switch (domain) {
    case Domain::system:
      return "system";
    case Domain::platform:
      return "platform";
    case Domain::package:
      return "package";
    case Domain::cores:
      return "cores";
    case Domain::integrated_gpu:
      return "integrated-gpu";
    case Domain::memory:
      return "memory";
    case Domain::gpu:
      return "gpu";
    case Domain::socket:
      return "socket";
  }
  return "";
}

std::optional<SourceKind> parse_source_kind(std::string_view word) {
  for (const SourceKind kind : {SourceKind::rapl, SourceKind::perf_energy, SourceKind::battery,
                                SourceKind::hwmon, SourceKind::nvml, SourceKind::meter,
                                SourceKind::replay, SourceKind::model, SourceKind::simulated}) {
    if (word == to_string(kind)) return kind;
  }
  return std::nullopt;
}

std::optional<Domain> parse_domain(std::string_view word) {
  for (const Domain domain :
       {Domain::system, Domain::platform, Domain::package, Domain::cores, Domain::integrated_gpu,
        Domain::memory, Domain::gpu, Domain::socket}) {
    if (word == to_string(domain)) return domain;
  }
  return std::nullopt;
}

bool holds(Domain outer, Domain inner) {
  if (outer == inner) return false;
  switch (outer) {
    case Domain::system:
      return true;
    case Domain::platform:
      return inner == Domain::memory || inner == Domain::socket || holds(Domain::socket, inner);
    case Domain::socket:
      return inner == Domain::package || holds(Domain::package, inner);
    case Domain::package:
      return inner == Domain::cores || inner == Domain::integrated_gpu;
    default:
      return false;
  }
}

}  // namespace encore::energy
