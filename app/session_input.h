#pragma once

#include "energy/session.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::app {

/// Reads a session folder that the user named. Throws scene::InputError (exit code 3) with the
/// file, the reason and what to name instead.
energy::Session open_session(const std::string& folder);

/// The value of one part of a configuration; empty if it has none.
std::string configuration_value(const std::vector<energy::KeyValue>& configuration,
                                std::string_view key);

/// The value of one of a row's counters; nothing if it has none.
std::optional<double> counter_value(const energy::SummaryRow& row, std::string_view name);

/// What identifies a configuration across sessions: all its parts that have a value, but for the
/// repeat, the number of triangles (which may change with time), and what says of plain ray casting
/// that it is plain (older sessions do not).
std::vector<energy::KeyValue> configuration_identity(
    const std::vector<energy::KeyValue>& configuration);

/// For people: "toys, bvh-median, dynamic, rebuild, 256x256, cpu".
std::string configuration_name(const std::vector<energy::KeyValue>& configuration);

/// The sources whose energies a session's figures add up, by name, or the sensor's detail for a
/// session without any.
std::string sensor_name(const energy::SessionInfo& info);

/// Relative standard uncertainty of the gain of a session's energies: the largest of its sources.
double gain_uncertainty(const energy::SessionInfo& info);

/// The half-width of a watt or joule figure of summary.csv without the gain error of its sources,
/// which all figures of a session share. Sources of different gains: too wide rather than too
/// narrow.
double without_gain(const energy::SessionInfo& info, double value, double half_width);

}  // namespace encore::app
