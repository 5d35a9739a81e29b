#pragma once

#include "energy/battery_life/runtime.h"
#include "energy/battery_life/step_study.h"
#include "energy/provenance.h"
#include "energy/session.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// One load to forecast for: a row of a session's summary, or what the command line states.
struct BatteryCase {
  std::vector<energy::KeyValue> configuration;  ///< what tells it from the others; may be empty
  energy::BatteryLoad load;
  std::optional<energy::Joules> each;  ///< an operation's; without, operations are not counted
  std::string operation = "frame";     ///< or "build"
  energy::Provenance origin;           ///< of the load
};

/// What `encore battery` prints.
struct BatteryReport {
  energy::Battery battery;
  std::vector<energy::BatteryModel> models;
  std::vector<BatteryCase> cases;
};

/// The loads of a session: its rows that have watts. The others are counted in `without_watts`.
std::vector<BatteryCase> session_cases(const energy::Session& session, std::size_t& without_watts);

/// For people: battery, load and where it comes from, and a line a case and model.
std::string battery_text(const BatteryReport& report);
/// The same as members of one JSON object, without its braces: "battery" and "forecasts". Times
/// without an end are null.
std::string battery_json(const BatteryReport& report);

/// Error against step size and run time, as text and as the JSON member "steps".
std::string step_text(const std::vector<energy::StepTable>& tables);
std::string step_json(const std::vector<energy::StepTable>& tables);

}  // namespace encore::app
