#pragma once

#include "energy/sources/sensor_root.h"

#include <optional>
#include <string>

namespace encore::energy {

/// What of the processor and of its surroundings decides which sensors there are and what they
/// mean.
struct Host {
  bool amd = false;  ///< AMD or its licensee: RAPL zones with other meanings
  bool sgx = false;  ///< the processor blurs its energy counters to protect enclaves
  /// As in Machine: unknown on processors that do not say so.
  std::optional<bool> virtual_machine;
  bool container = false;
};

/// Reads /proc/cpuinfo and the marks that container runtimes leave.
Host read_host(const SensorRoot& root);

/// Whether the processor says that a hypervisor runs below; false if it does not say.
bool is_virtual_machine(const SensorRoot& root);

/// Half a sentence on why kernel energy counters are not there, to be put behind the bare fact;
/// empty on a plain machine.
std::string why_no_counters(const Host& host);
/// What to do if they are not there; `module` is the kernel module that offers them.
std::string way_to_counters(const Host& host, std::string_view module);

}  // namespace encore::energy
