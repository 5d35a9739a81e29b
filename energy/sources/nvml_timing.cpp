#include "energy/sources/nvml_timing.h"

#include <string>

namespace encore::energy {

namespace {

struct ProductWord {
  std::string_view begin_of_word;
  NvidiaGeneration generation;
};

// The first that fits holds, so that narrower ones stand above wider ones.
constexpr ProductWord kProducts[] = {
    {" Ada", NvidiaGeneration::ada},
    {" Blackwell", NvidiaGeneration::blackwell},
    {" Quadro RTX", NvidiaGeneration::turing},
    {" RTX A", NvidiaGeneration::ampere},
    {" GTX TITAN X", NvidiaGeneration::maxwell},
    {" GeForce RTX 50", NvidiaGeneration::blackwell},
    {" GeForce RTX 40", NvidiaGeneration::ada},
    {" GeForce RTX 30", NvidiaGeneration::ampere},
    {" GeForce RTX 20", NvidiaGeneration::turing},
    {" GeForce GTX 16", NvidiaGeneration::turing},
    {" GeForce GTX 10", NvidiaGeneration::pascal},
    {" GeForce GTX 9", NvidiaGeneration::maxwell},
    {" TITAN RTX", NvidiaGeneration::turing},
    {" TITAN V", NvidiaGeneration::volta},
    {" TITAN X", NvidiaGeneration::pascal},
    {" Quadro P", NvidiaGeneration::pascal},
    {" Quadro M", NvidiaGeneration::maxwell},
    {" GB200", NvidiaGeneration::blackwell},
    {" GB300", NvidiaGeneration::blackwell},
    {" B100", NvidiaGeneration::blackwell},
    {" B200", NvidiaGeneration::blackwell},
    {" GH200", NvidiaGeneration::hopper},
    {" H100", NvidiaGeneration::hopper},
    {" H200", NvidiaGeneration::hopper},
    {" H800", NvidiaGeneration::hopper},
    {" A100", NvidiaGeneration::ga100},
    {" A800", NvidiaGeneration::ga100},
    {" A30", NvidiaGeneration::ga100},
    {" A10", NvidiaGeneration::ampere},
    {" A16", NvidiaGeneration::ampere},
    {" A40", NvidiaGeneration::ampere},
    {" A2", NvidiaGeneration::ampere},
    {" L4", NvidiaGeneration::ada},
    {" T4", NvidiaGeneration::turing},
    {" V100", NvidiaGeneration::volta},
    {" GV100", NvidiaGeneration::volta},
    {" P100", NvidiaGeneration::pascal},
    {" P40", NvidiaGeneration::pascal},
    {" M40", NvidiaGeneration::maxwell},
    {" M60", NvidiaGeneration::maxwell},
};

constexpr NvmlTiming timing(double window_ms, double period_ms) {
  return {Seconds(window_ms / 1e3), Seconds(period_ms / 1e3)};
}

}  // namespace

NvidiaGeneration generation_of(std::string_view product) {
  const std::string words = " " + std::string(product);
  for (const ProductWord& known : kProducts) {
    if (words.find(known.begin_of_word) != std::string::npos) return known.generation;
  }
  return NvidiaGeneration::unknown;
}

bool is_module(std::string_view product) {
  for (const std::string_view name : {"GH200", "GB200", "GB300"}) {
    if (product.find(name) != std::string_view::npos) return true;
  }
  return false;
}

std::optional<NvmlTiming> gauge_timing(NvidiaGeneration generation, bool instant, int driver) {
  switch (generation) {
    case NvidiaGeneration::hopper:
      return instant ? timing(25, 100) : timing(1000, 100);
    case NvidiaGeneration::ga100:
      return timing(25, 100);
    case NvidiaGeneration::ampere:
    case NvidiaGeneration::ada:
      // The drivers of one series, 530, showed the short mean in both places.
      return instant || driver == 530 ? timing(100, 100) : timing(1000, 100);
    case NvidiaGeneration::turing:
      return timing(100, 100);
    case NvidiaGeneration::volta:
    case NvidiaGeneration::pascal:
      return timing(10, 20);
    case NvidiaGeneration::maxwell:
    case NvidiaGeneration::blackwell:
    case NvidiaGeneration::unknown:
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace encore::energy
