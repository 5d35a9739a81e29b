// External meters: parsers on recorded streams, and whole meters at the other end of a pseudo
// terminal.
#include "energy/sources/meter.h"

#include "energy/sources/discovery.h"
#include "energy/sources/meter_scpi.h"
#include "energy/sources/meter_um25c.h"
#include "tests/sources/pseudo_meter.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

const std::filesystem::path kFixtures = std::filesystem::path(ENCORE_FIXTURES) / "meters";

Bytes stream(const std::string& name) {
  const std::string text = test::contents_of(kFixtures / name);
  return {text.begin(), text.end()};
}

/// Feeds a stream in pieces of `size` bytes; the time of each is its number.
std::vector<MeterSample> feed(MeterProtocol& protocol, const Bytes& bytes, std::size_t size) {
  std::vector<MeterSample> all;
  double time = 0;
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    const auto piece = std::span(bytes).subspan(at, std::min(size, bytes.size() - at));
    for (const MeterSample& sample : protocol.take(piece, Seconds(time))) all.push_back(sample);
    time += 1;
  }
  return all;
}

TEST(Um25c, FindsTheGoodFramesOfABrokenStreamInWhateverPieces) {
  // The tail of a frame, two frames, a broken off one, a good one, one with a destroyed end, false
  // beginnings, two good ones with foreign bytes between, half a frame.
  const Bytes bytes = stream("um25c_stream.bin");
  ASSERT_EQ(bytes.size(), 918U);
  for (const std::size_t size : {1UL, 7UL, 64UL, 130UL, 918UL}) {
    Um25cProtocol meter;
    const auto samples = feed(meter, bytes, size);
    ASSERT_EQ(samples.size(), 5U) << size;
    const double volts[] = {19.982, 19.979, 19.731, 19.728, 19.984};
    const double amps[] = {0.9131, 0.9204, 2.7655, 2.7701, 0.9099};
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_DOUBLE_EQ(*samples[i].volts, volts[i]);
      EXPECT_DOUBLE_EQ(*samples[i].amps, amps[i]);
      EXPECT_DOUBLE_EQ(samples[i].energy->value, (4166.0 + static_cast<double>(i)) * 3.6);
      EXPECT_FALSE(samples[i].power);
    }
    // All but the 5 frames and the half one at the end.
    EXPECT_EQ(meter.skipped(), 918U - 5U * 130U - 31U);
  }
}

TEST(Um25c, ItsSistersHaveADigitLess) {
  Um25cProtocol um24c;
  const auto samples = feed(um24c, stream("um24c_frame.bin"), 130);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_DOUBLE_EQ(*samples[0].volts, 5.12);
  EXPECT_DOUBLE_EQ(*samples[0].amps, 1.043);
  EXPECT_EQ(um24c.facts().name, "um24c");
}

TEST(Um25c, TheUm34cHasACheckByte) {
  // The second of four frames has one bit wrong.
  Um25cProtocol um34c;
  const auto samples = feed(um34c, stream("um34c_stream.bin"), 33);
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_DOUBLE_EQ(*samples[0].amps, 1.337);
  EXPECT_DOUBLE_EQ(*samples[1].amps, 1.338);
  EXPECT_DOUBLE_EQ(*samples[2].amps, 1.339);
  EXPECT_EQ(um34c.skipped(), 130U);
  EXPECT_EQ(um34c.facts().name, "um34c");
}

TEST(Um25c, EndlessNoiseNeitherGrowsNorStops) {
  Um25cProtocol meter;
  const Bytes noise(100000, 0x09);
  EXPECT_TRUE(meter.take(noise, Seconds(0)).empty());
  EXPECT_GE(meter.skipped(), noise.size() - 1);
  EXPECT_EQ(meter.take(stream("um24c_frame.bin"), Seconds(1)).size(), 1U);
}

