// Recordings as people's meters write them, and their replay.
#include "energy/sources/csv_replay.h"

#include "energy/sources/csv_columns.h"
#include "energy/sources/discovery.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace encore::energy {
namespace {

class CsvReplay : public testing::Test {
 protected:
  [[nodiscard]] Recording load(const std::string& text) const {
    return load_recording(folder.write("r.csv", text));
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      (void)load(text);
    } catch (const SensorError& error) {
      return error.what();
    }
    return "loaded";
  }
  test::TemporaryFolder folder;
};

TEST(CsvColumns, NamesAreUnderstoodInManySpellings) {
  const auto factor = [](const char* name, RecordedQuantity quantity) {
    const auto column = understand_column(name);
    return column && column->quantity == quantity ? column->factor : -1.0;
  };
  EXPECT_EQ(factor("time_s", RecordedQuantity::time), 1.0);
  EXPECT_EQ(factor("Time (ms)", RecordedQuantity::time), 1e-3);
  EXPECT_EQ(factor("Seconds", RecordedQuantity::time), 1.0);
  EXPECT_EQ(factor("watts", RecordedQuantity::power), 1.0);
  EXPECT_EQ(factor("Power [mW]", RecordedQuantity::power), 1e-3);
  EXPECT_EQ(factor("energy_mwh", RecordedQuantity::energy), 3.6);
  EXPECT_EQ(factor("E(kWh)", RecordedQuantity::energy), 3.6e6);
  EXPECT_EQ(factor("Voltage(V)", RecordedQuantity::volts), 1.0);
  EXPECT_EQ(factor("current_mA", RecordedQuantity::amps), 1e-3);
  // A unit of another quantity, a limit and a name of no kind are no columns.
  for (const char* name : {"power_s", "power_limit", "temperature", "", "peak power w"}) {
    EXPECT_FALSE(understand_column(name)) << name;
  }
}

TEST_F(CsvReplay, WattsBecomeJoulesByTrapezoids) {
  const Recording recording = load("time_s,watts\n10,20\n11,20\n12,40\n14,40\n");
  EXPECT_FALSE(recording.is_counter);
  EXPECT_EQ(recording.spacing, Seconds(1));
  ASSERT_EQ(recording.trace.points().size(), 4U);
  EXPECT_DOUBLE_EQ(recording.trace.energy_between(Seconds(10), Seconds(14))->value, 20 + 30 + 80);
  EXPECT_FALSE(recording.trace.points()[1].changed);
  EXPECT_TRUE(recording.trace.points()[2].changed);
}

TEST_F(CsvReplay, JoulesAreTakenBeforeWattsAndWattsBeforeWattHours) {
  const Recording joules = load("t,power,energy_j\n0,1,500\n1,1,507\n2,1,521\n");
  EXPECT_TRUE(joules.is_counter);
  EXPECT_DOUBLE_EQ(joules.trace.points().back().energy.value, 21.0);
  const Recording watts = load("t,power,energy_mwh\n0,1,500\n1,1,500\n2,1,501\n");
  EXPECT_FALSE(watts.is_counter);
  EXPECT_DOUBLE_EQ(watts.trace.points().back().energy.value, 2.0);
  const Recording hours = load("t,energy_mwh\n0,500\n1,500\n2,501\n");
  EXPECT_NEAR(hours.trace.points().back().energy.value, 3.6, 1e-9);
  const Recording product = load("t,Voltage(V),Current(mA)\n0,20,1000\n1,20,1500\n");
  EXPECT_DOUBLE_EQ(product.trace.points().back().energy.value, 25.0);
}

TEST_F(CsvReplay, OtherSeparatorsDecimalCommasAndCommentsAreRead) {
  for (const char* text :
       {"\xef\xbb\xbf# a meter\r\n\r\nTime (s);Power (W)\r\n0,5;10,25\r\n1;11\r\n",
        "time_s\tpower_w\n0.5\t10.25\n# pause\n1\t11",
        "\"time_s\", \"w\"\n\"0.5\", +10.25\n1,11\n"}) {
    const Recording recording = load(text);
    ASSERT_EQ(recording.trace.points().size(), 2U) << text;
    EXPECT_EQ(recording.trace.points()[0].time, Seconds(0.5)) << text;
    EXPECT_EQ(recording.trace.points()[0].power, Watts(10.25)) << text;
  }
}

TEST_F(CsvReplay, EmptyFieldsPausesAndResetsAreGapsNotZeros) {
  const Recording recording =
      load("t,w\n0,10\n1,10\n2,\n3,10\n4,10\n5,nan\n6,10\n7,10\n60,10\n61,10\n");
  EXPECT_FALSE(recording.trace.energy_between(Seconds(1), Seconds(3)));
  EXPECT_FALSE(recording.trace.energy_between(Seconds(4), Seconds(6)));
  EXPECT_FALSE(recording.trace.energy_between(Seconds(7), Seconds(60)));
  EXPECT_DOUBLE_EQ(recording.trace.energy_between(Seconds(3), Seconds(4))->value, 10.0);
  const Recording reset = load("t,j\n0,100\n1,110\n2,5\n3,15\n");
  EXPECT_FALSE(reset.trace.energy_between(Seconds(1), Seconds(2)));
  EXPECT_DOUBLE_EQ(reset.trace.points().back().energy.value, 20.0);
}

