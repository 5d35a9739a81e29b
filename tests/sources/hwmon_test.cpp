#include "energy/sources/hwmon.h"

#include "energy/sources/timed_reader.h"
#include "tests/sources/fixture_tree.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <future>
#include <map>
#include <memory>

namespace encore::energy {
namespace {

/// A tree with chips of the test's own.
class ChipTree {
 public:
  using Values = std::map<std::string, std::string>;

  /// hwmonN with its name, files, and a device whose folder holds `device_files`.
  void add(int number, const std::string& name, const std::string& device, const Values& files,
           const Values& device_files = {}) {
    const std::string chip = "sys/class/hwmon/hwmon" + std::to_string(number);
    folder_.write(chip + "/name", name + "\n");
    for (const auto& [file, text] : files) folder_.write(chip + "/" + file, text + "\n");
    if (device.empty()) return;
    const std::string home = "sys/bus/pci/devices/" + device;
    folder_.write(home + "/uevent", "");
    for (const auto& [file, text] : device_files) folder_.write(home + "/" + file, text + "\n");
    std::filesystem::create_directory_symlink("../../../bus/pci/devices/" + device,
                                              folder_.path() / chip / "device");
  }
  void set(const std::string& file, const std::string& text) const {
    folder_.write(file, text + "\n");
  }
  void remove(const std::string& file) const { std::filesystem::remove_all(folder_.path() / file); }
  [[nodiscard]] SensorRoot root() const { return SensorRoot(folder_.path()); }

