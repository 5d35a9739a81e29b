#include "accel/stats.h"
#include "ui/panels/column_parts.h"
#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace encore::ui {

namespace {

using Value = std::optional<double>;

/// One row of the table: what is shown of a pane, nothing where it means nothing there.
struct Row {
  const char* name;
  const char* label;
  const char* tip;
  std::function<Value(const PaneView&)> value;
  std::function<std::string(double)> text;
};

std::string whole_text(double value) {
  return count_text(static_cast<std::uint64_t>(value));
}

/// In as few signs as a narrow column has room for: "1.09 M".
std::string brief_text(double value) {
  constexpr std::array<const char*, 5> kLetters{"", " k", " M", " G", " T"};
  std::size_t letter = 0;
  while (value >= 999.5 && letter + 1 < kLetters.size()) {
    value /= 1000.0;
    ++letter;
  }
  return fmt::format("{:.3g}{}", value, kLetters.at(letter));
}

/// "696.3 KiB" as "696 KiB".
std::string rounded_text(const std::string& text) {
  const std::size_t end = text.find(' ');
  if (end == std::string::npos || text.find('.') > end) return text;
  const double number = std::strtod(text.c_str(), nullptr);
  return fmt::format("{:.{}f}{}", number, number < 9.95 ? 1 : 0, text.substr(end));
}

std::string real_text(double value) {
  return fmt::format("{:.4g}", value);
}

std::string memory_text(double value) {
  return bytes_text(static_cast<std::uint64_t>(value));
}

bool is_grid(const PaneView& pane) {
  return pane.stats->grid_size[0] > 0;
}

bool is_tree(const PaneView& pane) {
  return !is_grid(pane) && pane.stats->nodes > 0;
}

/// A field of BuildStats.
template <class Field>
std::function<Value(const PaneView&)> field(Field accel::BuildStats::*member) {
  return [member](const PaneView& pane) -> Value {
    return static_cast<double>((*pane.stats).*member);
  };
}

template <class Field>
std::function<Value(const PaneView&)> tree_field(Field accel::BuildStats::*member) {
  return [member](const PaneView& pane) -> Value {
    if (!is_tree(pane)) return std::nullopt;
    return static_cast<double>((*pane.stats).*member);
  };
}

std::vector<Row> build_rows() {
  using Stats = accel::BuildStats;
  return {
      {"triangles", "triangles", "Triangles that the structure was built over.",
       field(&Stats::triangles), whole_text},
      {"allocations", "allocations",
       "Requests to the system's allocator by the last build or update (the thesis' MC). A build "
       "that reuses a pool has few.",
       field(&Stats::allocations), whole_text},
      {"allocated", "bytes allocated",
       "Bytes of those requests (the thesis' MS); 1 KiB = 1024 bytes.",
       field(&Stats::allocated_bytes), memory_text},
      {"triangle_box_tests", "triangle-box tests",
       "Exact tests of whether a triangle overlaps a box, by the last build. Structures that sort "
       "by boxes alone do none.",
       [](const PaneView& pane) -> Value {
         const auto tests = pane.stats->triangle_box_tests;
         return tests > 0 ? Value(static_cast<double>(tests)) : std::nullopt;
       },
       whole_text},
  };
}

std::vector<Row> shape_rows() {
  using Stats = accel::BuildStats;
  return {
      {"nodes", "nodes", "Inner nodes and leaves of a tree.", tree_field(&Stats::nodes),
       whole_text},
      {"cells", "cells", "Cells of the grid, the empty ones too: x times y times z.",
       [](const PaneView& pane) -> Value {
         if (!is_grid(pane)) return std::nullopt;
         const auto& size = pane.stats->grid_size;
         return double(size[0]) * double(size[1]) * double(size[2]);
       },
       whole_text},
      {"leaves", "leaves", "Leaves of a tree; of a grid the cells that hold a triangle.",
       field(&Stats::leaves), whole_text},
      {"empty_leaves", "empty leaves", "Leaves that hold nothing: rays pass them at once.",
       tree_field(&Stats::empty_leaves), whole_text},
      {"depth", "depth", "Levels below the root, which alone has depth 0.",
       tree_field(&Stats::max_depth), whole_text},
      {"references", "references",
       "Entries of triangles in leaves. A triangle that lies in several leaves has several.",
       field(&Stats::references), whole_text},
      {"duplication", "duplication", "References over triangles: 1 where none is held twice.",
       [](const PaneView& pane) -> Value {
         if (pane.stats->triangles == 0) return std::nullopt;
         return pane.stats->duplication();
       },
       real_text},
      {"per_leaf", "references a leaf", "Mean over the leaves or cells that hold any.",
       [](const PaneView& pane) -> Value {
         if (pane.stats->references == 0) return std::nullopt;
         return pane.stats->references_per_leaf();
       },
       real_text},
      {"largest_leaf", "largest leaf", "Most references in one leaf or cell.",
       field(&Stats::largest_leaf), whole_text},
      {"bytes", "memory",
       "What tracing needs: nodes, references, cells, without the triangles; 1 KiB = 1024 bytes.",
       field(&Stats::bytes), memory_text},
      {"sah_cost", "SAH cost",
       "Expected cost of a random ray that hits the scene's box, in units of one triangle test; a "
       "step costs 1 (surface area heuristic). Lower is better.",
       field(&Stats::sah_cost), real_text},
      {"sah_decay", "SAH decay",
       "SAH cost now over that of the last build: above 1, refitting has made rays dearer.",
       [](const PaneView& pane) { return pane.sah_decay; }, real_text},
      {"break_even", "build pays after",
       "Policy auto: frames in which a build now would have paid for itself, by what building, "
       "updating and tracing were seen to cost in this pane: in joules where the watts of each "
       "phase are stated (--model), else in time.",
       [](const PaneView& pane) { return pane.break_even_frames; }, real_text},
      {"pane_memory", "memory of the pane",
       "Triangles, structure and pictures of this pane together; 1 KiB = 1024 bytes.",
       [](const PaneView& pane) -> Value {
         if (pane.memory_bytes == 0) return std::nullopt;
         return static_cast<double>(pane.memory_bytes);
       },
       memory_text},
  };
}

/// The other pane, if it has another structure to compare with.
const PaneView* compared_pane(const ColumnContext& context) {
  const std::size_t mine = context.state.inspected_pane;
  const auto& panes = context.state.settings.panes;
  const PaneView& other = context.view.panes.at(1 - mine);
  if (!other.stats || panes.at(1 - mine).device == PaneDevice::off) return nullptr;
  const bool differs = !(panes.at(mine).structure == panes.at(1 - mine).structure) ||
                       panes.at(mine).policy != panes.at(1 - mine).policy;
  return differs ? &other : nullptr;
}

/// "+12.5 %", or what is clearer where they are far apart: "107 times".
std::string percent_text(double mine, double other) {
  if (mine == other) return "same";
  if (mine == 0.0) return "";
  const double percent = (other - mine) / mine * 100.0;
  if (percent >= 1000.0) return fmt::format("{:.3g} times", other / mine);
  return fmt::format("{:+.1f} %", percent);
}

/// What a pane is called beside the other one.
std::string pane_word(const ColumnContext& context, std::size_t pane) {
  const auto& panes = context.state.settings.panes;
  if (panes.at(0).device == panes.at(1).device) return pane == 0 ? "left" : "right";
  return device_title(panes.at(pane).device);
}

std::string pane_title(const ColumnContext& context, std::size_t pane) {
  return fmt::format("{} {}", pane_word(context, pane),
                     accel::to_string(context.state.settings.panes.at(pane).structure.kind));
}

/// The two panes whose structures are compared; `other` is null where there is only one.
struct Compared {
  const PaneView& mine;
  const PaneView* other = nullptr;
  std::string my_title;
  std::string other_title;
  bool wide = false;  ///< there is room for a column of the other's own
};

std::string exact_text(const Row& row, const Value& value) {
  return value ? row.text(*value) : "none";
}

/// At the right of its column; the exact number where there is room for it.
void draw_cell(const Row& row, const char* column, const Value& value, const std::string& tip) {
  ImGui::TableNextColumn();
  std::string text = value ? row.text(*value) : "–";
  const float room = ImGui::GetContentRegionAvail().x;
  const auto width = [&text] { return ImGui::CalcTextSize(text.c_str()).x; };
  const bool counted = text.find(',') != std::string::npos;
  if (value && counted && width() > room) text = brief_text(*value);
  if (value && width() > room) text = rounded_text(text);
  text = fitted(text, room);
  if (room > width()) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width());
  ImGui::TextUnformatted(text.c_str());
  note_widget(fmt::format("statistics.{}.{}", row.name, column), text);
  tooltip(tip);
}

