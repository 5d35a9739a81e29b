// NVML against fakes of NVIDIA's library: the best way that works is taken, nothing sleeping is
// woken, nothing missing becomes 0.
#include "energy/sources/discovery.h"
#include "energy/sources/nvml_timing.h"
#include "tests/support/files.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace encore::energy {
namespace {

/// Sets the fakes' behaviour and puts the environment back.
class Nvml : public testing::Test {
 protected:
  ~Nvml() override {
    for (const std::string& name : set_) unsetenv(name.c_str());
  }
  void set(const std::string& name, const std::string& value) {
    setenv(("FAKE_NVML_" + name).c_str(), value.c_str(), 1);
    set_.push_back("FAKE_NVML_" + name);
  }
  void gpu(const std::string& id, const std::string& status,
           const std::string& driver = "nvidia") const {
    const std::string folder_name = "sys/bus/pci/devices/" + id;
    folder.write(folder_name + "/vendor", "0x10de\n");
    folder.write(folder_name + "/class", "0x030000\n");
    folder.write(folder_name + "/power/runtime_status", status + "\n");
    folder.write(folder_name + "/power/control", "auto\n");
    std::filesystem::create_symlink("../../../../bus/pci/drivers/" + driver,
                                    folder.path() / folder_name / "driver");
  }
  [[nodiscard]] std::vector<Finding> find(const std::string& library = ENCORE_FAKE_NVML) const {
    return find_nvml(SensorRoot(folder.path()), library);
  }
  /// What the fake counted.
  static int count(const char* function) {
    void* handle = dlopen(ENCORE_FAKE_NVML, RTLD_NOW);
    return reinterpret_cast<int (*)()>(dlsym(handle, function))();
  }

  test::TemporaryFolder folder;