 private:
  test::TemporaryFolder folder_;
};

Finding only_finding(const SensorRoot& root) {
  std::vector<Finding> findings = find_hwmon(root);
  EXPECT_EQ(findings.size(), 1U);
  return findings.at(0);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

double first_watts(const Finding& finding) {
  EXPECT_FALSE(finding.obstacle) << finding.obstacle.value_or(Obstacle{}).reason;
  const ReadResult result = finding.open()->read(Seconds(1));
  EXPECT_EQ(result.state, ReadState::ok) << result.message;
  return result.reading.power.value_or(Watts(-1)).value;
}

TEST(Hwmon, AnAmdCardIsABoardAndItsOtherChipsAreLeftAlone) {
  const Finding finding = only_finding(fixture_root("hwmon_amdgpu_avg"));
  EXPECT_EQ(finding.info.name, "hwmon:amdgpu-0000:03:00.0");
  EXPECT_EQ(finding.info.domain, Domain::gpu);
  EXPECT_EQ(finding.info.unit, "0000:03:00.0");
  EXPECT_FALSE(finding.info.is_counter);
  EXPECT_TRUE(finding.set_aside.empty()) << finding.set_aside;
  EXPECT_TRUE(contains(finding.info.includes, "does not fall asleep"));
  EXPECT_DOUBLE_EQ(first_watts(finding), 151.0);
}

TEST(Hwmon, AnApuIsItsWholeSocket) {
  const Finding finding = only_finding(fixture_root("hwmon_amdgpu_input"));
  EXPECT_EQ(finding.info.domain, Domain::socket) << "it includes the processor";
  EXPECT_DOUBLE_EQ(first_watts(finding), 18.004);
}

TEST(Hwmon, TakesTheOtherFileOfACardWhereOneFails) {
  ChipTree tree;
  tree.add(0, "amdgpu", "0000:03:00.0",
           {{"power1_average", "1000000"}, {"power1_input", "2000000"}}, {{"gpu_metrics", ""}});
  EXPECT_DOUBLE_EQ(first_watts(only_finding(tree.root())), 1.0) << "the mean misses nothing";
  const SensorRoot root = tree.root();
  const SensorFiles files(root, [root](std::string_view path) -> FileText {
    if (path.ends_with("power1_average")) return {std::nullopt, EOPNOTSUPP};
    return root.read(path);
  });
  EXPECT_DOUBLE_EQ(first_watts(find_hwmon(files).at(0)), 2.0);
}

TEST(Hwmon, AllBitsSetMeansThatTheFirmwareDoesNotKnow) {
  ChipTree tree;
  tree.add(0, "amdgpu", "0000:03:00.0", {{"power1_input", "65535000"}}, {{"gpu_metrics", ""}});
  const auto source = only_finding(tree.root()).open();
  EXPECT_EQ(source->read(Seconds(1)).state, ReadState::failed);
  tree.set("sys/class/hwmon/hwmon0/power1_input", "255255000");
  EXPECT_EQ(source->read(Seconds(2)).reading.power, Watts(255.255)) << "possible for a card";
  tree.set("sys/class/hwmon/hwmon0/in1_input", "700");
  EXPECT_EQ(only_finding(tree.root()).open()->read(Seconds(3)).state, ReadState::failed)
      << "but not for an APU";
}

TEST(Hwmon, OldAmdCardsAreReadOnlyWhenNamed) {
  ChipTree tree;
  tree.add(0, "amdgpu", "0000:03:00.0", {{"power1_average", "35000000"}});
  const Finding finding = only_finding(tree.root());
  EXPECT_TRUE(contains(finding.set_aside, "hangs")) << finding.set_aside;
  EXPECT_DOUBLE_EQ(first_watts(finding), 35.0);
}

TEST(Hwmon, ASleepingGpuIsNeverAsked) {
  const SensorRoot root = fixture_root("pci_suspended");
  const auto asked = std::make_shared<bool>(false);
  const SensorFiles files(root, [root, asked](std::string_view path) {
    if (path.ends_with("power1_average")) *asked = true;
    return root.read(path);
  });
  const Finding finding = find_hwmon(files).at(0);
  ASSERT_TRUE(finding.obstacle);
  EXPECT_TRUE(contains(finding.obstacle->reason, "asleep")) << finding.obstacle->reason;
  EXPECT_FALSE(finding.obstacle->fix.empty());
  EXPECT_FALSE(finding.open);
  EXPECT_FALSE(*asked);
}

TEST(Hwmon, AGpuThatFallsAsleepIsAGap) {
  ChipTree tree;
  tree.add(0, "amdgpu", "0000:03:00.0", {{"power1_average", "10000000"}},
           {{"power/runtime_status", "active"}, {"gpu_metrics", ""}});
  const auto source = only_finding(tree.root()).open();
  const std::string status = "sys/bus/pci/devices/0000:03:00.0/power/runtime_status";
  source->read(Seconds(1));
  tree.set(status, "suspended");
  const ReadResult asleep = source->read(Seconds(2));
  EXPECT_EQ(asleep.state, ReadState::failed);
  EXPECT_TRUE(contains(asleep.message, "asleep"));
  tree.set(status, "active");
  const ReadResult awake = source->read(Seconds(3));
  EXPECT_EQ(awake.state, ReadState::restarted);
  EXPECT_EQ(awake.reading.energy, Joules(0));
}

TEST(Hwmon, XeCountsTheCardElseTheChipPackage) {
  const Finding package = only_finding(fixture_root("hwmon_xe_card0_pkg"));
  EXPECT_TRUE(contains(package.info.place, "energy2_input")) << "the card's counter stays at 0";
  EXPECT_TRUE(package.info.is_counter);
  EXPECT_EQ(package.open()->read(Seconds(1)).state, ReadState::ok) << "64 bits without a sign";

  ChipTree tree;
  tree.add(0, "xe", "0000:03:00.0", {{"energy1_input", "5000000"}, {"energy2_input", "3000000"}});
  EXPECT_TRUE(contains(only_finding(tree.root()).info.place, "energy1_input"));
}

TEST(Hwmon, ACounterCountsJoules) {
  ChipTree tree;
  tree.add(0, "i915", "0000:03:00.0", {{"energy1_input", "18446744073709000000"}});
  tree.add(1, "i915_gt0", "0000:03:00.0", {{"energy1_input", "1"}});
  const Finding finding = only_finding(tree.root());
  EXPECT_EQ(finding.info.name, "hwmon:i915-0000:03:00.0");
  EXPECT_EQ(finding.info.domain, Domain::gpu);
  const auto source = finding.open();
  const std::string file = "sys/class/hwmon/hwmon0/energy1_input";
  EXPECT_EQ(source->read(Seconds(1)).reading.energy, Joules(0));
  tree.set(file, "18446744073709500000");
  const ReadResult half = source->read(Seconds(2));
  EXPECT_EQ(half.reading.energy, Joules(0.5)) << "microjoules, exact beyond 2^53";
  EXPECT_FALSE(half.reading.power);
  EXPECT_FALSE(source->read(Seconds(3)).reading.changed);
}

TEST(Hwmon, ACounterThatFallsOrLeapsWasSetAnew) {
  ChipTree tree;
  tree.add(0, "i915", "0000:03:00.0", {{"energy1_input", "7000000"}});
  const auto source = only_finding(tree.root()).open();
  const std::string file = "sys/class/hwmon/hwmon0/energy1_input";
  const auto read = [&](double time, const char* value) {
    tree.set(file, value);
    return source->read(Seconds(time));
  };
  read(1, "7000000");
  EXPECT_EQ(read(2, "57000000").reading.energy, Joules(50));
  const ReadResult reset = read(3, "1000000");
  EXPECT_EQ(reset.state, ReadState::restarted);
  EXPECT_TRUE(contains(reset.message, "set anew")) << reset.message;
  EXPECT_EQ(reset.reading.energy, Joules(50)) << "never falls";
  EXPECT_EQ(read(4, "31000000").reading.energy, Joules(80));
  EXPECT_EQ(read(5, "99000000000").state, ReadState::restarted) << "99 kJ in a second";
  EXPECT_EQ(read(5.0001, "99020000000").reading.energy, Joules(100))
      << "a step right after another reading is none";
}

TEST(Hwmon, ACounterThatFailsLeavesAGap) {
  ChipTree tree;
  tree.add(0, "i915", "0000:03:00.0", {{"energy1_input", "1000000"}});
  const auto source = only_finding(tree.root()).open();
  const std::string file = "sys/class/hwmon/hwmon0/energy1_input";
  source->read(Seconds(1));
  tree.set(file, "oops");
  EXPECT_EQ(source->read(Seconds(2)).state, ReadState::failed);
  tree.set(file, "9000000");
  const ReadResult back = source->read(Seconds(3));
  EXPECT_EQ(back.state, ReadState::restarted);
  EXPECT_EQ(back.reading.energy, Joules(0));
  tree.remove("sys/class/hwmon/hwmon0");
  EXPECT_EQ(source->read(Seconds(4)).state, ReadState::lost);
}

TEST(Hwmon, AShuntIsReadButNotTakenByItself) {
  const Finding finding = only_finding(fixture_root("hwmon_ina226"));
  EXPECT_EQ(finding.info.name, "hwmon:ina226-1-0040");
  EXPECT_FALSE(finding.set_aside.empty()) << "nobody knows what it feeds";
  EXPECT_DOUBLE_EQ(first_watts(finding), 15.025);

  ChipTree tree;
  tree.add(0, "ina219", "1-0041",
           {{"in0_input", "7"}, {"in1_input", "12000"}, {"curr1_input", "1500"}});
  EXPECT_DOUBLE_EQ(first_watts(only_finding(tree.root())), 18.0) << "mV times mA, not the shunt's";
}

TEST(Hwmon, AnIna3221HasThreePairsAndNoMore) {
  ChipTree tree;
  ChipTree::Values files;
  for (int i = 1; i <= 7; ++i) {
    files["in" + std::to_string(i) + "_input"] = std::to_string(1000 * i);
    files["curr" + std::to_string(i) + "_input"] = "2000";
  }
  files["in2_label"] = "VDD_GPU";
  files["in3_enable"] = "0";
  tree.add(0, "ina3221", "1-0040", files);
  const auto findings = find_hwmon(tree.root());
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_DOUBLE_EQ(first_watts(findings[0]), 2.0);
  EXPECT_DOUBLE_EQ(first_watts(findings[1]), 4.0);
  EXPECT_TRUE(contains(findings[1].info.includes, "VDD_GPU"));
  EXPECT_NE(findings[0].info.unit, findings[1].info.unit);
  EXPECT_TRUE(findings[2].obstacle) << "switched off";
}

TEST(Hwmon, ASensorThatIsSwitchedOffSaysHowToSwitchItOn) {
  const Finding finding = only_finding(fixture_root("hwmon_disabled"));
  ASSERT_TRUE(finding.obstacle);
  EXPECT_TRUE(contains(finding.obstacle->reason, "power1_enable is 0"));
  EXPECT_EQ(finding.obstacle->fix, "echo 1 | sudo tee /sys/class/hwmon/hwmon5/power1_enable");
}

TEST(Hwmon, NoDataIsNotZero) {
  const SensorRoot root = fixture_root("hwmon_ina226");
  const auto error = std::make_shared<int>(0);
  const SensorFiles files(root, [root, error](std::string_view path) -> FileText {
    if (*error != 0 && path.ends_with("power1_input")) return {std::nullopt, *error};
    return root.read(path);
  });
  const auto source = find_hwmon(files).at(0).open();
  EXPECT_EQ(source->read(Seconds(1)).state, ReadState::ok);
  *error = ENODATA;
  const ReadResult nothing = source->read(Seconds(2));
  EXPECT_EQ(nothing.state, ReadState::failed);
  EXPECT_TRUE(contains(nothing.message, "no data")) << nothing.message;
  *error = 0;
  EXPECT_EQ(source->read(Seconds(3)).state, ReadState::restarted);
  *error = ENODEV;
  EXPECT_EQ(source->read(Seconds(4)).state, ReadState::lost);

  *error = ENODATA;
  EXPECT_TRUE(find_hwmon(files).at(0).obstacle) << "already when looking";
}

TEST(Hwmon, ServersAndPowerSuppliesAreTheWholeSystem) {
  ChipTree tree;
  tree.add(0, "corsairpsu", "0003:1B1C:1C0B.0005",
           {{"power1_input", "85000000"}, {"power2_input", "60000000"}});
  tree.add(1, "power_meter", "ACPI000D:00",
           {{"power1_average", "213000000"},
            {"power1_average_interval", "4000"},
            {"power1_accuracy", "97.0%"}});
  const auto findings = find_hwmon(tree.root());
  ASSERT_EQ(findings.size(), 2U);
  for (const Finding& finding : findings) EXPECT_EQ(finding.info.domain, Domain::system);
  EXPECT_DOUBLE_EQ(first_watts(findings[0]), 85.0) << "the total, without its rails";
  EXPECT_DOUBLE_EQ(first_watts(findings[1]), 213.0);
  EXPECT_EQ(findings[1].info.update_period, Seconds(4));
  EXPECT_NEAR(findings[1].info.gain_uncertainty, 0.03, 1e-12);
  EXPECT_LE(findings[1].info.poll_period, Seconds(2));
}

TEST(Hwmon, UnknownChipsAreNotGuessedAt) {
  ChipTree tree;
  tree.add(0, "nct6798", "0000:00:1f.0",
           {{"in1_input", "1000"}, {"curr1_input", "1000"}, {"power1_input", "1000000"}});
  const Finding finding = only_finding(tree.root());
  ASSERT_TRUE(finding.obstacle);
  EXPECT_TRUE(contains(finding.obstacle->reason, "nct6798")) << finding.obstacle->reason;
  EXPECT_FALSE(finding.open);
  EXPECT_TRUE(only_finding(ChipTree().root()).obstacle);
}

TEST(Hwmon, ANumberThatBecameAnotherChipIsNotRead) {
  ChipTree tree;
  tree.add(0, "corsairpsu", "", {{"power1_input", "85000000"}});
  const Finding finding = only_finding(tree.root());
  tree.set("sys/class/hwmon/hwmon0/name", "nvme");
  EXPECT_THROW(finding.open(), SensorError);
}

TEST(TimedReader, PassesAnswersOn) {
  const FileReader reader = timed_reader(
      [](std::string_view path) {
        return FileText{std::string(path) + "!", 0};
      },
      std::chrono::seconds(60));
  EXPECT_EQ(reader("a").text, "a!");
  EXPECT_EQ(reader("b").text, "b!");
}

TEST(TimedReader, GivesUpOnADriverThatHangs) {
  const auto release = std::make_shared<std::promise<void>>();
  const auto answered = std::make_shared<std::promise<void>>();
  const std::shared_future<void> gate = release->get_future().share();
  const FileReader reader = timed_reader(
      [gate, answered](std::string_view path) {
        if (path == "hangs") {
          gate.wait();
          answered->set_value();
        }
        return FileText{"7", 0};
      },
      std::chrono::milliseconds(20));
  EXPECT_EQ(reader("hangs").error, ETIMEDOUT);
  EXPECT_EQ(reader("other").error, ETIMEDOUT) << "no second read joins the queue";
  release->set_value();
  answered->get_future().wait();
}

}  // namespace
}  // namespace encore::energy
