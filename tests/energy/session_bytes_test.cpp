// A session folder whose bytes were changed is refused with the place; nothing odd gets through.
#include "energy/session_csv.h"
#include "energy/session_toml.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::energy {
namespace {

class SessionBytes : public testing::Test {
 protected:
  void SetUp() override {
    SessionInfo info;
    info.program = "encore";
    SessionWriter writer(folder.path(), info, {{"scene"}, {}});
    WindowRow window;
    window.configuration = {{"scene", "toys"}};
    window.kind = "idle";
    window.from = Seconds(1.5);
    window.to = Seconds(2.5);
    writer.add(window);
    writer.finish(SessionState::complete);
    ASSERT_EQ(message(), "read");
  }
  [[nodiscard]] std::string message() const {
    try {
      (void)read_session(folder.path());
    } catch (const SessionError& error) {
      return error.what();
    }
    return "read";
  }
  /// What is said with `from` replaced in a file.
  [[nodiscard]] std::string message_with(const std::string& file, const std::string& from,
                                         const std::string& to) const {
    const std::string good = test::contents_of(folder.path() / file);
    const std::size_t at = good.find(from);
    if (at == std::string::npos) return file + " holds no '" + from + "'";
    folder.write(file, std::string(good).replace(at, from.size(), to));
    std::string said = message();
    folder.write(file, good);
    return said.starts_with(folder.path().string()) ? said.substr(folder.path().string().size() + 1)
                                                    : said;
  }
  test::TemporaryFolder folder;
};

TEST_F(SessionBytes, NumbersAreFinite) {
  for (const std::string odd : {"nan", "inf", "-inf"}) {
    EXPECT_EQ(message_with("session.toml", "cool_down_s = 0.0", "cool_down_s = " + odd),
              "session.toml: plan.cool_down_s has a wrong value");
    EXPECT_EQ(message_with("windows.csv", "idle,1.5", "idle," + odd),
              "windows.csv, row 1: column from_s holds '" + odd + "', not a number");
  }
}

TEST_F(SessionBytes, CountsFitTheirType) {
  EXPECT_EQ(message_with("session.toml", "repeats = 1", "repeats = 4294967297"),
            "session.toml: plan.repeats has a wrong value");
}

TEST_F(SessionBytes, SeedsKeepAllTheirBits) {
  SessionInfo info = read_session(folder.path()).info;
  info.plan.order_seed = 0xffffffffffffffff;
  info.plan.mix_seed = 0x8000000000000001;
  write_session_toml(folder.path() / "session.toml", info);
  EXPECT_EQ(read_session(folder.path()).info, info);
}

TEST_F(SessionBytes, DeepKeysAreRefusedBeforeTheParserSeesThem) {
  std::string deep = "a";
  for (int i = 0; i < 200000; ++i) deep += ".a";
  folder.write("session.toml", deep + " = 1\n");
  EXPECT_EQ(message(),
            (folder.path() / "session.toml").string() + ":1: a key of more than 16 parts");
}

TEST_F(SessionBytes, LongColumnNamesAreNotRepeatedInEveryRow) {
  EXPECT_EQ(message_with("windows.csv", "scene", std::string(257, 's')),
            "windows.csv: a column's name is longer than 256 characters");
}

}  // namespace
}  // namespace encore::energy