 private:
  std::vector<std::string> set_;
};

TEST_F(Nvml, TheCounterIsTakenBeforeGauges) {
  gpu("0000:01:00.0", "active");
  const auto findings = find();
  ASSERT_EQ(findings.size(), 1U);
  const SourceInfo& info = findings[0].info;
  EXPECT_FALSE(findings[0].obstacle);
  EXPECT_EQ(findings[0].set_aside, "");
  EXPECT_EQ(info.name, "nvml:0");
  EXPECT_EQ(info.unit, "0000:01:00.0");
  EXPECT_EQ(info.domain, Domain::gpu);
  EXPECT_TRUE(info.is_counter);
  EXPECT_EQ(info.update_period, Seconds(0.1));
  EXPECT_NE(info.place.find("RTX 3090"), std::string::npos);
  EXPECT_NE(info.includes.find("keeps the GPU from sleeping"), std::string::npos);
}

TEST_F(Nvml, ACounterHeldFor100MsIsUnchangedUntilItSteps) {
  gpu("0000:01:00.0", "active");
  set("MILLISECONDS", "5000");
  const auto source = find()[0].open();
  ReadResult first = source->read(Seconds(10.0));
  EXPECT_EQ(first.state, ReadState::ok);
  EXPECT_EQ(first.reading.energy, Joules(0));
  EXPECT_FALSE(first.reading.power);
  set("MILLISECONDS", "5099");
  const ReadResult held = source->read(Seconds(10.099));
  EXPECT_EQ(held.state, ReadState::ok);
  EXPECT_FALSE(held.reading.changed);
  EXPECT_EQ(held.reading.energy, Joules(0));
  set("MILLISECONDS", "5100");
  const ReadResult stepped = source->read(Seconds(10.1));
  EXPECT_TRUE(stepped.reading.changed);
  EXPECT_DOUBLE_EQ(stepped.reading.energy.value, 10.0);  // 100 W for 0.1 s
}

TEST_F(Nvml, ACounterThatStandsStillFailsAndComesBackWithAGap) {
  gpu("0000:01:00.0", "active");
  const auto source = find()[0].open();
  source->read(Seconds(0));
  EXPECT_EQ(source->read(Seconds(2.9)).state, ReadState::ok);
  const ReadResult dead = source->read(Seconds(3.5));
  EXPECT_EQ(dead.state, ReadState::failed);
  EXPECT_NE(dead.message.find("stood still"), std::string::npos);
  set("MILLISECONDS", "2000");
  EXPECT_EQ(source->read(Seconds(4)).state, ReadState::restarted);
  set("MILLISECONDS", "2100");
  EXPECT_EQ(source->read(Seconds(4.1)).state, ReadState::ok);
}

TEST_F(Nvml, ACounterThatFallsBeginsANewStretch) {
  gpu("0000:01:00.0", "active");
  set("MILLISECONDS", "5000");
  const auto source = find()[0].open();
  source->read(Seconds(0));
  set("MILLISECONDS", "5100");
  source->read(Seconds(0.1));
  set("MILLISECONDS", "300");
  const ReadResult reset = source->read(Seconds(0.2));
  EXPECT_EQ(reset.state, ReadState::restarted);
  EXPECT_DOUBLE_EQ(reset.reading.energy.value, 10.0);
  EXPECT_NE(reset.message.find("reloaded"), std::string::npos);
  set("MILLISECONDS", "400");
  const ReadResult next = source->read(Seconds(0.3));
  EXPECT_EQ(next.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(next.reading.energy.value, 20.0);
}

TEST_F(Nvml, ABoardWithoutCounterIsReadByItsInstantField) {
  gpu("0000:01:00.0", "active");
  set("FAIL", "energy=3,usage=3");
  for (const char* type : {"0", "1", "3"}) {
    set("FIELD_TYPE", type);
    set("MILLIWATTS", "250000");
    const auto findings = find();
    ASSERT_FALSE(findings[0].obstacle) << type;
    EXPECT_FALSE(findings[0].info.is_counter);
    const auto source = findings[0].open();
    ReadResult reading = source->read(Seconds(1));
    ASSERT_EQ(reading.state, ReadState::ok);
    EXPECT_DOUBLE_EQ(reading.reading.power->value, 250.0);
    set("MILLIWATTS", "150000");
    reading = source->read(Seconds(2));
    EXPECT_DOUBLE_EQ(reading.reading.energy.value, 200.0);
  }
}

TEST_F(Nvml, AFieldThatSaysItHoldsNothingIsNotBelieved) {
  gpu("0000:01:00.0", "active");
  set("FAIL", "energy=3");
  set("MILLIWATTS", "70000");
  set("DRIVER", "550.1");
  const auto is_usage = [&] {
    return find()[0].info.includes.find("driver's power reading") != std::string::npos;
  };
  EXPECT_FALSE(is_usage());
  set("FIELD_RESULT", "3");  // the call succeeds, the value in it does not
  EXPECT_TRUE(is_usage());
  set("FIELD_RESULT", "0");
  set("FIELD_TYPE", "9");  // a type that nobody knows
  EXPECT_TRUE(is_usage());
}

TEST_F(Nvml, AnOldLibraryLacksFieldsAndCounterAndIsReadByUsage) {
  gpu("0000:01:00.0", "active");
  set("MILLIWATTS", "80000");
  const auto findings = find(ENCORE_FAKE_NVML_OLD);
  ASSERT_FALSE(findings[0].obstacle);
  EXPECT_FALSE(findings[0].info.is_counter);
  const auto source = findings[0].open();
  source->read(Seconds(0));
  EXPECT_DOUBLE_EQ(source->read(Seconds(0.5)).reading.energy.value, 40.0);
}

TEST_F(Nvml, ABoardThatMeasuresNothingIsUnavailableNotZero) {
  gpu("0000:01:00.0", "active");
  set("FAIL", "energy=3,fields=3,usage=3");
  auto findings = find();
  ASSERT_TRUE(findings[0].obstacle);
  EXPECT_NE(findings[0].obstacle->reason.find("does not report its power"), std::string::npos);
  EXPECT_FALSE(findings[0].open);
  EXPECT_EQ(findings[0].info.provenance.origin, Origin::unavailable);

  set("FAIL", "energy=3,fields=3");
  set("MILLIWATTS", "0");  // a success with 0 W
  EXPECT_TRUE(find()[0].obstacle);

  set("FAIL", "");
  set("MILLISECONDS", "0");  // a counter that never counted
  set("MILLIWATTS", "70000");
  EXPECT_FALSE(find()[0].info.is_counter);
}

TEST_F(Nvml, ErrorsComeWithTheWayOut) {
  gpu("0000:01:00.0", "active");
  const std::vector<std::pair<std::string, std::string>> cases{
      {"init=18", "reboot"},
      {"init=9", "modprobe nvidia"},
      {"energy=4,fields=4,usage=4", "/dev/nvidia"},
      {"energy=3,fields=3,usage=4", "/dev/nvidia"},  // permission tells more than "not supported"
      {"pci=15", "reboot"},
  };
  for (const auto& [fail, fix] : cases) {
    set("FAIL", fail);
    const auto findings = find();
    ASSERT_EQ(findings.size(), 1U);
    ASSERT_TRUE(findings[0].obstacle) << fail;
    EXPECT_NE(findings[0].obstacle->fix.find(fix), std::string::npos) << fail;
    EXPECT_EQ(findings[0].obstacle->reason.find('\n'), std::string::npos);
  }
}

TEST_F(Nvml, AGpuOfAnotherDriverIsNamedSo) {
  gpu("0000:01:00.0", "active", "nouveau");
  set("FAIL", "pci=6");
  const auto findings = find();
  ASSERT_TRUE(findings[0].obstacle);
  EXPECT_NE(findings[0].obstacle->reason.find("nouveau"), std::string::npos);
}

TEST_F(Nvml, ALostGpuIsLostAndABrieflySilentOneIsAGap) {
  gpu("0000:01:00.0", "active");
  for (const char* way : {"energy", "usage"}) {
    const bool gauge = std::string(way) == "usage";
    const std::string others = gauge ? "energy=3,fields=3," : "";
    set("FAIL", others);
    set("MILLISECONDS", "1000");
    const auto source = find()[0].open();
    ASSERT_EQ(source->info().is_counter, !gauge);
    ASSERT_EQ(source->read(Seconds(0)).state, ReadState::ok);
    set("FAIL", others + way + "=999");
    const ReadResult silent = source->read(Seconds(0.1));
    EXPECT_EQ(silent.state, ReadState::failed);
    EXPECT_NE(silent.message.find("0000:01:00.0"), std::string::npos);
    set("FAIL", others);
    set("MILLISECONDS", "1200");
    EXPECT_EQ(source->read(Seconds(0.2)).state, ReadState::restarted);
    set("FAIL", others + way + "=15");
    const ReadResult lost = source->read(Seconds(0.3));
    EXPECT_EQ(lost.state, ReadState::lost);
    EXPECT_NE(lost.message.find("fell off the bus"), std::string::npos);
  }
}

TEST_F(Nvml, NothingIsStartedWhileAGpuSleeps) {
  gpu("0000:01:00.0", "suspended");
  gpu("0000:02:00.0", "active");
  const int starts = count("fake_nvml_starts");
  const int touched = count("fake_nvml_devices_touched");
  const auto findings = find();
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_NE(findings[0].set_aside.find("sleeps"), std::string::npos);
  EXPECT_EQ(findings[1].set_aside, "");
  EXPECT_FALSE(findings[0].obstacle);
  EXPECT_EQ(count("fake_nvml_starts"), starts);
  EXPECT_EQ(count("fake_nvml_devices_touched"), touched);
  // A user who names it gets it.
  EXPECT_EQ(findings[0].open()->read(Seconds(0)).state, ReadState::ok);
  EXPECT_EQ(count("fake_nvml_starts"), starts + 1);
}

TEST_F(Nvml, IsStartedOnceForAllGpusAndEndsWithTheLast) {
  gpu("0000:01:00.0", "active");
  gpu("0000:02:00.0", "active");
  const auto findings = find();
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[1].info.name, "nvml:1");
  // Looking for them left nothing running.
  EXPECT_EQ(count("fake_nvml_starts"), count("fake_nvml_ends"));
  const int starts = count("fake_nvml_starts");
  auto first = findings[0].open();
  auto second = findings[1].open();
  EXPECT_EQ(count("fake_nvml_starts"), starts + 1);
  first.reset();
  EXPECT_EQ(count("fake_nvml_ends"), starts);
  EXPECT_EQ(second->read(Seconds(0)).state, ReadState::ok);
  second.reset();
  EXPECT_EQ(count("fake_nvml_ends"), starts + 1);
}

TEST_F(Nvml, OpeningAGpuThatWentAwayThrowsOneLine) {
  gpu("0000:01:00.0", "active");
  const auto findings = find();
  set("FAIL", "pci=6");
  try {
    findings[0].open();
    FAIL() << "opened";
  } catch (const SensorError& error) {
    EXPECT_NE(std::string(error.what()).find("0000:01:00.0"), std::string::npos);
  }
  EXPECT_EQ(count("fake_nvml_starts"), count("fake_nvml_ends"));
}

TEST_F(Nvml, WithoutPciDevicesTheLibrarysOwnListCounts) {
  set("COUNT", "2");
  const auto findings = find();
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].info.unit, "GPU-11111111");
  set("COUNT", "0");
  EXPECT_TRUE(find()[0].obstacle);
}

