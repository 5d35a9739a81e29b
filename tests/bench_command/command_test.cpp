// `encore bench` as a user meets it: every part in seconds, the same in CSV, clear refusals.
#include "tests/app/run_program.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace encore::app {
namespace {

using test::contains;

using CsvRow = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      result.emplace_back();
    } else {
      result.back() += c;
    }
  }
  return result;
}

std::vector<CsvRow> read_csv(const std::string& path) {
  std::istringstream text(test::contents_of(path));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = cells(line);
  std::vector<CsvRow> rows;
  while (std::getline(text, line)) {
    const std::vector<std::string> values = cells(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    CsvRow row;
    for (std::size_t i = 0; i < std::min(values.size(), names.size()); ++i) {
      row[names[i]] = values[i];
    }
    rows.push_back(row);
  }
  return rows;
}

class QuickRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    const std::string csv = (folder_->path() / "bench.csv").string();
    result_ = run_encore({"bench", "--quick", "mug", "--size", "64", "--threads", "1,2",
                          "--repeats", "2", "--csv", csv});
    rows_ = read_csv(csv);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::unique_ptr<test::TemporaryFolder> folder_;
  static ProgramResult result_;
  static std::vector<CsvRow> rows_;
};
std::unique_ptr<test::TemporaryFolder> QuickRun::folder_;
ProgramResult QuickRun::result_;
std::vector<CsvRow> QuickRun::rows_;

TEST_F(QuickRun, EndsWellAndNamesTheMachineAndEveryPart) {
  EXPECT_EQ(result_.exit_code, 0) << result_.err;
  EXPECT_TRUE(contains(result_.out, "Machine: ")) << result_.out;
  EXPECT_TRUE(contains(result_.out, "instruction set ")) << result_.out;
  for (const char* part : {"build", "refit", "trace", "scaling", "dynamic", "loading"}) {
    EXPECT_TRUE(contains(result_.out, std::string("\n") + part + ", ")) << part;
  }
}

TEST_F(QuickRun, EveryStructureIsBuiltTracedAndPlayedOnEveryNumberOfThreads) {
  std::set<std::string> built;
  std::set<std::string> traced;
  std::set<std::string> played;
  for (const CsvRow& row : rows_) {
    if (row.at("part") == "build") built.insert(row.at("ours") + '/' + row.at("threads"));
    if (row.at("part") == "trace") traced.insert(row.at("ours"));
    if (row.at("part") == "dynamic") played.insert(row.at("ours"));
  }
  for (const std::string name : {"grid-box", "grid-exact", "kd-median", "kd-sah", "bvh-median",
                                 "bvh-sah fast", "bvh-sah balanced", "bvh-sah best"}) {
    EXPECT_EQ(built.count(name + "/1"), 1U) << name;
    EXPECT_EQ(built.count(name + "/2"), 1U) << name;
    EXPECT_EQ(traced.count(name + " single moller-trumbore"), 1U) << name;
    EXPECT_EQ(traced.count(name + " tile moller-trumbore"), 1U) << name;
    EXPECT_EQ(played.count(name + ", rebuild"), 1U) << name;
  }
  EXPECT_EQ(traced.count("bvh-sah best tile precise"), 1U);
  EXPECT_EQ(traced.count("bvh-sah fast single watertight"), 1U);
  EXPECT_EQ(played.count("bvh-sah fast, refit"), 1U);
  EXPECT_EQ(played.count("bvh-median, auto"), 1U);
}

TEST_F(QuickRun, EveryRowHasAValueAndEveryPeerARatio) {
  ASSERT_GT(rows_.size(), 100U);
  int with_peer = 0;
  for (const CsvRow& row : rows_) {
    const std::string what = row.at("part") + ' ' + row.at("operation") + ' ' + row.at("ours");
    EXPECT_GT(std::stod(row.at("our_value")), 0.0) << what;
    EXPECT_GT(std::stoi(row.at("repeats")), 0) << what;
    if (row.at("peer").empty()) continue;
    ++with_peer;
    EXPECT_GT(std::stod(row.at("peer_value")), 0.0) << what;
    EXPECT_GT(std::stod(row.at("ratio_min")), 0.0) << what;
    EXPECT_LE(std::stod(row.at("ratio_min")), std::stod(row.at("ratio_median"))) << what;
    EXPECT_LE(std::stod(row.at("ratio_median")), std::stod(row.at("ratio_max"))) << what;
  }
  // What is loaded has a peer on every machine, the rest where Embree is.
  EXPECT_GE(with_peer,
            contains(result_.out, "Peer: Embree") ? static_cast<int>(rows_.size()) / 2 : 3);
}

TEST_F(QuickRun, OursAndThePeerSeeTheSameScene) {
  for (const CsvRow& row : rows_) {
    const std::string& note = row.at("note");
    if (row.at("part") != "trace" || row.at("peer").empty()) continue;
    ASSERT_TRUE(contains(note, "% differ")) << note;
    EXPECT_LT(std::stod(note), 1.0) << row.at("operation") << ' ' << row.at("ours") << ' ' << note;
  }
}

TEST_F(QuickRun, WithoutEmbreeItSaysSo) {
  if (contains(result_.out, "Peer: Embree")) {
    for (const char* peer : {"Embree LOW", "Embree MEDIUM", "Embree HIGH", "Embree REFIT"}) {
      EXPECT_TRUE(contains(result_.out, peer)) << peer;
    }
    return;
  }
  EXPECT_TRUE(contains(result_.out, "No Embree 3 here")) << result_.out;
  for (const CsvRow& row : rows_) {
    EXPECT_FALSE(contains(row.at("peer"), "Embree")) << row.at("peer");
  }
}

TEST(BenchCommand, WrongUsageExitsWithTwoAndSaysWhat) {
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const Case cases[] = {
      {{"bench", "--parts", "biuld"}, "did you mean 'build'"},
      {{"bench", "--structure", "bvh-shah"}, "did you mean 'bvh-sah'"},
      {{"bench", "--structure", "brute"}, "unknown structure 'brute'"},
      {{"bench", "--threads", "0"}, "--threads"},
      {{"bench", "--rays", "secondary"}, "secondary"},
      {{"bench", "--size", "100"}, "multiple of 32"},
      {{"bench", "--quick", "mug@3"}, "4, 16, 64"},
      {{"bench", "--quick", "mug@4x"}, "'4x'"},
      {{"bench", "--quick", "soup:0"}, "'0'"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run_encore(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << c.says << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, c.says)) << result.err;
  }
}

TEST(BenchCommand, BadInputExitsWithThreeAndAFileThatCannotBeWrittenWithOne) {
  const ProgramResult unknown = run_encore({"bench", "--quick", "muug"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_TRUE(contains(unknown.err, "muug")) << unknown.err;
  const ProgramResult csv = run_encore({"bench", "--quick", "--csv", "no/such/folder/bench.csv"});
  EXPECT_EQ(csv.exit_code, 1);
  EXPECT_TRUE(contains(csv.err, "no/such/folder/bench.csv")) << csv.err;
}

TEST(BenchCommand, ReadsTheFilesThatItIsGiven) {
  const test::TemporaryFolder folder;
  const std::string path = (folder.path() / "corner.obj").string();
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const ProgramResult result =
      run_encore({"bench", "--quick", "--parts", "loading", "--loading", path, "--size", "32"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "corner.obj, 1 triangles")) << result.out;
  EXPECT_TRUE(contains(result.out, "tinyobjloader")) << result.out;
  EXPECT_TRUE(contains(result.out, "to the first picture")) << result.out;
}

}  // namespace
}  // namespace encore::app
