#include "energy/machine.h"

#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

using test::TemporaryFolder;

/// A laptop of 2007: one package, two cores, no hypervisor, a governor.
void write_laptop(const TemporaryFolder& root) {
  root.write(
      "proc/cpuinfo",
      "processor\t: 0\nmodel name\t: Old Duo T7250 @ 2.00GHz\nphysical id\t: 0\ncore id\t\t: "
      "0\nflags\t\t: fpu vme sse sse2\n\nprocessor\t: 1\nmodel name\t: Old Duo T7250 @ "
      "2.00GHz\nphysical id\t: 0\ncore id\t\t: 1\nflags\t\t: fpu vme sse sse2\n");
  root.write("proc/meminfo", "MemTotal:        2048000 kB\nMemFree:          100000 kB\n");
  root.write("proc/sys/kernel/osrelease", "6.1.0-18-amd64\n");
  root.write("etc/os-release", "NAME=\"Some Linux\"\nPRETTY_NAME=\"Some Linux 12 (worm)\"\n");
  root.write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "ondemand\n");
}

TEST(MachineCard, HoldsWhatTheSystemSays) {
  const TemporaryFolder root;
  write_laptop(root);
  const Machine m = read_machine(root.path());
  EXPECT_EQ(m.cpu_model, "Old Duo T7250 @ 2.00GHz");
  EXPECT_EQ(m.logical_cores, 2U);
  EXPECT_EQ(m.physical_cores, 2U);
  EXPECT_EQ(m.memory_bytes, 2048000ULL * 1024);
  EXPECT_EQ(m.kernel, "6.1.0-18-amd64");
  EXPECT_EQ(m.operating_system, "Some Linux 12 (worm)");
  EXPECT_EQ(m.governor, "ondemand");
  EXPECT_EQ(m.virtual_machine, false);
  EXPECT_FALSE(m.compiler.empty());
  EXPECT_FALSE(m.build_type.empty());
}

TEST(MachineCard, KnowsAVirtualMachineByItsProcessorsFlag) {
  const TemporaryFolder root;
  root.write("proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu cx16 hypervisor lahf_lm\n");
  EXPECT_EQ(read_machine(root.path()).virtual_machine, true);
  const TemporaryFolder other;
  other.write("proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu hypervisor_like\n");
  EXPECT_EQ(read_machine(other.path()).virtual_machine, false);
}

TEST(MachineCard, CountsACoreOnceHoweverManyThreadsItRuns) {
  const TemporaryFolder root;
  std::string text;
  for (int cpu = 0; cpu < 8; ++cpu) {
    text += "processor\t: " + std::to_string(cpu) + "\nphysical id\t: " + std::to_string(cpu / 4) +
            "\ncore id\t: " + std::to_string(cpu % 2) + "\n\n";
  }
  root.write("proc/cpuinfo", text);
  const Machine m = read_machine(root.path());
  EXPECT_EQ(m.logical_cores, 8U);
  EXPECT_EQ(m.physical_cores, 4U);
}

TEST(MachineCard, WhatCannotBeReadIsMissingNotZero) {
  const TemporaryFolder root;
  const Machine m = read_machine(root.path());
  EXPECT_FALSE(m.cpu_model);
  EXPECT_FALSE(m.logical_cores);
  EXPECT_FALSE(m.physical_cores);
  EXPECT_FALSE(m.memory_bytes);
  EXPECT_FALSE(m.kernel);
  EXPECT_FALSE(m.governor);
  EXPECT_FALSE(m.virtual_machine) << "unknown is neither yes nor no";
  EXPECT_FALSE(m.microcode);
  EXPECT_FALSE(m.cpu_min_mhz);
  EXPECT_FALSE(m.cpu_max_mhz);
  EXPECT_FALSE(m.boost);
  EXPECT_FALSE(m.cpu_temperature_c);
  EXPECT_FALSE(m.power_supply);
  EXPECT_FALSE(m.container);
  EXPECT_TRUE(m.gpus.empty());
}

TEST(MachineCard, KnowsTheClocksOfAllCores) {
  const TemporaryFolder root;
  const std::string cpus = "sys/devices/system/cpu/";
  root.write(cpus + "cpu0/cpufreq/cpuinfo_min_freq", "800000\n");
  root.write(cpus + "cpu0/cpufreq/cpuinfo_max_freq", "5200000\n");
  root.write(cpus + "cpu9/cpufreq/cpuinfo_min_freq", "400000\n");
  root.write(cpus + "cpu9/cpufreq/cpuinfo_max_freq", "3900000\n");
  root.write(cpus + "intel_pstate/no_turbo", "1\n");
  root.write("proc/cpuinfo", "processor\t: 0\nmicrocode\t: 0x2c\n");
  const Machine m = read_machine(root.path());
  EXPECT_EQ(m.cpu_min_mhz, 400.0);
  EXPECT_EQ(m.cpu_max_mhz, 5200.0);
  EXPECT_EQ(m.boost, false);
  EXPECT_EQ(m.microcode, "0x2c");
  const TemporaryFolder other;
  other.write(cpus + "cpufreq/boost", "1\n");
  EXPECT_EQ(read_machine(other.path()).boost, true);
}