void draw_row(const Row& row, const Compared& compared) {
  const Value mine = row.value(compared.mine);
  const Value other = compared.other != nullptr ? row.value(*compared.other) : std::nullopt;
  if (!mine && !other) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const float room = ImGui::GetContentRegionAvail().x;
  const std::string label = fitted(row.label, room);
  ImGui::TextUnformatted(label.c_str());
  note_widget(std::string("statistics.") + row.name, label);
  tooltip(label == row.label ? std::string(row.tip) : fmt::format("{}: {}", row.label, row.tip));
  if (compared.other == nullptr) {
    return draw_cell(row, "value", mine, fmt::format("{} {}", exact_text(row, mine), row.label));
  }
  const std::string both =
      fmt::format("{}\n{}: {}\n{}: {}", row.label, compared.my_title, exact_text(row, mine),
                  compared.other_title, exact_text(row, other));
  draw_cell(row, "value", mine, both);
  // What only the other one has stands in the place of the difference.
  const bool only_other = !mine || (*mine == 0.0 && other && *other != 0.0);
  if (compared.wide || only_other) draw_cell(row, "other", other, both);
  if (only_other) return;
  ImGui::TableNextColumn();
  const std::string percent = other ? percent_text(*mine, *other) : "–";
  const std::string cut = fitted(percent, ImGui::GetContentRegionAvail().x);
  ImGui::TextUnformatted(cut.c_str());
  note_widget(fmt::format("statistics.{}.difference", row.name), cut);
  tooltip(fmt::format("{}: {} against {}.\n{}", percent, compared.other_title, compared.my_title,
                      both));
}

