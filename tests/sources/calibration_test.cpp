#include "energy/sources/calibration.h"

#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace encore::energy {
namespace {

std::string error_of(std::string_view text) {
  try {
    parse_calibration(text, "my.toml");
  } catch (const PowerModelError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

Calibration full() {
  Calibration calibration;
  calibration.model.idle = Watts(19.0);
  // Not representable in few digits: they must come back bit for bit.
  calibration.model.delta[Phase::build] = Watts(std::sqrt(213.0));
  calibration.model.delta[Phase::render] = Watts(46.8 / 3.0);
  calibration.model.delta[Phase::animate] = Watts(1e-7);
  calibration.model.gpu = Watts(21.2);
  calibration.model.uncertainty = 0.03;
  calibration.machine = "a \"quoted\" laptop\\n, 16 cores";
  calibration.measured_utc = "2026-01-31T12:00:00Z";
  calibration.method = "regression over 40 mixed blocks of battery:BAT0";
  return calibration;
}

TEST(Calibration, WhatIsWrittenComesBackBitForBit) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "laptop.toml";
  write_calibration(path, full());
  Calibration read = read_calibration(path);
  EXPECT_EQ(read.model.detail, "calibration " + path.string() +
                                   ", a \"quoted\" laptop\\n, 16 cores, 2026-01-31T12:00:00Z, "
                                   "regression over 40 mixed blocks of battery:BAT0");
  read.model.detail.clear();
  EXPECT_EQ(read, full());
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".new"));
}

TEST(Calibration, WhatIsUnknownStaysUnknown) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "laptop.toml";
  Calibration small;
  small.model.idle = Watts(5);
  small.model.delta[Phase::update] = Watts(0);
  write_calibration(path, small);
  const Calibration read = read_calibration(path);
  EXPECT_EQ(read.model.delta[Phase::update], Watts(0));
  EXPECT_FALSE(read.model.delta[Phase::build]);
  EXPECT_FALSE(read.model.gpu);
  EXPECT_FALSE(read.model.uncertainty);
}

TEST(Calibration, TheFileExplainsItsKeys) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "laptop.toml";
  write_calibration(path, full());
  const std::string text = test::contents_of(path);
  EXPECT_TRUE(text.starts_with("# Power calibration: what one machine draws, in watts (W).\n"));
  EXPECT_NE(text.find("idle_W = 19.0\n"), std::string::npos);
  EXPECT_NE(text.find("[above_idle]\n"), std::string::npos);
}

TEST(Calibration, MistakesAreNamedByPlace) {
  EXPECT_EQ(error_of("format = 1\nidle_W = \"12\"\n"),
            "my.toml:2:10: idle_W must be a number from 0 to 100000");
  EXPECT_EQ(error_of("format = 1\nidle_W = -12\n"),
            "my.toml:2:10: idle_W must be a number from 0 to 100000");
  EXPECT_EQ(error_of("format = 1\nidle_W = nan\n"),
            "my.toml:2:10: idle_W must be a number from 0 to 100000");
  EXPECT_EQ(error_of("format = 1\nidle_W = 5\nrelative_uncertainty = 3\n"),
            "my.toml:3:24: relative_uncertainty must be a number from 0 to 1");
  EXPECT_EQ(error_of("format = 1\nidle_W = 5\nmachine = 3\n"),
            "my.toml:3:11: machine must be a text in quotes");
  EXPECT_EQ(error_of("format = 1\nidle_W = 5\nabove_idle = 3\n"),
            "my.toml:3:14: above_idle must be a table: [above_idle]");
  EXPECT_EQ(
      error_of("format = 1\nidle_W = 5\n[above_idle]\nrender = 3\n"),
      "my.toml:4:1: unknown key 'render'; known are animate_W, build_W, update_W, transfer_W, "
      "render_W, gpu_W");
  EXPECT_EQ(error_of("format = 1\nidle = 5\n"),
            "my.toml:2:1: unknown key 'idle'; known are format, idle_W, relative_uncertainty, "
            "machine, measured_utc, method, above_idle");
  EXPECT_EQ(error_of("format = 2\n"),
            "my.toml:1:10: format must be 1: this version reads no other");
}

TEST(Calibration, WhatIsMissingIsNamed) {
  EXPECT_EQ(error_of(""), "my.toml: format = 1 is missing: is this a calibration file?");
  EXPECT_EQ(error_of("format = 1\n[above_idle]\nrender_W = 3\n"),
            "my.toml: idle_W is missing: the watts that the machine draws while nothing runs");
  EXPECT_EQ(error_of("format = 1\nidle_W = 3\n"),
            "my.toml: [above_idle] holds no power; add build_W, render_W or another phase");
}

TEST(Calibration, WhatIsNotTomlIsRefusedByPlace) {
  EXPECT_TRUE(error_of("format = 1\nidle_W = = 3\n").starts_with("my.toml:2:"));
  // Deep keys would cost the parser its stack; no calibration is so long.
  std::string deep = "a";
  for (int i = 0; i < 20000; ++i) deep += ".a";
  EXPECT_EQ(error_of(deep + " = 1\n"),
            "my.toml: larger than 16384 bytes: this is no calibration file");
  EXPECT_EQ(error_of(deep.substr(0, 8001) + " = 1\n"), "my.toml:1: a key of more than 16 parts");
}

TEST(Calibration, FilesThatCannotBeReadOrWrittenAreNamed) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder.path() / "none.toml").string();
  try {
    read_calibration(missing);
    FAIL();
  } catch (const PowerModelError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot read " + missing + ": No such file or directory");
  }
  try {
    read_calibration(folder.path());
    FAIL();
  } catch (const PowerModelError& error) {
    EXPECT_EQ(std::string(error.what()),
              "cannot read " + folder.path().string() + ": it is a folder");
  }
  const std::string nowhere = (folder.path() / "no" / "such.toml").string();
  try {
    write_calibration(nowhere, full());
    FAIL();
  } catch (const PowerModelError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot write " + nowhere + ": No such file or directory");
  }
}

}  // namespace
}  // namespace encore::energy
