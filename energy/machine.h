#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

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

  friend bool operator==(const Machine&, const Machine&) = default;
};

/// Reads the card from proc, sys and etc below `root` (a fixture tree in tests).
Machine read_machine(const std::filesystem::path& root = "/");

/// The command line of this program, words with special characters in quotes; empty if unknown.
std::string read_command_line(const std::filesystem::path& root = "/");

}  // namespace encore::energy