void draw_head(const ColumnContext& context, std::size_t pane, const std::string& tip) {
  ImGui::TableNextColumn();
  const PaneSettings& settings = context.state.settings.panes.at(pane);
  const std::string word = fitted(pane_word(context, pane), ImGui::GetContentRegionAvail().x);
  colored_text(device_color(settings.device), word);
  tooltip(tip);
}

void draw_table(const ColumnContext& context, const char* id, const std::vector<Row>& rows,
                const Compared& compared) {
  const bool two = compared.other != nullptr;
  const int columns = !two ? 2 : compared.wide ? 4 : 3;
  if (!ImGui::BeginTable(id, columns, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  const float em = ImGui::GetFontSize();
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, 1.4F);
  if (!two || compared.wide) {
    ImGui::TableSetupColumn("mine", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  } else {
    ImGui::TableSetupColumn("mine", ImGuiTableColumnFlags_WidthFixed, em * 4.5F);
  }
  if (compared.wide) ImGui::TableSetupColumn("other", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  if (two) {
    ImGui::TableSetupColumn("difference", ImGuiTableColumnFlags_WidthFixed, em * 4.8F);
    const std::size_t mine = context.state.inspected_pane;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_head(context, mine, compared.my_title);
    if (compared.wide) draw_head(context, 1 - mine, compared.other_title);
    draw_head(context, 1 - mine,
              fmt::format("How much more or less {} has than {}.", compared.other_title,
                          compared.my_title));
  }
  for (const Row& row : rows) draw_row(row, compared);
  ImGui::EndTable();
}

}  // namespace

void draw_statistics(const ColumnContext& context) {
  const PaneView& shown = context.shown();
  if (!shown.stats) {
    const char* const why =
        shown.refits_on_device
            ? "The graphics device builds this tree: its figures are not at hand."
            : "There is no structure yet: its figures show when it is built.";
    return draw_missing(context, "statistics.none", shown.problem.empty() ? why : shown.problem);
  }
  const std::size_t mine = context.state.inspected_pane;
  Compared compared{shown, compared_pane(context), pane_title(context, mine),
                    pane_title(context, 1 - mine)};
  compared.wide =
      compared.other != nullptr && ImGui::GetContentRegionAvail().x > ImGui::GetFontSize() * 25.0F;
  const ThemeColors& colors = theme_colors(context.state.preferences.theme);
  if (compared.other != nullptr) {
    const std::string text =
        fmt::format("{}, and {} against it", compared.my_title, compared.other_title);
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    note_widget("statistics.compared", text);
    tooltip("Values of the first, and how much more or less the other one has, in %.");
  }
  colored_text(colors.dim_text, "Last build or update");
  draw_table(context, "build", build_rows(), compared);
  ImGui::Spacing();
  colored_text(colors.dim_text, "Structure");
  draw_table(context, "shape", shape_rows(), compared);
  ImGui::Spacing();
  draw_profile(context);
}

}  // namespace encore::ui
