#include "app/device.h"
#include "app/gpu_device.h"
#include "app/profile_run.h"
#include "energy/session_csv.h"
#include "scene/diagnostics.h"
#include "tests/app/profile_fakes.h"
#include "tests/app/profile_json_check.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <set>

namespace encore::app {
namespace {

using test::TemporaryFolder;

/// `encore profile --device …` over fakes.
class ProfileDeviceRun : public testing::Test {
 protected:
  ProfileDeviceRun() {
    options.quiet = true;
    options.measuring.seconds = 0.0;
    options.measuring.sources = {"none"};
    options.size = "16x8";
    options.scenes = {"toys"};
    options.structures = {"bvh-median"};
    options.policies = {"rebuild", "refit"};
    options.out = (folder.path() / "session").string();
  }
  ProfileResult run_it() {
    Terminal terminal(true);
    return run_profile(options, fakes.tools(), stop, terminal);
  }
  /// "device structure policy test" of each row.
  std::vector<std::string> measured() {
    std::vector<std::string> names;
    for (const auto& row : energy::read_session(options.out).summaries) {
      names.push_back(row.configuration[2].value + " " + row.configuration[3].value + " " +
                      row.configuration[4].value + " " + row.configuration[5].value);
    }
    return names;
  }

  TemporaryFolder folder;
  ProfileOptions options;
  FakeTools fakes;
  std::atomic<bool> stop{false};
};

TEST_F(ProfileDeviceRun, DevicesAreMeasuredOneAfterAnotherIntoOneSession) {
  options.devices = {"cpu", "gpu", "raster", "gpu"};
  const ProfileResult result = run_it();
  EXPECT_EQ(result.code, ExitCode::ok);
  EXPECT_EQ(measured(), (std::vector<std::string>{
                            "cpu bvh-median rebuild build", "cpu bvh-median refit build",
                            "cpu bvh-median static static", "cpu bvh-median rebuild dynamic",
                            "cpu bvh-median refit dynamic", "gpu bvh-median refit build",
                            "gpu bvh-median static static", "gpu bvh-median rebuild dynamic",
                            "gpu bvh-median refit dynamic", "raster none static static",
                            "raster none static dynamic"}));
  EXPECT_NE(result.output.find("GPU: fake board, software, runs on the CPU\n"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("derived"), std::string::npos);
  EXPECT_EQ(result.output.find("not derived"), std::string::npos) << "all tests are there";
  std::set<std::string> settings;
  for (const auto& setting : energy::read_session(options.out).info.settings) {
    settings.insert(setting.key + "=" + setting.value);
  }
  EXPECT_TRUE(settings.contains("gl_renderer=fake board, software, runs on the CPU"));
  EXPECT_TRUE(settings.contains("gl_version=4.5 fake"));
}

TEST_F(ProfileDeviceRun, OnARealGpuTheFastTreeIsBuiltThereAndElsewhereOnTheCpu) {
  options.devices = {"cpu", "gpu"};
  options.structures = {"bvh-sah", "bvh-median"};
  options.presets = {"fast", "balanced"};
  options.policies = {"rebuild", "refit"};
  Terminal terminal(true);
  const auto built_there = [&] {
    std::vector<std::string> names;
    for (const WorkloadSpec& spec : list_workloads(options, fakes.tools(), terminal)) {
      if (spec.build_on == accel::BuildPlace::device) names.push_back(workload_name(spec));
      for (const energy::KeyValue& value : configuration_of(spec, 0)) {
        if (value.key != "build_on") continue;
        const bool there = spec.build_on == accel::BuildPlace::device;
        EXPECT_EQ(value.value, spec.device == Device::cpu ? "" : there ? "device" : "cpu");
      }
    }
    return names;
  };
  const std::vector<std::string> fast{
      "toys, bvh-sah, gpu, build (rebuild), built on the device, fast",
      "toys, bvh-sah, gpu, dynamic (rebuild), 16x8, built on the device, fast"};
  EXPECT_TRUE(built_there().empty()) << "in software the CPU would do it anyway";
  EXPECT_EQ(fakes.opened, 1);
  fakes.software = false;
  EXPECT_EQ(built_there(), fast);
  options.build_on = "cpu";
  EXPECT_TRUE(built_there().empty());
  options.build_on = "device";
  fakes.software = true;
  EXPECT_EQ(built_there(), fast);
}

TEST_F(ProfileDeviceRun, WhatTheDeviceCannotBuildIsRefusedInOneLine) {
  options.devices = {"gpu"};
  options.build_on = "device";
  options.policies = {"rebuild"};
  options.tests = {"dynamic"};
  Terminal terminal(true);
  for (const char* structure : {"bvh-median", "grid-box", "bvh-sah"}) {
    options.structures = {structure};
    try {
      list_workloads(options, fakes.tools(), terminal);
      FAIL() << structure;
    } catch (const UsageError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(std::string(structure) +
                             " under policy rebuild cannot be built on the device; choose "
                             "--structure bvh-sah --preset fast --policy rebuild"),
                std::string::npos)
          << message;
    }
  }
  options.build_on = "moon";
  EXPECT_THROW(list_workloads(options, fakes.tools(), terminal), UsageError);
}

TEST_F(ProfileDeviceRun, RasterIsOneConfigurationATestWhateverTheStructures) {
  options.devices = {"raster"};
  options.structures = {"bvh-median", "grid-box", "kd-sah"};
  EXPECT_EQ(run_it().code, ExitCode::ok);
  EXPECT_EQ(measured(),
            (std::vector<std::string>{"raster none static static", "raster none static dynamic"}));
  EXPECT_EQ(fakes.counts.made, 0);
  for (const auto& setting : energy::read_session(options.out).info.settings) {
    EXPECT_NE(setting.key, "threads") << "nothing renders on the CPU";
  }
}

TEST_F(ProfileDeviceRun, ARunOnTheCpuOpensNoGraphicsDevice) {
  options.json = true;
  const std::string json = run_it().output;
  EXPECT_EQ(fakes.opened, 0);
  EXPECT_TRUE(JsonChecker(json).valid()) << json;
  EXPECT_NE(json.find("\"gpu\": null"), std::string::npos) << json;
  EXPECT_NE(json.find("\"transfers\": []"), std::string::npos) << json;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "session" / "transfer.csv"));
}

