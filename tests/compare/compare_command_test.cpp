// `encore compare` as a user meets it.
#include "tests/app/profile_json_check.h"
#include "tests/app/run_program.h"
#include "tests/compare/written_session.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

using test::contains;
using test::TemporaryFolder;

/// Two sessions: B is 20 % slower in the static test and the same in the build.
struct TwoSessions {
  TemporaryFolder folder;
  std::string a = write_session(folder.path() / "a", session_of({{}, {.test = "static"}}));
  std::string b =
      write_session(folder.path() / "b", session_of({{}, {.test = "static", .ms = 12.0}}));
};

TEST(CompareCommand, PrintsATableAndSucceedsWithoutATolerance) {
  const TwoSessions sessions;
  const ProgramResult result = run_encore({"compare", sessions.a, sessions.b});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "+20.0 % (+18.4 to +21.6)")) << result.out;
  EXPECT_TRUE(contains(result.out, "slower"));
  EXPECT_TRUE(contains(result.out, "no difference beyond noise"));
  EXPECT_EQ(result.err, "");
}

TEST(CompareCommand, ExitsWithSevenOnARegressionOnly) {
  const TwoSessions sessions;
  const auto code = [&](const std::string& a, const std::string& b, const std::string& tolerance) {
    return run_encore({"compare", a, b, "--tolerance", tolerance}).exit_code;
  };
  EXPECT_EQ(code(sessions.a, sessions.b, "5%"), 7);
  EXPECT_EQ(code(sessions.a, sessions.b, "25%"), 0);
  EXPECT_EQ(code(sessions.b, sessions.a, "5%"), 0);
  EXPECT_EQ(code(sessions.a, sessions.a, "1%"), 0);
}

TEST(CompareCommand, JsonGoesToStandardOutputAlone) {
  const TwoSessions sessions;
  const ProgramResult result =
      run_encore({"compare", sessions.a, sessions.b, "--json", "--tolerance", "5%"});
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_TRUE(JsonChecker(result.out).valid()) << result.out;
  EXPECT_TRUE(contains(result.out, "\"regressions\": 1"));
  EXPECT_EQ(result.err, "");
}

TEST(CompareCommand, WarnsOnStandardErrorUnlessQuiet) {
  const TwoSessions sessions;
  energy::SessionInfo other = written_info();
  other.machine.cpu_model = "another";
  const std::string c = write_session(sessions.folder.path() / "c", session_of({{}}, other));
  const ProgramResult loud = run_encore({"compare", sessions.a, c});
  EXPECT_EQ(loud.exit_code, 0);
  EXPECT_TRUE(contains(loud.err, "warning: processor: 'processor' in A, 'another' in B"));
  EXPECT_TRUE(contains(loud.out, "only in A: toys, bvh-median, static, rebuild, 256x256, cpu"));
  EXPECT_EQ(run_encore({"compare", sessions.a, c, "--quiet"}).err, "");
}

TEST(CompareCommand, SaysWhatIsNoSession) {
  const TwoSessions sessions;
  const std::string nowhere = sessions.folder.path() / "nowhere";
  const ProgramResult missing = run_encore({"compare", sessions.a, nowhere});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_TRUE(contains(missing.err, "nowhere")) << missing.err;
  EXPECT_TRUE(contains(missing.err, "name a session folder")) << missing.err;

  const std::string other =
      write_session(sessions.folder.path() / "d", session_of({{.structure = "grid-box"}}));
  const ProgramResult nothing = run_encore({"compare", sessions.a, other});
  EXPECT_EQ(nothing.exit_code, 3);
  EXPECT_TRUE(contains(nothing.err, "no configuration in common")) << nothing.err;
}

TEST(CompareCommand, WrongUsageIsTold) {
  const TwoSessions sessions;
  EXPECT_EQ(run_encore({"compare", sessions.a}).exit_code, 2);
  const ProgramResult result =
      run_encore({"compare", sessions.a, sessions.b, "--tolerance", "much"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "--tolerance")) << result.err;
}

}  // namespace
}  // namespace encore::app
