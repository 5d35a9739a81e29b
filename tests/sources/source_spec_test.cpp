// What --source understands, and what it says of the rest.
#include "energy/sources/source_spec.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace encore::energy {
namespace {

TEST(SourceSpec, AKindAloneMeansAllOfItAndANameMeansOne) {
  const SourceSpec all = parse_source_spec("rapl");
  EXPECT_EQ(all.kind, SourceKind::rapl);
  EXPECT_EQ(all.unit, "");
  const SourceSpec one = parse_source_spec("rapl:package-0");
  EXPECT_EQ(one.unit, "package-0");
  EXPECT_EQ(parse_source_spec("hwmon:amdgpu:0000:03:00.0").unit, "amdgpu:0000:03:00.0");

  SourceInfo info;
  info.kind = SourceKind::rapl;
  info.name = "rapl:package-0";
  EXPECT_TRUE(all.names(info));
  EXPECT_TRUE(one.names(info));
  info.name = "rapl:package-01";
  EXPECT_FALSE(one.names(info));
  info.kind = SourceKind::nvml;
  EXPECT_FALSE(all.names(info));
}

TEST(SourceSpec, EveryKindsWordIsUnderstood) {
  for (const auto kind :
       {SourceKind::rapl, SourceKind::perf_energy, SourceKind::battery, SourceKind::hwmon,
        SourceKind::nvml, SourceKind::model, SourceKind::simulated}) {
    EXPECT_EQ(parse_source_spec(to_string(kind)).kind, kind);
  }
}

TEST(SourceSpec, AMeterHasATypeAndADevice) {
  const SourceSpec spec = parse_source_spec("meter:um25c:/dev/rfcomm0");
  EXPECT_EQ(spec.kind, SourceKind::meter);
  ASSERT_TRUE(spec.meter);
  EXPECT_EQ(spec.meter->kind, MeterKind::um);
  EXPECT_EQ(spec.meter->device, "/dev/rfcomm0");
  EXPECT_FALSE(spec.meter->baud);
}

TEST(SourceSpec, AScpiMeterTakesItsConstant) {
  const SourceSpec spec = parse_source_spec("meter:scpi:/dev/ttyUSB0:volts=19.5");
  EXPECT_EQ(spec.meter->kind, MeterKind::scpi);
  EXPECT_EQ(spec.meter->device, "/dev/ttyUSB0");
  EXPECT_EQ(spec.meter->volts, 19.5);
  EXPECT_FALSE(spec.meter->amps);
}

TEST(SourceSpec, DevicesAndQueriesMayHoldColons) {
  const SourceSpec spec = parse_source_spec(
      "meter:scpi:/dev/serial/by-path/"
      "pci-0000:00:14.0-usb-0:2:1.0-port0:query=MEAS:POW?:baud=115200");
  EXPECT_EQ(spec.meter->device, "/dev/serial/by-path/pci-0000:00:14.0-usb-0:2:1.0-port0");
  EXPECT_EQ(spec.meter->query, "MEAS:POW?");
  EXPECT_EQ(spec.meter->baud, 115200U);
}

TEST(SourceSpec, AReplayHasAFileAndPerhapsAnOffset) {
  EXPECT_EQ(parse_source_spec("replay:runs/a:b.csv").replay->file, "runs/a:b.csv");
  EXPECT_FALSE(parse_source_spec("replay:a.csv").replay->offset);
  const auto spec = parse_source_spec("replay:a.csv:offset=-1.5");
  EXPECT_EQ(spec.replay->file, "a.csv");
  EXPECT_EQ(spec.replay->offset, Seconds(-1.5));
}

TEST(SourceSpec, WhatIsWrongIsNamedWithTheWayOut) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "unknown kind ''"},
      {"wattmeter", "there are rapl, perf, battery"},
      {"rapl:", "no name behind the colon"},
      {"meter", "unknown meter ''"},
      {"meter:um26:/dev/rfcomm0", "um24c, um25c, um34c and scpi"},
      {"meter:um25c", "no device"},
      {"meter:um25c:", "meter:um25c:/dev/rfcomm0"},
      {"meter:scpi:/dev/ttyUSB0:volts=many", "volts=many is no number"},
      {"meter:scpi:/dev/ttyUSB0:volts=", "no value"},
      {"meter:scpi:/dev/ttyUSB0:volts=0", "above 0"},
      {"meter:scpi:/dev/ttyUSB0:volts=5:amps=1", "exclude each other"},
      {"meter:scpi:/dev/ttyUSB0:volts=5:volts=6", "stands twice"},
      {"meter:scpi:/dev/ttyUSB0:volt=5", "no option 'volt' here"},
      {"meter:um25c:/dev/rfcomm0:volts=5", "no option 'volts' here"},
      {"meter:um25c:/dev/rfcomm0:baud=9600.5", "no speed of a serial line"},
      {"replay:", "no file"},
      {"replay:a.csv:offset=soon", "offset=soon is no number"},
  };
  for (const auto& [text, part] : cases) {
    try {
      parse_source_spec(text);
      ADD_FAILURE() << "understood: " << text;
    } catch (const SourceSpecError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("source '" + text + "'"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace encore::energy