TEST_F(ProfileDeviceRun, WithoutOpenGlNothingIsMeasuredOrWritten) {
  fakes.opengl = false;
  options.devices = {"cpu", "gpu"};
  EXPECT_THROW(run_it(), renderer::gl::GlUnavailable);
  EXPECT_FALSE(std::filesystem::exists(options.out));
  EXPECT_EQ(fakes.counts.builds, 0);
}

TEST_F(ProfileDeviceRun, WhatFailsOnTheDeviceIsToldAndTheRestIsMeasured) {
  fakes.device.out_of_memory = true;
  options.devices = {"gpu", "cpu"};
  options.tests = {"static"};
  testing::internal::CaptureStderr();
  const ProfileResult result = run_it();
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_EQ(result.code, ExitCode::failure);
  EXPECT_NE(message.find("toys, bvh-median, gpu, static, 16x8 was not measured: the nodes do not"),
            std::string::npos)
      << message;
  EXPECT_EQ(measured(), std::vector<std::string>{"cpu bvh-median static static"});
}

TEST_F(ProfileDeviceRun, JsonAndTransferFileHoldTheTransfers) {
  options.devices = {"gpu"};
  options.tests = {"static", "dynamic"};
  options.json = true;
  const std::string json = run_it().output;
  EXPECT_TRUE(JsonChecker(json).valid()) << json;
  EXPECT_NE(json.find("\"transfer_bytes\": 1100"), std::string::npos) << "by the fake: " << json;
  EXPECT_NE(json.find("this session has no test build of device cpu"), std::string::npos) << json;
  const std::string file = test::contents_of(folder.path() / "session" / "transfer.csv");
  EXPECT_EQ(std::count(file.begin(), file.end(), '\n'), 3) << "a header and two policies:\n"
                                                           << file;
  EXPECT_NE(file.find("unavailable"), std::string::npos) << "no sensor: never 0";
}