TEST_F(Nvml, AModuleAndASplitGpuAreDescribedAsSuch) {
  gpu("0000:01:00.0", "active");
  set("NAME", "NVIDIA GH200 480GB");
  const SourceInfo module = find()[0].info;
  EXPECT_EQ(module.domain, Domain::socket);
  EXPECT_NE(module.includes.find("whole module"), std::string::npos);
  set("NAME", "NVIDIA A100-SXM4-40GB");
  set("MIG", "1");
  EXPECT_NE(find()[0].info.includes.find("all MIG instances"), std::string::npos);
  set("FAIL", "energy=3,fields=3,usage=3");
  EXPECT_NE(find()[0].obstacle->reason.find("MIG"), std::string::npos);
}

TEST_F(Nvml, WhatTheSensorOverlooksIsSaidAndWidensTheGain) {
  gpu("0000:01:00.0", "active");
  set("FAIL", "energy=3");
  set("NAME", "NVIDIA H100 80GB HBM3");
  SourceInfo info = find()[0].info;
  EXPECT_NE(info.includes.find("75 % of the time goes unseen"), std::string::npos);
  EXPECT_EQ(info.gain_uncertainty, 0.1);
  EXPECT_EQ(info.smoothing, Seconds(0));
  set("FAIL", "energy=3,fields=3");
  info = find()[0].info;
  EXPECT_EQ(info.smoothing, Seconds(0.5));  // a mean over a second lags half of it
  EXPECT_EQ(info.gain_uncertainty, 0.05);
}

