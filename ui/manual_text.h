#pragma once

#include <string_view>

namespace encore::ui {

/// The manual (docs/manual.md), which the window shows: Markdown of headings (#, ##, ###),
/// paragraphs, lists (-), code in backticks and tables (|), in Latin letters as UTF-8. A paragraph
/// or list entry is one line. Lives as long as the program.
std::string_view manual_text();

}  // namespace encore::ui