TEST(Scpi, NumbersAreUnderstoodAsMetersWriteThem) {
  EXPECT_DOUBLE_EQ(*parse_scpi_number("+1.52345600E+00"), 1.523456);
  EXPECT_DOUBLE_EQ(*parse_scpi_number("  -2.5E-3,ADC\r"), -0.0025);
  EXPECT_DOUBLE_EQ(*parse_scpi_number("0.75 A"), 0.75);
  EXPECT_DOUBLE_EQ(*parse_scpi_number("12"), 12);
  EXPECT_DOUBLE_EQ(*parse_scpi_number("9.9E37"), 9.9e37);
  for (const char* text : {"", "OVLD", "+", "+-1", "1.2.3", "nan", "inf", "A 1.5"}) {
    EXPECT_FALSE(parse_scpi_number(text)) << text;
  }
}

TEST(Scpi, AStreamOfAnswersGivesAmperesTimesTheUsersVolts) {
  for (const std::size_t size : {1UL, 5UL, 1000UL}) {
    MeterSettings settings;
    settings.volts = 20.0;
    ScpiProtocol meter(settings);
    const auto samples = feed(meter, stream("scpi_answers.txt"), size);
    // The end of a line before the recording ("41E-01") cannot be told from a number; an overload
    // is a sample without value, words are none, and the line without an end is not yet one.
    ASSERT_EQ(samples.size(), 6U);
    EXPECT_DOUBLE_EQ(*samples[0].amps, 4.1);
    EXPECT_DOUBLE_EQ(*samples[1].amps, 1.523456);
    EXPECT_DOUBLE_EQ(*samples[1].volts, 20.0);
    EXPECT_FALSE(samples[3].amps);
    EXPECT_FALSE(samples[3].power);
    EXPECT_DOUBLE_EQ(*samples[4].amps, 1.7);
    EXPECT_DOUBLE_EQ(*samples[5].amps, -0.0025);
  }
}

TEST(Scpi, SaysWhatItUnderstoodButCannotUse) {
  ScpiProtocol meter({});
  const auto say = [&](const std::string& text) {
    return meter.take(Bytes(text.begin(), text.end()), Seconds(0));
  };
  EXPECT_FALSE(say("9.9E37\n")[0].power);
  EXPECT_NE(meter.complaint().find("overload"), std::string::npos);
  EXPECT_TRUE(say("ERR 5\n").empty());
  EXPECT_NE(meter.complaint().find("'ERR 5'"), std::string::npos);
  EXPECT_EQ(say("3.5\n")[0].power, Watts(3.5));
  EXPECT_EQ(meter.complaint(), "");
  EXPECT_TRUE(say(std::string(2000, '1')).empty());
  EXPECT_EQ(say("\n4\n").size(), 1U);
}

TEST(Scpi, TheUsersConstantMustMakeSense) {
  MeterSettings settings;
  settings.volts = 5;
  settings.amps = 1;
  EXPECT_THROW(ScpiProtocol{settings}, SensorError);
  settings.amps.reset();
  settings.volts = -5;
  EXPECT_THROW(ScpiProtocol{settings}, SensorError);
  settings.volts = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ScpiProtocol{settings}, SensorError);
}

std::string message_of(const MeterSettings& settings) {
  try {
    open_meter(settings);
  } catch (const SensorError& error) {
    return error.what();
  }
  return "opened";
}

/// Tests at a pseudo terminal; a chroot or a bare container may have none.
class SerialMeter : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_pseudo_terminals()) GTEST_SKIP() << "no pseudo terminals: /dev/pts is missing";
  }
};

