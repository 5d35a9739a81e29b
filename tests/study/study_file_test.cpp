#include "app/study_file.h"

#include "app/study_matrix.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace encore::app {
namespace {

std::string error_of(const std::string& text) {
  try {
    (void)parse_study(text, "s.toml");
  } catch (const scene::InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kGroup = "[[group]]\nname = \"a\"\nscenes = \"toys\"\n";

TEST(StudyFile, ReadsWhatItDescribes) {
  const Study study = parse_study(R"(name = "n"
source = ["rapl", "nvml:0"]
model = "idle=1,build=2"
search_path = "models"
[plan]
name = "thesis"
seconds = 30
until = "2%"
repeats = 4
order = "abba"
seed = 7
[[group]]
name = "g"
scenes = ["toys", "cow"]
structures = "grid-box"
policies = ["rebuild", "refit"]
tests = ["build", "forced"]
sizes = [128, "640x480"]
memory = ["malloc", "pool"]
update_cases = ["best"]
set = ["grid.cells_per_axis=16"]
threads = 2
)",
                                  "dir/s.toml");
  EXPECT_EQ(study.name, "n");
  EXPECT_EQ(study.measuring.plan, "thesis");
  EXPECT_EQ(study.measuring.seconds, 30.0);
  EXPECT_EQ(study.measuring.until, "2%");
  EXPECT_EQ(study.measuring.repeats, 4U);
  EXPECT_EQ(study.measuring.seed, 7U);
  EXPECT_EQ(study.measuring.sources, (std::vector<std::string>{"rapl", "nvml:0"}));
  EXPECT_EQ(study.search_path, std::vector<std::string>{"dir/models"});
  ASSERT_EQ(study.groups.size(), 1U);
  const StudyGroup& group = study.groups[0];
  EXPECT_EQ(group.sizes, (std::vector<std::string>{"128", "640x480"}));
  EXPECT_EQ(group.structures, std::vector<std::string>{"grid-box"});
  EXPECT_EQ(group.threads, 2);
}

TEST(StudyFile, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(error_of("name = \"x\"\n"), "s.toml: a study needs at least one [[group]]");
  EXPECT_TRUE(error_of(kGroup + "structures = [\"grid-box\", \"bvh-medan\"]\n")
                  .starts_with("s.toml:4:27: unknown structure 'bvh-medan'"))
      << error_of(kGroup + "structures = [\"grid-box\", \"bvh-medan\"]\n");
  EXPECT_TRUE(error_of(kGroup + "sizes = [0]\n").starts_with("s.toml:4:10: "));
  EXPECT_TRUE(error_of(kGroup + "sizes = []\n").starts_with("s.toml:4:9: "));
  EXPECT_TRUE(error_of(kGroup + "tests = [\"dynamics\"]\n").starts_with("s.toml:4:10: "));
  EXPECT_TRUE(error_of(kGroup + "policies = [1.5]\n").starts_with("s.toml:4:13: "));
  EXPECT_TRUE(error_of(kGroup + "set = [\"grid.cells=3\"]\n").starts_with("s.toml:4:8: "));
  EXPECT_TRUE(error_of(kGroup + "thread = 3\n").starts_with("s.toml:4:1: ")) << "unknown key";
  EXPECT_TRUE(error_of(kGroup + "threads = -1\n").starts_with("s.toml:4:11: "));
  EXPECT_TRUE(error_of("[[group]]\nname = \"a\"\n").starts_with("s.toml:1:1: "));
  EXPECT_TRUE(error_of("[plan]\nuntil = \"200%\"\n" + kGroup).starts_with("s.toml:2:9: "));
  EXPECT_TRUE(error_of("[plan]\nname = \"settled\"\n" + kGroup).starts_with("s.toml:2:8: "));
  EXPECT_TRUE(error_of("[plan]\nseconds = -1\n" + kGroup).starts_with("s.toml:2:11: "));
  EXPECT_TRUE(error_of("[plan]\nrepeats = 0\n" + kGroup).starts_with("s.toml:2:11: "));
  EXPECT_TRUE(error_of("[plan\n").starts_with("s.toml:1:"));
}

TEST(StudyFile, MayDescribeABattery) {
  EXPECT_EQ(error_of("[battery]\npreset = \"thesis-laptop\"\n" + kGroup), "no error");
  EXPECT_TRUE(error_of("[battery]\ncells = 3\n" + kGroup).starts_with("s.toml:2:"));
}

TEST(StudyFile, ADigestTellsVersionsApart) {
  const std::string text = kGroup;
  EXPECT_EQ(parse_study(text, "a").digest, parse_study(text, "b").digest);
  EXPECT_NE(parse_study(text, "a").digest, parse_study(text + "\n", "a").digest);
}

class ShippedStudy : public testing::TestWithParam<const char*> {};

TEST_P(ShippedStudy, CanBeSpelledOut) {
  Terminal terminal(true);
  Study study = read_study(std::string(ENCORE_SOURCE_DIR "/assets/studies/") + GetParam());
  // The large scenes take long to make and change nothing about the number of tests.
  const std::map<std::string, std::string> smaller{
      {"buddha", "mug"}, {"forest", "wheel"}, {"hall", "cow"}, {"dragon-fine", "car"}};
  for (StudyGroup& group : study.groups) {
    for (std::string& scene : group.scenes) {
      if (const auto found = smaller.find(scene); found != smaller.end()) scene = found->second;
    }
  }
  const StudyMatrix matrix = spell_out(study, standard_tools(), terminal);
  std::map<std::string, std::size_t> of_group;
  for (const WorkloadSpec& spec : matrix.tests) ++of_group[spec.group];
  for (const LeftOut& out : matrix.left_out) {
    of_group[out.group] += out.tests;
    EXPECT_NE(out.reason.find("OpenGL"), std::string::npos)
        << "nothing else is in the way: " << out.reason;
  }
  EXPECT_EQ(matrix.gpu.has_value(), matrix.left_out.empty());
  if (std::string(GetParam()) != "thesis.toml") {
    EXPECT_GT(matrix.tests.size(), 50U);
    return;
  }
  EXPECT_EQ(matrix.described(), 225U) << "thesis section 4.2";
  EXPECT_EQ(of_group["builds"] + of_group["updates"], 63U) << "Tables 4 and 5";
  EXPECT_EQ(of_group["memory"], 20U);
  EXPECT_EQ(of_group["combined, builds"] + of_group["combined, updates"], 12U);
  EXPECT_EQ(of_group["static, CPU"], 20U);
  EXPECT_EQ(of_group["dynamic, CPU, rebuild"] + of_group["dynamic, CPU, update"], 24U);
  EXPECT_EQ(of_group["static, GPU"] + of_group["dynamic, GPU, rebuild"] +
                of_group["dynamic, GPU, update"],
            44U);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedStudy, testing::Values("thesis.toml", "quick.toml"),
                         [](const auto& study) {
                           const std::string name = study.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace encore::app
