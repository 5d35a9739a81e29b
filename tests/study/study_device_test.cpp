#include "app/study_file.h"
#include "app/study_matrix.h"
#include "app/study_run.h"
#include "energy/session_csv.h"
#include "scene/diagnostics.h"
#include "tests/app/profile_fakes.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace encore::app {
namespace {

const std::string kStudy = R"(name = "devices"
source = "none"
[plan]
name = "quick"
seconds = 0
[[group]]
name = "frames"
device = ["cpu", "gpu", "raster"]
scenes = "triangle"
structures = ["bvh-median", "grid-box"]
tests = ["static", "forced"]
policies = "refit"
sizes = 16
[[group]]
name = "builds"
scenes = "triangle"
structures = ["bvh-median"]
tests = "build"
policies = "refit"
)";

std::map<std::string, int> by_device(const StudyMatrix& matrix) {
  std::map<std::string, int> counts;
  for (const WorkloadSpec& spec : matrix.tests) ++counts[std::string(to_string(spec.device))];
  return counts;
}

TEST(StudyDevices, AGroupMayHaveSeveral) {
  Terminal terminal(true);
  FakeTools fakes;
  const StudyMatrix matrix = spell_out(parse_study(kStudy, "s.toml"), fakes.tools(), terminal);
  // Two structures, still and forced; raster has neither structures nor forced frames.
  EXPECT_EQ(by_device(matrix),
            (std::map<std::string, int>{{"cpu", 4 + 1}, {"gpu", 4}, {"raster", 1}}));
  EXPECT_TRUE(matrix.gpu.has_value());
  EXPECT_EQ(fakes.opened, 1);
}

TEST(StudyDevices, WithoutOpenGlTheirTestsAreCountedAndLeftOut) {
  Terminal terminal(true);
  FakeTools fakes;
  fakes.opengl = false;
  const StudyMatrix matrix = spell_out(parse_study(kStudy, "s.toml"), fakes.tools(), terminal);
  EXPECT_EQ(by_device(matrix), (std::map<std::string, int>{{"cpu", 5}}));
  EXPECT_EQ(matrix.described(), 10U);
  ASSERT_EQ(matrix.left_out.size(), 1U);
  EXPECT_EQ(matrix.left_out[0].group, "frames");
  EXPECT_EQ(matrix.left_out[0].tests, 5U);
  EXPECT_EQ(matrix.left_out[0].reason, "there is no OpenGL here: nothing was found")
      << "in one line, for a table";
  EXPECT_FALSE(matrix.gpu.has_value());
  EXPECT_EQ(fakes.opened, 1) << "asked once";
}

TEST(StudyDevices, AStudyOfTheCpuOpensNoGraphicsDevice) {
  Terminal terminal(true);
  FakeTools fakes;
  spell_out(parse_study("[[group]]\nname = \"a\"\nscenes = \"triangle\"\n", "s.toml"),
            fakes.tools(), terminal);
  EXPECT_EQ(fakes.opened, 0);
}

TEST(StudyDevices, AnUnknownOneIsNamedWithItsPlace) {
  try {
    (void)parse_study("[[group]]\nname = \"a\"\nscenes = \"toys\"\ndevice = [\"cpu\", \"gpo\"]\n",
                      "s.toml");
    FAIL();
  } catch (const scene::InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("s.toml:4:18: unknown device 'gpo'")) << message;
    EXPECT_NE(message.find("cpu, gpu, raster"), std::string::npos) << message;
  }
}

TEST(StudyDevices, AreMeasuredIntoOneSessionAndAFailureSpoilsOnlyItsOwnTest) {
  const test::TemporaryFolder folder;
  Terminal terminal(true);
  FakeTools fakes;
  StudyOptions options;
  options.file = folder.write("s.toml", kStudy).string();
  options.out = (folder.path() / "session").string();
  const std::atomic<bool> stop{false};
  const auto run = [&] {
    return run_study(
        options, fakes.tools(), stop, [] { return true; }, terminal);
  };
  const StudyResult whole = run();
  EXPECT_EQ(whole.code, ExitCode::ok);
  EXPECT_NE(whole.output.find("GPU: fake board, software"), std::string::npos) << whole.output;
  const energy::Session session = energy::read_session(options.out);
  EXPECT_EQ(session.summaries.size(), 10U);
  const auto has_gpu = [](const auto& setting) { return setting.key == "gl_renderer"; };
  EXPECT_TRUE(std::any_of(session.info.settings.begin(), session.info.settings.end(), has_gpu));
  const std::string transfers = test::contents_of(folder.path() / "session" / "transfer.csv");
  EXPECT_EQ(std::count(transfers.begin(), transfers.end(), '\n'), 1 + 2) << transfers;

  // Gone on with, there is nothing left, and the file is that of the whole session.
  options.resume = options.out;
  EXPECT_EQ(run().code, ExitCode::ok);
  EXPECT_EQ(test::contents_of(folder.path() / "session" / "transfer.csv"), transfers);

  options.resume.clear();
  options.out += "-2";
  fakes.device.out_of_memory = true;
  testing::internal::CaptureStderr();
  const StudyResult rest = run();
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_EQ(rest.code, ExitCode::failure);
  EXPECT_NE(message.find("frames: triangle, bvh-median, gpu, static, 16x16 was not measured: "),
            std::string::npos)
      << message;
  EXPECT_EQ(energy::read_session(options.out).summaries.size(), 5U) << "all of the CPU's";
}

}  // namespace
}  // namespace encore::app
