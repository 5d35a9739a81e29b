#include "energy/machine_state.h"

#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace encore::energy {
namespace {

using test::TemporaryFolder;

SensorRoot fixture(const std::string& tree) {
  return SensorRoot(std::filesystem::path(ENCORE_FIXTURES) / "sysfs" / tree);
}

void write_cpu(const TemporaryFolder& root, int cpu, const std::string& file,
               const std::string& text) {
  root.write("sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/" + file, text + "\n");
}

TEST(MachineState, NothingIsKnownOfAnEmptyMachine) {
  const TemporaryFolder root;
  EXPECT_EQ(read_machine_state(SensorRoot(root.path())), MachineState());
}

TEST(MachineState, TheHottestCoreCounts) {
  const TemporaryFolder root;
  root.write("sys/class/hwmon/hwmon0/name", "nvme\n");
  root.write("sys/class/hwmon/hwmon0/temp1_input", "99000\n");
  root.write("sys/class/hwmon/hwmon5/name", "coretemp\n");
  root.write("sys/class/hwmon/hwmon5/temp1_label", "Package id 0\n");
  root.write("sys/class/hwmon/hwmon5/temp1_input", "61000\n");
  root.write("sys/class/hwmon/hwmon5/temp2_label", "Core 0\n");
  root.write("sys/class/hwmon/hwmon5/temp2_input", "63500\n");
  root.write("sys/class/hwmon/hwmon5/temp3_input", "255000\n");  // not connected
  root.write("sys/class/thermal/thermal_zone0/type", "x86_pkg_temp\n");
  root.write("sys/class/thermal/thermal_zone0/temp", "70000\n");
  EXPECT_EQ(read_cpu_temperature(SensorRoot(root.path())), 63.5)
      << "the processor's own sensor goes first";
}

TEST(MachineState, TheDieIsNotTheFansTemperature) {
  const TemporaryFolder root;
  root.write("sys/class/hwmon/hwmon2/name", "k10temp\n");
  root.write("sys/class/hwmon/hwmon2/temp1_label", "Tctl\n");
  root.write("sys/class/hwmon/hwmon2/temp1_input", "77000\n");
  EXPECT_EQ(read_cpu_temperature(SensorRoot(root.path())), 77.0) << "most have only this one";
  root.write("sys/class/hwmon/hwmon2/temp2_label", "Tdie\n");
  root.write("sys/class/hwmon/hwmon2/temp2_input", "50000\n");
  EXPECT_EQ(read_cpu_temperature(SensorRoot(root.path())), 50.0);
}

TEST(MachineState, ThermalZonesStandInForASensor) {
  const TemporaryFolder root;
  const auto zone = [&](int number, const char* type, const char* temperature) {
    const std::string folder = "sys/class/thermal/thermal_zone" + std::to_string(number);
    root.write(folder + "/type", std::string(type) + "\n");
    root.write(folder + "/temp", std::string(temperature) + "\n");
  };
  zone(0, "acpitz", "90000");
  EXPECT_FALSE(read_cpu_temperature(SensorRoot(root.path()))) << "that may be anything";
  zone(1, "x86_pkg_temp", "55000");
  zone(2, "cpu-big-thermal", "56000");
  EXPECT_EQ(read_cpu_temperature(SensorRoot(root.path())), 56.0);
}

TEST(MachineState, TheClockIsTheMeanOverTheCoresThatTell) {
  const TemporaryFolder root;
  write_cpu(root, 0, "cpufreq/scaling_cur_freq", "1000000");
  write_cpu(root, 1, "cpufreq/scaling_cur_freq", "3000000");
  write_cpu(root, 2, "online", "0");
  root.write("sys/devices/system/cpu/cpufreq/scaling_cur_freq", "9000000\n");
  EXPECT_EQ(read_machine_state(SensorRoot(root.path())).cpu_clock_mhz, 2000.0);
}

TEST(MachineState, ThrottlingIsCountedOnceACoreAndOnceAPackage) {
  const TemporaryFolder root;
  // Two packages of two cores with two threads each.
  for (int cpu = 0; cpu < 8; ++cpu) {
    write_cpu(root, cpu, "topology/physical_package_id", std::to_string(cpu / 4));
    write_cpu(root, cpu, "topology/core_id", std::to_string(cpu % 2));
    write_cpu(root, cpu, "thermal_throttle/core_throttle_count", std::to_string(1 + cpu % 2));
    write_cpu(root, cpu, "thermal_throttle/package_throttle_count", "10");
  }
  EXPECT_EQ(read_machine_state(SensorRoot(root.path())).throttle_events, 2U * (1 + 2) + 2U * 10);
}

TEST(MachineState, KnowsWhatFeedsIt) {
  EXPECT_EQ(read_machine_state(fixture("bat_power")).on_battery, true);
  EXPECT_EQ(read_machine_state(fixture("bat_ac_online")).on_battery, false);
  const TemporaryFolder root;
  root.write("sys/class/power_supply/ACAD/type", "Mains\n");
  root.write("sys/class/power_supply/ACAD/online", "1\n");
  EXPECT_EQ(read_machine_state(SensorRoot(root.path())).on_battery, false);

  const TemporaryFolder desktop;
  desktop.write("sys/class/power_supply/ucsi-source-psy-1/type", "USB\n");
  desktop.write("sys/class/power_supply/ucsi-source-psy-1/online", "0\n");
  desktop.write("sys/class/power_supply/mouse/type", "Battery\n");
  desktop.write("sys/class/power_supply/mouse/scope", "Device\n");
  EXPECT_FALSE(read_machine_state(SensorRoot(desktop.path())).on_battery)
      << "a socket that gives nothing and a mouse say nothing";
  desktop.write("sys/class/power_supply/BAT0/type", "Battery\n");
  EXPECT_EQ(read_machine_state(SensorRoot(desktop.path())).on_battery, true);

  const TemporaryFolder tablet;
  tablet.write("sys/class/power_supply/battery/type", "Battery\n");
  tablet.write("sys/class/power_supply/battery/status", "Charging\n");
  EXPECT_FALSE(read_machine_state(SensorRoot(tablet.path())).on_battery);
  tablet.write("sys/class/power_supply/battery/status", "Discharging\n");
  EXPECT_EQ(read_machine_state(SensorRoot(tablet.path())).on_battery, true);
}

TEST(MachineState, ReadsAnAwakeGpuAndLeavesASleepingOneAlone) {
  const MachineState awake = read_machine_state(fixture("hwmon_amdgpu_avg"));
  EXPECT_EQ(awake.gpu_temperature_c, 61.0) << "the edge, not the junction";
  EXPECT_EQ(awake.gpu_clock_mhz, 2105.0);
  const MachineState asleep = read_machine_state(fixture("pci_suspended"));
  EXPECT_FALSE(asleep.gpu_temperature_c);
  EXPECT_FALSE(asleep.gpu_clock_mhz);
}

TEST(MachineState, TakesAnIntelGpusClockFromItsCard) {
  const TemporaryFolder root;
  root.write("sys/bus/pci/devices/0000:03:00.0/vendor", "0x8086\n");
  root.write("sys/class/hwmon/hwmon1/name", "i915\n");
  root.write("sys/class/drm/card0-DP-1/status", "connected\n");
  root.write("sys/class/drm/card1/gt_act_freq_mhz", "2050\n");
  for (const char* link : {"sys/class/hwmon/hwmon1/device", "sys/class/drm/card1/device"}) {
    std::filesystem::create_directory_symlink("../../../bus/pci/devices/0000:03:00.0",
                                              root.path() / link);
  }
  const MachineState state = read_machine_state(SensorRoot(root.path()));
  EXPECT_EQ(state.gpu_clock_mhz, 2050.0);
  EXPECT_FALSE(state.gpu_temperature_c);
}

}  // namespace
}  // namespace encore::energy
