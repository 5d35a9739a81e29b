#include "energy/machine.h"

#include "tests/support/files.h"

#include <gtest/gtest.h>

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
