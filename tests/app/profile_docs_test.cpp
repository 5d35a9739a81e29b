#include "app/accuracy/accuracy_rows.h"
#include "app/machine_log.h"
#include "app/transfer_derivation.h"
#include "app/workloads.h"
#include "energy/session_columns.h"
#include "energy/session_energy_columns.h"
#include "energy/session_toml.h"
#include "tests/app/profile_fakes.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace encore::app {
namespace {

using test::TemporaryFolder;

/// The names in the first column of the table below a heading: rows that begin with "| `name` |".
std::vector<std::string> documented(const std::string& heading) {
  std::ifstream file(ENCORE_SOURCE_DIR "/docs/session-format.md");
  EXPECT_TRUE(file) << "docs/session-format.md is missing";
  std::vector<std::string> names;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) inside = line == "## " + heading;
    if (!inside || !line.starts_with("| `")) continue;
    names.push_back(line.substr(3, line.find('`', 3) - 3));
  }
  return names;
}

TEST(SessionFormat, DocumentsExactlyTheColumnsThatAreWritten) {
  const energy::SessionColumns columns{configuration_columns(), counter_columns()};
  EXPECT_EQ(documented("samples.csv"), energy::sample_header());
  EXPECT_EQ(documented("frames.csv"), energy::frame_header(columns));
  EXPECT_EQ(documented("summary.csv"), energy::summary_header(columns));
  EXPECT_EQ(documented("phases.csv"), energy::phase_header(columns));
  EXPECT_EQ(documented("convergence.csv"), energy::convergence_header(columns));
  EXPECT_EQ(documented("windows.csv"), energy::window_header(columns));
  EXPECT_EQ(documented("machine.csv"), machine_log_header());
  EXPECT_EQ(documented("transfer.csv"), transfer_header(configuration_columns()));
  EXPECT_EQ(documented("accuracy.csv"), accuracy_header());
  EXPECT_EQ(documented("events.csv"), energy::event_header());
}

TEST(SessionFormat, DocumentsEveryKeyOfTheSessionFile) {
  // Give every optional key a value, so that all are written.
  energy::SessionInfo info;
  info.machine = {"cpu", 2,          1,         3,        "os",   "kernel", "governor",
                  true,  "compiler", "type",    "commit", "0x1",  800.0,    3e3,
                  true,  40.0,       "battery", "docker", {"gpu"}};
  info.settings = {{"memory", "pool"}};
  const TemporaryFolder folder;
  energy::write_session_toml(folder.path() / "session.toml", info);
  const std::vector<std::string> names = documented("session.toml");
  const auto knows = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };

  std::ifstream file(folder.path() / "session.toml");
  std::string table;
  int keys = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('[')) {
      EXPECT_TRUE(knows(line)) << line;
      table = line.starts_with("[[") ? "" : line.substr(1, line.find(']') - 1) + ".";
      if (line.starts_with("[[")) break;  // its keys are told in its own row
    } else if (line.find(" = ") != std::string::npos) {
      const std::string key = table + line.substr(0, line.find(' '));
      EXPECT_TRUE(knows(key)) << key;
      ++keys;
    }
  }
  EXPECT_GE(keys, 20) << "the session file was understood";
}

}  // namespace
}  // namespace encore::app