TEST_F(ProfileDeviceRun, ASimulatedMachineDrawsSomethingWhileItTransfers) {
  // The thesis' constants, which are the usual ones, have none for transfer.
  options.devices = {"gpu"};
  options.tests = {"forced"};
  options.policies = {"rebuild"};
  options.measuring.sources = {"simulated:rapl"};
  options.measuring.seconds = 0.3;
  options.measuring.idle = 0.1;
  options.measuring.mix = 0.0;
  EXPECT_EQ(run_it().code, ExitCode::ok);
  const energy::Session session = energy::read_session(options.out);
  ASSERT_EQ(session.summaries.size(), 1U);
  EXPECT_GT(session.summaries[0].phase_counts[energy::Phase::build], 0U);
  EXPECT_TRUE(session.summaries[0].shares[energy::Phase::transfer]);
  ASSERT_TRUE(session.summaries[0].watts) << "the sensor did not stop";
  EXPECT_GT(session.summaries[0].watts->value, 19.0) << "more than idle";
}

TEST_F(ProfileDeviceRun, ASceneMayPreferADevice) {
  const std::string file =
      folder.write("s.toml", "[settings]\ndevice = \"raster\"\n[[model]]\ngenerator = \"box\"\n")
          .string();
  options.scenes = {file};
  EXPECT_EQ(run_it().code, ExitCode::ok);
  EXPECT_EQ(measured(), std::vector<std::string>{"raster none static static"});
  options.devices = {"cpu"};
  options.tests = {"static"};
  options.out += "-2";
  EXPECT_EQ(run_it().code, ExitCode::ok);
  EXPECT_EQ(measured(), std::vector<std::string>{"cpu bvh-median static static"})
      << "the command line goes first";

  folder.write("s.toml", "[settings]\ndevice = \"rooster\"\n[[model]]\ngenerator = \"box\"\n");
  options.devices.clear();
  options.out += "-3";
  try {
    run_it();
    FAIL();
  } catch (const scene::InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("s.toml:2:"), std::string::npos) << message;
    EXPECT_NE(message.find("unknown device 'rooster'"), std::string::npos) << message;
    EXPECT_NE(message.find("cpu, gpu, raster"), std::string::npos) << message;
  }
}

TEST(Device, NamesAreReadBack) {
  for (const Device device : all_devices()) EXPECT_EQ(parse_device(to_string(device)), device);
  EXPECT_FALSE(parse_device("GPU"));
  EXPECT_NE(unknown_device("rastr").find("raster'"), std::string::npos) << unknown_device("rastr");
}

class FakeContext final : public renderer::gl::Context {
 public:
  FakeContext() { capabilities_.renderer = "fake"; }
  void make_current() override { ++current; }
  int current = 0;
};

TEST(GpuContext, IsMadeOnceAndOnlyWhenAskedFor) {
  int made = 0;
  const auto gpu = std::make_shared<GpuContext>(3, [&](std::optional<int> device) {
    ++made;
    EXPECT_EQ(device, 3);
    return std::make_shared<FakeContext>();
  });
  const WorkloadTools tools = standard_tools(gpu);
  EXPECT_NE(tools.make_renderer(Device::cpu, 1), nullptr);
  EXPECT_FALSE(gpu->made());
  EXPECT_EQ(tools.open_gpu().name, "fake");
  EXPECT_TRUE(gpu->made());
  EXPECT_EQ(gpu->get(), gpu->get());
  EXPECT_EQ(made, 1);
  EXPECT_EQ(std::static_pointer_cast<FakeContext>(gpu->get())->current, 4) << "each time current";
}

}  // namespace
}  // namespace encore::app
