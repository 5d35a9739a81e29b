#pragma once

#include "ui/layout.h"

#include <imgui.h>

#include <string>
#include <string_view>

namespace encore::ui {

// Small things that the window's own parts share.

/// A window without any decoration at a rectangle, for what is part of the frame. To be ended with
/// ImGui::End() whatever it returns.
bool begin_part(const char* id, const Rect& area, ImGuiWindowFlags more = 0);

/// Says on hovering what the last widget is; also where it is greyed.
void hint(std::string_view text);

/// A centred dialog of a size in ems, no larger than the window; `open` becomes false by its cross.
/// To be ended with ImGui::End().
bool begin_dialog(const char* title, float width, float height, bool& open,
                  ImGuiWindowFlags more = 0);

/// A small bar of progress; without a value it moves to and fro.
void progress_bar(float width, const double* share);

/// A word with a coloured ground, as a button.
bool badge(const char* id, std::string_view text, const ImVec4& color);

/// Text in a colour.
void colored_text(const ImVec4& color, std::string_view text);

/// The longest beginning of a text that is no wider, with an ellipsis where it is cut.
std::string fitted(std::string_view text, float width);

}  // namespace encore::ui