TEST_F(SerialMeter, AnUm25cIsReadFromEndToEnd) {
  const Bytes frames = stream("um25c_stream.bin");
  const auto frame = [&](std::size_t at) {
    return std::string(frames.begin() + static_cast<std::ptrdiff_t>(at),
                       frames.begin() + static_cast<std::ptrdiff_t>(at + 130));
  };
  // The first answer comes in two pieces behind a stray byte; a low frame, then high ones.
  int answers = 0;
  test::PseudoMeter meter([&](const std::string& asked) -> std::vector<std::string> {
    EXPECT_EQ(asked, "\xf0");
    if (++answers > 1) return {frame(44 + 260 + 57)};
    return {"\x4e", frame(44).substr(0, 60), frame(44).substr(60)};
  });
  MeterSettings settings;
  settings.device = meter.device();
  const auto source = open_meter(settings);
  EXPECT_EQ(source->info().name, "meter:um25c");
  EXPECT_EQ(source->info().kind, SourceKind::meter);
  EXPECT_EQ(source->info().domain, Domain::system);
  EXPECT_FALSE(source->info().is_counter);
  EXPECT_NE(source->info().place.find(meter.device()), std::string::npos);

  const ReadResult first = source->read(Seconds(100));
  ASSERT_EQ(first.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(first.reading.power->value, 19.982 * 0.9131);
  EXPECT_EQ(first.reading.energy, Joules(0));
  meter.wait_for_answers(2);
  const ReadResult second = source->read(Seconds(101));
  ASSERT_EQ(second.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(second.reading.power->value, 19.731 * 2.7655);
  EXPECT_DOUBLE_EQ(second.reading.energy.value, (19.982 * 0.9131 + 19.731 * 2.7655) / 2);
}

TEST_F(SerialMeter, ASilentOneIsAGapAndAVanishedOneIsLost) {
  const std::string frame = test::contents_of(kFixtures / "um24c_frame.bin");
  int answers = 0;
  auto meter =
      std::make_unique<test::PseudoMeter>([&](const std::string&) -> std::vector<std::string> {
        if (++answers == 2 || answers == 3) return {};
        return {frame};
      });
  MeterSettings settings;
  settings.device = meter->device();
  const auto source = open_meter(settings);
  EXPECT_EQ(source->read(Seconds(0)).state, ReadState::ok);  // asks a second time, in vain
  meter->wait_for_answers(2);
  EXPECT_EQ(source->read(Seconds(0.5)).state, ReadState::ok);  // what it showed last still holds
  const ReadResult silent = source->read(Seconds(2));
  EXPECT_EQ(silent.state, ReadState::failed);
  EXPECT_NE(silent.message.find("no value for 2.0 s"), std::string::npos);
  EXPECT_EQ(source->read(Seconds(3.5)).state, ReadState::failed);  // asks a third time
  meter->wait_for_answers(3);
  EXPECT_EQ(source->read(Seconds(7)).state, ReadState::failed);  // and a fourth
  meter->wait_for_answers(4);
  const ReadResult back = source->read(Seconds(7.1));
  EXPECT_EQ(back.state, ReadState::restarted);
  EXPECT_DOUBLE_EQ(back.reading.energy.value, 5.12 * 1.043 * 0.5);  // the gap holds none
  meter.reset();
  // What the meter sent before it vanished may still come first.
  ReadResult last = source->read(Seconds(7.2));
  if (last.state != ReadState::lost) last = source->read(Seconds(7.3));
  EXPECT_EQ(last.state, ReadState::lost);
}

TEST_F(SerialMeter, AScpiMultimeterIsSetUpAndRead) {
  std::vector<std::string> commands;
  test::PseudoMeter meter([&](const std::string& asked) -> std::vector<std::string> {
    commands.push_back(asked);
    if (asked == "*IDN?\n") return {"OWON,XDM1041,", "24470309,V4.3\r\n"};
    if (asked == "MEAS1?\n") return {"2.5E", "+00\r\n"};
    return {};
  });
  MeterSettings settings;
  settings.kind = MeterKind::scpi;
  settings.device = meter.device();
  settings.volts = 12.0;
  {
    const auto source = open_meter(settings);
    EXPECT_NE(source->info().place.find("XDM1041"), std::string::npos);
    EXPECT_NE(source->info().includes.find("12 V that the user vouches for"), std::string::npos);
    const ReadResult reading = source->read(Seconds(1));
    ASSERT_EQ(reading.state, ReadState::ok);
    EXPECT_DOUBLE_EQ(reading.reading.power->value, 30.0);
    meter.wait_for_answers(3);
    // An equal value is a new measurement all the same.
    EXPECT_TRUE(source->read(Seconds(2)).reading.changed);
  }
  meter.stop();
  ASSERT_GE(commands.size(), 3U);
  EXPECT_EQ(commands[0], "*IDN?\n");
  EXPECT_EQ(commands[1], "CONF:CURR:DC\n");
  EXPECT_EQ(commands[2], "MEAS1?\n");
}

TEST_F(SerialMeter, SwappedLeadsAreSaidNotIntegrated) {
  test::PseudoMeter meter([&](const std::string& asked) -> std::vector<std::string> {
    return {asked == "*IDN?\n" ? "ACME,1\n" : "-1.0\n"};
  });
  MeterSettings settings;
  settings.kind = MeterKind::scpi;
  settings.device = meter.device();
  settings.query = "VAL1?";
  const ReadResult reading = open_meter(settings)->read(Seconds(1));
  EXPECT_EQ(reading.state, ReadState::failed);
  EXPECT_NE(reading.message.find("swap its leads"), std::string::npos);
}

TEST_F(SerialMeter, WhatIsWrongIsSaidWithTheWayOut) {
  MeterSettings settings;
  settings.timeout = Seconds(0.05);
  settings.device = "/dev/no-such-meter";
  EXPECT_NE(message_of(settings).find("/dev/no-such-meter: no such file"), std::string::npos);
  EXPECT_NE(message_of(settings).find("rfcomm bind"), std::string::npos);

  test::TemporaryFolder folder;
  settings.device = folder.write("file", "text").string();
  EXPECT_NE(message_of(settings).find("not a serial port"), std::string::npos);

  test::PseudoMeter silent([](const std::string&) { return std::vector<std::string>{}; });
  settings.device = silent.device();
  EXPECT_NE(message_of(settings).find("no answer within"), std::string::npos);
  settings.baud = 12345;
  EXPECT_NE(message_of(settings).find("no usual speed"), std::string::npos);
  settings.baud.reset();
  settings.kind = MeterKind::scpi;
  EXPECT_NE(message_of(settings).find("*IDN?"), std::string::npos);

  test::PseudoMeter wrong([](const std::string&) { return std::vector<std::string>{"hello\xff"}; });
  settings.kind = MeterKind::um;
  settings.device = wrong.device();
  EXPECT_NE(message_of(settings).find("'hello\\xff'"), std::string::npos);
}

TEST_F(SerialMeter, ALineIsClaimedByOneAtATime) {
  test::PseudoMeter meter([](const std::string&) { return std::vector<std::string>{}; });
  const SerialPort first(meter.device(), 9600);
  try {
    const SerialPort second(meter.device(), 9600);
    FAIL() << "opened twice";
  } catch (const SensorError& error) {
    EXPECT_NE(std::string(error.what()).find("in use"), std::string::npos);
  }
}

TEST_F(SerialMeter, BytesPassUnchanged) {
  // Terminals like to turn some of these into others, or into signals.
  std::string every;
  for (int c = 0; c < 256; ++c) every += static_cast<char>(c);
  test::PseudoMeter meter([&](const std::string& asked) {
    return std::vector<std::string>{asked == "?" ? every : std::string("wrong")};
  });
  SerialPort port(meter.device(), 115200);
  ASSERT_TRUE(port.send("?"));
  Bytes received;
  for (int tries = 0; received.size() < every.size() && tries < 100; ++tries) {
    const auto part = port.wait(Seconds(1)).bytes;
    received.insert(received.end(), part.begin(), part.end());
  }
  EXPECT_EQ(std::string(received.begin(), received.end()), every);
}

}  // namespace
}  // namespace encore::energy
