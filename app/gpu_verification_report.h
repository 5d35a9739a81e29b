#pragma once

#include "app/gpu_verification.h"
#include "renderer/image.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace encore::app {

/// The sums of all rows so far.
struct DeviceVerificationSums {
  std::uint64_t pixels = 0;
  std::uint64_t rays = 0;  ///< without the pixels'
  std::uint64_t differences = 0;
  std::uint64_t unexplained = 0;
  std::uint64_t failed_rows = 0;      ///< compared, and not passed()
  std::uint64_t uncompared_rows = 0;  ///< with a problem

  void add(const DeviceRow& row);
};

/// The table on standard output.
void print_device_header();
/// One line, and below it the first mismatch or the problem.
void print_device_row(const std::string& scene, const DeviceRow& row);
/// The last line.
void print_device_sums(const DeviceVerificationSums& sums, bool interrupted);

/// One JSON object; `device` by name.
std::string json_device_row(const std::string& scene, const std::string& device,
                            const DeviceRow& row);

/// Writes SCENE-STRUCTURE-cpu.png, -gpu.png and -difference.png into the folder (SCENE-STRUCTURE-
/// ACTION- after other actions than "build"). Throws std::runtime_error if it cannot.
void write_device_pictures(const std::filesystem::path& folder, const std::string& scene,
                           const DeviceRow& row, const renderer::Image& expected,
                           const renderer::Image& found, std::span<const std::uint8_t> differs);

}  // namespace encore::app
