#include "app/doctor_opengl.h"

#include "app/json_text.h"
#include "app/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace encore::app {

namespace {

using renderer::gl::DeviceListing;

void add_line(std::string& text, std::string_view name, std::string_view value) {
  if (!value.empty()) text += fmt::format("  {:<14} {}\n", name, value);
}

std::string device_text(const DeviceListing& device) {
  std::string text = fmt::format("OpenGL device {}  {}{}: {}\n", device.index, device.name,
                                 device.software ? ", software, runs on the CPU" : "",
                                 device.usable ? "usable" : "not usable");
  add_line(text, "version", device.version);
  if (device.storage_block_bytes > 0) {
    add_line(text, "largest buffer", bytes_text(device.storage_block_bytes));
  }
  if (!device.version.empty()) {
    add_line(text, "clock",
             device.timestamp_bits > 0 ? "yes: frames are timed on the device"
                                       : "none: frames are timed from outside alone");
  }
  add_line(text, "in the way", device.problem);
  return text;
}

std::string device_json(const DeviceListing& device) {
  return fmt::format(
      "{{\"index\": {}, \"name\": {}, \"version\": {}, \"software\": {}, \"usable\": {}, "
      "\"largest_storage_buffer_bytes\": {}, \"timestamp_clock\": {}, \"problem\": {}}}",
      device.index, json_text(device.name), json_text(device.version), device.software,
      device.usable,
      device.storage_block_bytes > 0 ? fmt::format("{}", device.storage_block_bytes) : "null",
      device.version.empty()      ? "null"
      : device.timestamp_bits > 0 ? "true"
                                  : "false",
      json_text(device.problem));
}

}  // namespace

bool OpenGlReport::any_usable() const {
  return std::any_of(devices.begin(), devices.end(),
                     [](const DeviceListing& device) { return device.usable; });
}

OpenGlReport examine_opengl() {
  OpenGlReport report;
  report.devices = renderer::gl::list_devices(&report.problem);
  return report;
}

std::string opengl_text(const OpenGlReport& report) {
  std::string text;
  for (const DeviceListing& device : report.devices) text += device_text(device);
  if (report.any_usable()) return text;
  const std::string reason =
      report.problem.empty()
          ? "install or update the GPU's driver, or libegl-mesa0 and libgl1-mesa-dri (Debian, "
            "Ubuntu) for OpenGL in software"
          : report.problem;
  return text + fmt::format(
                    "{:<16} no usable device, so that only the CPU can trace "
                    "(--device cpu): {}\n",
                    "OpenGL", reason);
}

std::string opengl_json(const OpenGlReport& report) {
  std::string devices;
  for (const DeviceListing& device : report.devices) {
    devices += (devices.empty() ? "\n  " : ",\n  ") + device_json(device);
  }
  return fmt::format("{{\"usable\": {}, \"problem\": {}, \"devices\": [{}]}}", report.any_usable(),
                     json_text(report.problem), devices);
}

}  // namespace encore::app
