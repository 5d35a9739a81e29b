#include "accel/simd/isa.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace encore::accel {

namespace {

constexpr std::array<std::pair<Isa, std::string_view>, 4> kNames{{{Isa::portable, "portable"},
                                                                  {Isa::sse42, "sse4.2"},
                                                                  {Isa::avx2, "avx2"},
                                                                  {Isa::avx512, "avx-512"}}};

bool available(Isa isa) {
  switch (isa) {
    case Isa::portable:
      return true;
#if defined(__x86_64__)
    case Isa::sse42:
      return __builtin_cpu_supports("sse4.2") != 0;
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi2") != 0;
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
             __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
#else
    default:
      return false;
#endif
  }
  return false;
}

Isa choose() {
  const char* const wish = std::getenv("ENCORE_ISA");
  if (wish == nullptr || *wish == '\0') return available_isas().back();
  std::string names;
  for (const Isa isa : available_isas()) {
    if (to_string(isa) == wish) return isa;
    names += names.empty() ? "" : ", ";
    names += to_string(isa);
  }
  throw std::runtime_error(
      fmt::format("ENCORE_ISA is '{}'; this machine has {}. Unset it to have the program choose.",
                  wish, names));
}

}  // namespace

std::string_view to_string(Isa isa) {
  return kNames.at(static_cast<std::size_t>(isa)).second;
}

const std::vector<Isa>& available_isas() {
  static const std::vector<Isa> all = [] {
    std::vector<Isa> found;
    for (const auto& [isa, name] : kNames) {
      if (available(isa)) found.push_back(isa);
    }
    return found;
  }();
  return all;
}

Isa chosen_isa() {
  static const Isa chosen = choose();
  return chosen;
}

}  // namespace encore::accel
