#include "energy/csv.h"

#include "energy/session.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace encore::energy {
namespace {

using test::contents_of;
using test::TemporaryFolder;

TEST(Csv, FieldsAreQuotedOnlyWhereTheyNeedIt) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field(" blank first"), "\" blank first\"");
}

TEST(Csv, AnyFieldsSurviveWritingAndReading) {
  const TemporaryFolder folder;
  const CsvRecord header{"a", "b", "c"};
  const std::vector<CsvRecord> records{
      {"x,y", "\"", "\r\n"}, {"", " ", "\"\"quoted\"\""}, {"π", "tab\tinside", ",,,"}};
  {
    CsvWriter writer(folder.path() / "t.csv", header);
    for (const CsvRecord& record : records) writer.write(record);
    EXPECT_THROW(writer.write({"too", "few"}), std::logic_error);
  }
  const auto read = parse_csv(contents_of(folder.path() / "t.csv"));
  ASSERT_EQ(read.size(), 4U);
  EXPECT_EQ(read[0], header);
  for (std::size_t i = 0; i < records.size(); ++i) EXPECT_EQ(read[i + 1], records[i]);
}

TEST(Csv, LinesMayEndInCrLf) {
  const auto read = parse_csv("a,b\r\n1,2\r\n");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1], (CsvRecord{"1", "2"}));
}

TEST(Csv, AHalfWrittenLastLineIsDropped) {
  EXPECT_EQ(parse_csv("a,b\n1,2\n3,").size(), 2U);
  EXPECT_EQ(parse_csv("a,b\n1,2\n3,\"x\n").size(), 2U);
  EXPECT_TRUE(parse_csv("").empty());
}

TEST(Csv, NumbersReadBackAsTheSameDouble) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(parse_csv_number(csv_number(value)), value);
  }
}

TEST(Csv, WholeNumbersHaveNoExponentAndMissingOnesAreEmpty) {
  EXPECT_EQ(csv_number(10000000.0), "10000000");
  EXPECT_EQ(csv_number(0.0), "0");
  EXPECT_EQ(csv_number(0.25), "0.25");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(csv_number(std::nullopt), "");
  EXPECT_EQ(csv_number(std::nullopt, "unavailable"), "unavailable");
  EXPECT_FALSE(parse_csv_number("1,5"));
  EXPECT_FALSE(parse_csv_number(""));
  EXPECT_FALSE(parse_csv_number("12x"));
}

TEST(Csv, AFullDiskIsToldWithTheFilesName) {
  try {
    CsvWriter writer("/dev/full", {"a"});
    FAIL() << "the header did not fit";
  } catch (const SessionError& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/full"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("space"), std::string::npos) << error.what();
  }
}

TEST(Csv, AFolderThatIsNotThereIsTold) {
  EXPECT_THROW(CsvWriter("/nowhere/at/all.csv", {"a"}), SessionError);
}

}  // namespace
}  // namespace encore::energy