TEST_F(CsvReplay, ALastLineThatWasCutOffIsDropped) {
  EXPECT_EQ(load("t,w\n0,1\n1,2\n2").trace.points().size(), 2U);
  EXPECT_EQ(load("t,w\n0,1\n1,2\n2,3").trace.points().size(), 3U);
}

TEST_F(CsvReplay, WhatIsWrongIsNamedByFileAndLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "empty"},
      {"t,w\n", "0 rows with a value"},
      {"t,w\n0,1\n1,\n", "1 rows with a value"},
      {"w\n1\n", "r.csv:1: no column of time"},
      {"# x\ntime,volts\n", "r.csv:2: no column of energy or power"},
      {"t,w,power\n", "r.csv:1: the columns 'w' and 'power' mean the same"},
      {"t,w\n0,1\n1\n2,3\n", "r.csv:3: 1 fields where the header has 2"},
      {"t,w\n0,1\n\n1,one\n2,3\n", "r.csv:4: 'one' is no number"},
      {"t,w\n12:00:01,1\n", "seconds since any moment"},
      {"t,w\n0,1\n,2\n1,2\n", "r.csv:3: no time"},
      {"t,w\n1,1\n0.5,2\n2,2\n", "r.csv:3: time goes back from 1 s to 0.5 s"},
      {"t,w\n0,1\n1,-2\n2,1\n", "r.csv:3: -2 W"},
      {"t,w\n0,1\n1,1e308\n2,1\n", "r.csv:3: '1e308' is too large"},
      {"t_h,w\n0,1\n1e307,1\n2,1\n", "r.csv:3: '1e307' is too large"},
      {"t,volts,amps\n0,1,1\n1,1,-1e300\n2,1,1\n", "r.csv:3: '-1e300' is too large"},
  };
  for (const auto& [text, part] : cases) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
  }
  EXPECT_THROW((void)load_recording(folder.path() / "none.csv"), SensorError);
}

TEST_F(CsvReplay, PlaysFromTheFirstReadingAndIsLostAtItsEnd) {
  const auto source = open_replay(load("t,w\n50,10\n51,10\n52,30\n"));
  EXPECT_EQ(source->info().kind, SourceKind::replay);
  EXPECT_EQ(source->info().name, "replay:r.csv");
  ReadResult result = source->read(Seconds(1000));
  ASSERT_EQ(result.state, ReadState::ok);
  EXPECT_EQ(result.reading.energy, Joules(0));
  EXPECT_EQ(result.reading.power, Watts(10));
  result = source->read(Seconds(1000.5));
  EXPECT_DOUBLE_EQ(result.reading.energy.value, 5.0);
  EXPECT_FALSE(result.reading.changed);
  result = source->read(Seconds(1002));
  EXPECT_DOUBLE_EQ(result.reading.energy.value, 30.0);
  EXPECT_TRUE(result.reading.changed);
  EXPECT_EQ(source->read(Seconds(1002.5)).state, ReadState::lost);
}

TEST_F(CsvReplay, ACounterStepsAndAGapIsAGap) {
  const auto source = open_replay(load("t,j\n0,100\n1,110\n2,\n3,150\n4,160\n"), Seconds(1000));
  EXPECT_EQ(source->read(Seconds(999)).state, ReadState::failed);  // not yet begun
  EXPECT_EQ(source->read(Seconds(1000)).state, ReadState::ok);
  ReadResult result = source->read(Seconds(1000.9));
  EXPECT_EQ(result.reading.energy, Joules(0));
  EXPECT_FALSE(result.reading.changed);
  result = source->read(Seconds(1001));
  EXPECT_DOUBLE_EQ(result.reading.energy.value, 10.0);
  EXPECT_FALSE(result.reading.power);
  EXPECT_EQ(source->read(Seconds(1002)).state, ReadState::failed);
  result = source->read(Seconds(1003));
  EXPECT_EQ(result.state, ReadState::restarted);
  EXPECT_DOUBLE_EQ(result.reading.energy.value, 10.0);
  result = source->read(Seconds(1004));
  EXPECT_EQ(result.state, ReadState::ok);
  EXPECT_DOUBLE_EQ(result.reading.energy.value, 20.0);
}

TEST_F(CsvReplay, AGapBetweenTwoReadingsIsStillAGap) {
  const auto source = open_replay(load("t,j\n0,100\n1,110\n2,\n3,150\n4,160\n"), Seconds(0));
  source->read(Seconds(1));
  EXPECT_EQ(source->read(Seconds(4)).state, ReadState::restarted);
}

TEST_F(CsvReplay, AlignedTracesMoveInTimeOnly) {
  const Recording recording = load("t,w\n0,10\n1,20\n2,\n3,10\n4,10\n");
  const TraceView moved = aligned_trace(recording, Seconds(-7.5));
  ASSERT_EQ(moved.points().size(), recording.trace.points().size());
  for (std::size_t i = 0; i < moved.points().size(); ++i) {
    EXPECT_EQ(moved.points()[i].time, recording.trace.points()[i].time + Seconds(-7.5));
    EXPECT_EQ(moved.points()[i].energy, recording.trace.points()[i].energy);
    EXPECT_EQ(moved.points()[i].starts_stretch, recording.trace.points()[i].starts_stretch);
  }
}

}  // namespace
}  // namespace encore::energy
