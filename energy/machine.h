#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// The machine card: what a number depends on apart from the program. What cannot be read has no
/// value.
struct Machine {
  std::optional<std::string> cpu_model;
  std::optional<std::uint64_t> logical_cores;
  std::optional<std::uint64_t> physical_cores;
  std::optional<std::uint64_t> memory_bytes;
  std::optional<std::string> operating_system;
  std::optional<std::string> kernel;
  std::optional<std::string> governor;  ///< of the first core's clock frequency
  /// Whether a hypervisor runs below (the processor says so); unknown on processors that do not.
  std::optional<bool> virtual_machine;
  std::string compiler;
  std::string build_type;
  /// The state of the source that the program was built from, as the version control names it;
  /// nothing for a build outside of it.
  std::optional<std::string> build_id = std::nullopt;
  std::optional<std::string> microcode = std::nullopt;
  std::optional<double> cpu_min_mhz = std::nullopt;  ///< lowest of any core
  std::optional<double> cpu_max_mhz = std::nullopt;  ///< highest of any core, boost included
  /// Whether cores may exceed their nominal clock.
  std::optional<bool> boost = std::nullopt;
  std::optional<double> cpu_temperature_c = std::nullopt;  ///< when the card was read
  /// "mains" or "battery"; unknown where nothing tells, as on most desktops.
  std::optional<std::string> power_supply = std::nullopt;
  /// The container that the program runs in, "docker"; nothing if none was noticed.
  std::optional<std::string> container = std::nullopt;
  std::vector<std::string> gpus = {};  ///< "name (driver)" each; see read_gpus

  friend bool operator==(const Machine&, const Machine&) = default;
};

/// Reads the card from proc, sys and etc below `root` (a fixture tree in tests).
Machine read_machine(const std::filesystem::path& root = "/");

/// The command line of this program, words with special characters in quotes; empty if unknown.
std::string read_command_line(const std::filesystem::path& root = "/");

}  // namespace encore::energy
