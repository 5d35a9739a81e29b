#pragma once

#include "app/window/settings_archive.h"
#include "app/window/settings_file.h"

namespace encore::app {

// Every field that is kept, with the limits of what a file may say; the same list for both
// directions. `Archive` is SettingsWriter or SettingsReader.

template <class Archive>
void visit_settings(Archive& archive, ui::Settings& settings);

/// The preferences that stand beside the settings: theme, scale, up axis.
template <class Archive>
void visit_preferences(Archive& archive, ui::Preferences& preferences);

/// What is state: division, size, recent files.
template <class Archive>
void visit_state(Archive& archive, ui::Preferences& preferences);

template <class Archive>
void visit_camera(Archive& archive, scene::Camera& camera);

}  // namespace encore::app
