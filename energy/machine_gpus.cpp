#include "energy/machine_gpus.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

namespace encore::energy {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// "0x1002" as the list of PCI devices writes it: "1002".
std::string four_digits(const std::string& text) {
  return text.starts_with("0x") ? text.substr(2) : text;
}

/// The value behind "key" and a colon in a text of such lines.
std::string value_of(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t split = line.find(':');
    if (split == std::string_view::npos || trimmed(line.substr(0, split)) != key) continue;
    return std::string(trimmed(line.substr(split + 1)));
  }
  return {};
}

/// Looks a device up in the list of all PCI devices that distributions install: makers begin at the
/// start of a line, their devices after one tabulator.
std::optional<std::string> pci_name(const SensorRoot& root, const std::string& vendor,
                                    const std::string& device) {
  for (const char* path : {"/usr/share/hwdata/pci.ids", "/usr/share/misc/pci.ids"}) {
    std::ifstream list(root.resolve(path));
    bool inside = false;
    std::string maker;
    for (std::string line; std::getline(list, line);) {
      if (line.empty() || line[0] == '#' || line.starts_with("\t\t")) continue;
      if (line[0] != '\t') {
        if (inside) break;
        inside = line.starts_with(vendor + "  ");
        if (inside) maker = std::string(trimmed(std::string_view(line).substr(vendor.size())));
      } else if (inside && line.starts_with("\t" + device + "  ")) {
        return maker + " " + std::string(trimmed(std::string_view(line).substr(device.size() + 1)));
      }
    }
  }
  return std::nullopt;
}

/// Cards of NVIDIA's own driver, by their PCI address.
std::map<std::string, std::string> nvidia_names(const SensorRoot& root) {
  constexpr std::string_view kGpus = "/proc/driver/nvidia/gpus";
  std::map<std::string, std::string> names;
  for (const std::string& address : root.list(kGpus)) {
    const auto text = root.read(std::string(kGpus) + "/" + address + "/information").text;
    std::string name = value_of(text.value_or(""), "Model");
    names[address] = name.empty() ? "NVIDIA GPU" : name;
  }
  return names;
}

/// "nvidia" and the first word of its version's line that looks like one.
std::string nvidia_driver(const SensorRoot& root) {
  const std::string text = root.read("/proc/driver/nvidia/version").text.value_or("");
  std::string_view line(text);
  line = line.substr(0, line.find('\n'));
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(line.size(), word.size() + 1));
    const bool version = word.find('.') != std::string_view::npos &&
                         word.find_first_not_of("0123456789.") == std::string_view::npos;
    if (version) return "nvidia " + std::string(word);
  }
  return "nvidia";
}

std::string card_name(const SensorRoot& root, const std::string& device) {
  const std::string product = root.read(device + "/product_name").text.value_or("");
  if (!product.empty()) return product;
  const auto vendor = root.read(device + "/vendor").text;
  const auto model = root.read(device + "/device").text;
  if (!vendor || !model) return {};
  const std::string maker = four_digits(*vendor);
  const std::string number = four_digits(*model);
  return pci_name(root, maker, number).value_or("PCI " + maker + ":" + number);
}

std::string link_target(const SensorRoot& root, const std::string& link) {
  std::error_code error;
  const auto target = std::filesystem::canonical(root.resolve(link), error);
  return error ? std::string() : target.filename().string();
}

bool is_card(std::string_view name) {
  constexpr std::string_view kCard = "card";
  // "card0-HDMI-A-1" is a socket of it.
  return name.starts_with(kCard) && name.size() > kCard.size() &&
         name.find_first_not_of("0123456789", kCard.size()) == std::string_view::npos;
}

}  // namespace

std::vector<std::string> read_gpus(const SensorRoot& root) {
  constexpr std::string_view kCards = "/sys/class/drm";
  std::map<std::string, std::string> nvidia = nvidia_names(root);
  std::vector<std::string> gpus;
  for (const std::string& card : root.list(kCards)) {
    if (!is_card(card)) continue;
    const std::string device = std::string(kCards) + "/" + card + "/device";
    if (nvidia.contains(link_target(root, device))) continue;
    const std::string driver = link_target(root, device + "/driver");
    const std::string name = card_name(root, device);
    if (name.empty() && driver.empty()) continue;
    gpus.push_back(name.empty() ? driver : driver.empty() ? name : name + " (" + driver + ")");
  }
  for (const auto& [address, name] : nvidia) {
    gpus.push_back(name + " (" + nvidia_driver(root) + ")");
  }
  return gpus;
}

}  // namespace encore::energy