TEST_F(Nvml, NoLibraryIsOneFindingThatSaysSo) {
  const auto findings = find((folder.path() / "libnvidia-ml.so.1").string());
  ASSERT_EQ(findings.size(), 1U);
  ASSERT_TRUE(findings[0].obstacle);
  EXPECT_FALSE(findings[0].open);
  // A copied tree is not this machine: its GPUs are not asked here.
  ASSERT_TRUE(find("")[0].obstacle);
  EXPECT_NE(find("")[0].obstacle->reason.find("sensor root"), std::string::npos);
  // A file that is no such library.
  const auto text = folder.write("lib.so", "not a library");
  EXPECT_TRUE(find(text.string())[0].obstacle);
}

TEST(NvmlTiming, GenerationsAreKnownByTheirNames) {
  const std::vector<std::pair<std::string, NvidiaGeneration>> names{
      {"NVIDIA A100-SXM4-40GB", NvidiaGeneration::ga100},
      {"NVIDIA A30", NvidiaGeneration::ga100},
      {"NVIDIA RTX A3000 Laptop GPU", NvidiaGeneration::ampere},
      {"NVIDIA GeForce RTX 3090", NvidiaGeneration::ampere},
      {"NVIDIA A10", NvidiaGeneration::ampere},
      {"NVIDIA GeForce RTX 4070 Laptop GPU", NvidiaGeneration::ada},
      {"NVIDIA RTX 6000 Ada Generation", NvidiaGeneration::ada},
      {"NVIDIA L40S", NvidiaGeneration::ada},
      {"Quadro RTX 4000", NvidiaGeneration::turing},
      {"Tesla T4", NvidiaGeneration::turing},
      {"Tesla V100-SXM2-16GB", NvidiaGeneration::volta},
      {"NVIDIA GeForce GTX 1080 Ti", NvidiaGeneration::pascal},
      {"NVIDIA H200", NvidiaGeneration::hopper},
      {"NVIDIA GeForce RTX 5090", NvidiaGeneration::blackwell},
      {"Graphics Device", NvidiaGeneration::unknown},
  };
  for (const auto& [name, generation] : names) {
    EXPECT_EQ(generation_of(name), generation) << name;
  }
}

TEST(NvmlTiming, WindowsAreThoseThatWereMeasured) {
  const auto window = [](NvidiaGeneration generation, bool instant, int driver) {
    return gauge_timing(generation, instant, driver)->window.value;
  };
  EXPECT_DOUBLE_EQ(window(NvidiaGeneration::ada, false, 525), 1.0);
  EXPECT_DOUBLE_EQ(window(NvidiaGeneration::ada, false, 530), 0.1);
  EXPECT_DOUBLE_EQ(window(NvidiaGeneration::ada, false, 550), 1.0);
  EXPECT_DOUBLE_EQ(window(NvidiaGeneration::ampere, true, 550), 0.1);
  EXPECT_DOUBLE_EQ(window(NvidiaGeneration::ga100, false, 550), 0.025);
  EXPECT_DOUBLE_EQ(gauge_timing(NvidiaGeneration::volta, false, 550)->unseen(), 0.5);
  EXPECT_FALSE(gauge_timing(NvidiaGeneration::unknown, true, 550));
}

}  // namespace
}  // namespace encore::energy
