#include "energy/battery_life/battery_toml.h"
#include "energy/battery_life/runtime.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

std::string page() {
  return test::contents_of(ENCORE_SOURCE_DIR "/docs/battery-life.md");
}

/// The names in the first column of the table below a heading: rows that begin with "| `name` |".
std::vector<std::string> documented(const std::string& heading) {
  std::istringstream text(page());
  std::vector<std::string> names;
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("#")) inside = line == heading;
    if (!inside || !line.starts_with("| `")) continue;
    names.push_back(line.substr(3, line.find('`', 3) - 3));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> sorted(std::span<const std::string_view> keys) {
  std::vector<std::string> names(keys.begin(), keys.end());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(BatteryDocs, NameExactlyTheKeysThatAreRead) {
  auto pack_keys = sorted(battery_keys());
  std::erase(pack_keys, "cell");  // the table of the next heading
  EXPECT_EQ(documented("### [battery]"), pack_keys);
  EXPECT_EQ(documented("### [battery.cell]"), sorted(battery_cell_keys()));
}

TEST(BatteryDocs, TheExampleIsABattery) {
  const std::string text = page();
  const std::size_t start = text.find("```toml\n");
  ASSERT_NE(start, std::string::npos);
  const std::size_t end = text.find("```", start + 8);
  const Battery battery = parse_battery_toml(text.substr(start + 8, end - start - 8), "example");
  EXPECT_TRUE(forecast(battery, {Watts(20.0), {}}, BatteryModel::thevenin).time);
}

TEST(BatteryDocs, NameEveryModelAndPreset) {
  const std::string text = page();
  for (const BatteryModel model : kBatteryModels) {
    EXPECT_NE(text.find('`' + std::string(to_string(model)) + '`'), std::string::npos)
        << to_string(model);
  }
  for (const std::string_view preset : battery_presets()) {
    EXPECT_NE(text.find('`' + std::string(preset) + '`'), std::string::npos) << preset;
  }
}

}  // namespace
}  // namespace encore::energy
