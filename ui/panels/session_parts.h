#pragma once

#include "ui/ui_state.h"
#include "ui/view.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace encore::ui {

// What the plots and the sessions' window share of a comparison.

/// A table of what differs, a row a configuration, as high as `height` pixels (0: what is left).
/// Widgets are named `<name>.row.<n>`.
void draw_changes(const char* name, const std::vector<ChangeView>& changes, Theme theme,
                  float height);

/// "encore-1": the last part of a session's folder.
std::string session_name(const std::string& folder);

/// Text that breaks at the window's edge.
void wrapped_text(const std::string& text);
/// The same in the colour of problems or warnings.
void wrapped_text(const ImVec4& color, const std::string& text);

}  // namespace encore::ui