TEST(MachineCard, KnowsWhatFeedsTheMachineAndHowWarmItIs) {
  const TemporaryFolder root;
  root.write("sys/class/power_supply/AC/type", "Mains\n");
  root.write("sys/class/power_supply/AC/online", "1\n");
  root.write("sys/class/thermal/thermal_zone0/type", "x86_pkg_temp\n");
  root.write("sys/class/thermal/thermal_zone0/temp", "48500\n");
  const Machine m = read_machine(root.path());
  EXPECT_EQ(m.power_supply, "mains");
  EXPECT_EQ(m.cpu_temperature_c, 48.5);
  const std::filesystem::path fixtures(ENCORE_FIXTURES);
  EXPECT_EQ(read_machine(fixtures / "sysfs" / "bat_power").power_supply, "battery");
}

TEST(MachineCard, NoticesContainers) {
  const TemporaryFolder docker;
  docker.write(".dockerenv", "");
  EXPECT_EQ(read_machine(docker.path()).container, "docker");
  const TemporaryFolder kubernetes;
  kubernetes.write("proc/1/cgroup", "12:cpu:/kubepods/burstable/pod1\n");
  EXPECT_EQ(read_machine(kubernetes.path()).container, "kubepods");
  const TemporaryFolder plain;
  plain.write("proc/1/cgroup", "0::/init.scope\n");
  EXPECT_FALSE(read_machine(plain.path()).container);
}

/// A graphics card of the kernel's drm class with the files of its device.
void write_card(const TemporaryFolder& root, const std::string& card, const std::string& address,
                const std::string& driver) {
  const std::string device = "sys/bus/pci/devices/" + address;
  root.write("sys/bus/pci/drivers/" + driver + "/uevent", "");
  root.write("sys/class/drm/" + card + "/uevent", "");
  root.write(device + "/uevent", "");
  std::filesystem::create_directory_symlink("../../drivers/" + driver,
                                            root.path() / device / "driver");
  std::filesystem::create_directory_symlink("../../../../" + device,
                                            root.path() / "sys/class/drm" / card / "device");
}

TEST(MachineCard, NamesTheGraphicsCards) {
  const TemporaryFolder root;
  write_card(root, "card0", "0000:00:02.0", "i915");
  root.write("sys/bus/pci/devices/0000:00:02.0/vendor", "0x8086\n");
  root.write("sys/bus/pci/devices/0000:00:02.0/device", "0x9a49\n");
  write_card(root, "card1", "0000:03:00.0", "amdgpu");
  root.write("sys/bus/pci/devices/0000:03:00.0/product_name", "Radeon of Tests\n");
  write_card(root, "card2", "0000:65:00.0", "nvidia");
  root.write("sys/class/drm/card0-DP-1/status", "connected\n");
  root.write("sys/class/drm/renderD128/uevent", "");
  root.write("proc/driver/nvidia/gpus/0000:65:00.0/information",
             "Model: \t\t NVIDIA Test 9000\nIRQ:   \t\t 120\n");
  root.write("proc/driver/nvidia/version",
             "NVRM version: NVIDIA UNIX x86_64 Kernel Module  550.54.14  Thu Feb 22\n");
  const std::vector<std::string> unknown{"PCI 8086:9a49 (i915)", "Radeon of Tests (amdgpu)",
                                         "NVIDIA Test 9000 (nvidia 550.54.14)"};
  EXPECT_EQ(read_machine(root.path()).gpus, unknown);

  root.write("usr/share/misc/pci.ids",
             "# makers\n1002  Other Maker\n\t9a49  Not This\n8086  Some Maker\n\t9a40  Nor "
             "This\n\t9a49  Chip [Brand]\n\t\t1028 0001  Board\n");
  EXPECT_EQ(read_machine(root.path()).gpus.at(0), "Some Maker Chip [Brand] (i915)");
}

TEST(CommandLine, WordsWithSpecialCharactersAreQuoted) {
  const TemporaryFolder root;
  using namespace std::string_literals;
  root.write("proc/self/cmdline", "encore\0profile\0my scene.toml\0--set\0a=b\0it's\0\0"s);
  EXPECT_EQ(read_command_line(root.path()),
            "encore profile 'my scene.toml' --set a=b 'it'\\''s' ''");
  EXPECT_FALSE(read_command_line().empty()) << "this very program has one";
}

}  // namespace
}  // namespace encore::energy
