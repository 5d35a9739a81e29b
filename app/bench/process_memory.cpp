#include "app/bench/process_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>
#include <string_view>

namespace encore::app::bench {

namespace {

std::optional<std::uint64_t> status_bytes(std::string_view field) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(field)) continue;
    return std::uint64_t{1024} * std::stoull(line.substr(field.size()));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> resident_bytes() {
  return status_bytes("VmRSS:");
}

std::optional<std::uint64_t> peak_resident_bytes() {
  return status_bytes("VmHWM:");
}

bool forget_peak_resident() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace encore::app::bench
