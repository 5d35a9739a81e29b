#include "app/device.h"

#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <vector>

namespace encore::app {

namespace {

constexpr Device kDevices[] = {Device::cpu, Device::gpu, Device::raster};

}  // namespace

std::string_view to_string(Device device) {
  switch (device) {
    case Device::cpu:
      return "cpu";
    case Device::gpu:
      return "gpu";
    case Device::raster:
      return "raster";
  }
  return "";
}

std::optional<Device> parse_device(std::string_view name) {
  for (const Device device : kDevices) {
    if (name == to_string(device)) return device;
  }
  return std::nullopt;
}

std::span<const Device> all_devices() {
  return kDevices;
}

std::string unknown_device(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Device device : kDevices) names.push_back(to_string(device));
  return fmt::format("unknown device '{}'{}; there are {}", name, scene::did_you_mean(name, names),
                     fmt::join(names, ", "));
}

bool uses_opengl(Device device) {
  return device != Device::cpu;
}

bool traces_rays(Device device) {
  return device != Device::raster;
}

}  // namespace encore::app
