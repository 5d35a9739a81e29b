#pragma once

#include "energy/plan.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::app {

/// How to measure and with what, as the command line says it; shared by profile and study.
struct MeasuringOptions {
  std::string plan;               ///< empty: settle with a power source, quick without
  std::optional<double> seconds;  ///< of the run
  std::optional<double> idle;     ///< seconds before and after
  std::optional<double> warm_up;
  std::optional<double> mix;
  std::optional<double> cool_down;
  std::optional<double> poll;
  std::string cut;    ///< watts, or "none"
  std::string until;  ///< "1%"
  std::optional<double> until_limit;
  std::optional<std::uint32_t> repeats;
  std::string order;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> sources;  ///< empty: auto
  std::string model;                 ///< constants of the power model; empty: none
  std::string sensor_root = "/";
};

void add_plan_options(CLI::App& command, MeasuringOptions& options);
void add_source_options(CLI::App& command, MeasuringOptions& options);

/// The plan asked for, fitted to the sources that are read. Throws UsageError.
energy::Plan make_plan(const MeasuringOptions& options,
                       std::span<const energy::SourceInfo> sources);

/// "1%", "0.5 %" or "0.01" as a share in (0, 1); throws UsageError that names `option`.
double parse_share(const std::string& text, const std::string& option);

}  // namespace encore::app
