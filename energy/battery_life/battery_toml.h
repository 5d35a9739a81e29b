#pragma once

#include "energy/battery_life/battery.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace encore::energy {

/// Reads the table [battery] of a TOML file (docs/battery-life.md): a file of its own, or a scene
/// or study file, whose other tables are not looked at. Throws BatteryError "file:line:column: ..."
/// for syntax errors, values out of range, figures that contradict each other and unknown keys
/// (with the nearest known one: a misspelt key must not fall back to a typical value in silence).
Battery read_battery_toml(const std::filesystem::path& path);

/// The same from text; `file` names it in messages.
Battery parse_battery_toml(std::string_view text, const std::string& file);

/// The keys of [battery] and of [battery.cell].
std::span<const std::string_view> battery_keys();
std::span<const std::string_view> battery_cell_keys();

}  // namespace encore::energy
