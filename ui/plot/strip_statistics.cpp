#include "ui/plot/strip_draw.h"
#include "ui/plot/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace encore::ui {

namespace {

/// A table of texts: the first row heads it, columns are dropped by rank until it fits.
struct Column {
  std::string head;
  int rank = 0;  ///< the highest goes first
  std::vector<std::string> cells;

  [[nodiscard]] float width() const {
    float widest = text_width(head);
    for (const std::string& cell : cells) widest = std::max(widest, text_width(cell));
    return widest + em();
  }
};

using Row = std::pair<std::string, RangeStatistics>;

template <class Text>
Column column_of(const std::vector<Row>& rows, std::string head, int rank, const Text& text) {
  Column column{std::move(head), rank, {}};
  for (const Row& row : rows) column.cells.push_back(text(row.second));
  return column;
}

std::vector<Column> columns_of(const std::vector<Row>& rows, const StripData& data) {
  const std::string& unit = data.unit;
  const auto value = [&](double number) { return value_text(number, unit); };
  const auto between = [&](double low, double high) {
    return fmt::format("{} .. {}", value(low), value(high));
  };
  std::vector<Column> columns;
  columns.push_back({"", 0, {}});
  for (const Row& row : rows) columns.back().cells.push_back(row.first);
  columns.push_back(column_of(rows, "mean", 0, [&](const RangeStatistics& s) {
    return value(s.time_mean.value_or(s.mean));
  }));
  columns.push_back(column_of(rows, "energy", 0, [&](const RangeStatistics& s) {
    return value_text(s.integral, data.integral_unit);
  }));
  columns.push_back(column_of(rows, "median", 1, [&](const RangeStatistics& s) {
    return (s.approximate ? "~" : "") + value(s.median);
  }));
  columns.push_back(column_of(rows, "5 .. 95 %", 3, [&](const RangeStatistics& s) {
    return (s.approximate ? "~" : "") + between(s.p5, s.p95);
  }));
  columns.push_back(column_of(rows, "25 .. 75 %", 5, [&](const RangeStatistics& s) {
    return (s.approximate ? "~" : "") + between(s.p25, s.p75);
  }));
  columns.push_back(column_of(rows, "99 %", 6, [&](const RangeStatistics& s) {
    return (s.approximate ? "~" : "") + value(s.p99);
  }));
  columns.push_back(column_of(rows, "min .. max", 4,
                              [&](const RangeStatistics& s) { return between(s.min, s.max); }));
  columns.push_back(column_of(rows, "samples (new)", 2, [&](const RangeStatistics& s) {
    return fmt::format("{} ({})", s.samples, s.changes);
  }));
  columns.push_back(column_of(rows, "without data", 7, [&](const RangeStatistics& s) {
    return duration_text(s.without_data_s);
  }));
  return columns;
}

float total_width(const std::vector<Column>& columns) {
  float width = 0.0F;
  for (const Column& column : columns) width += column.width();
  return width;
}

void drop_until_it_fits(std::vector<Column>& columns, float width) {
  while (total_width(columns) > width) {
    const auto worst =
        std::max_element(columns.begin(), columns.end(),
                         [](const Column& a, const Column& b) { return a.rank < b.rank; });
    if (worst == columns.end() || worst->rank == 0) return;
    columns.erase(worst);
  }
}

}  // namespace

std::optional<RangeStatistics> selection_statistics(const SampleHistory& history,
                                                    StripState& state) {
  if (!state.selection) return std::nullopt;
  const AxisRange range = *state.selection;
  const auto found = std::find_if(state.known.begin(), state.known.end(),
                                  [&](const auto& known) { return known.history == &history; });
  if (found != state.known.end() && found->t0 == range.from && found->t1 == range.to) {
    // New samples change nothing once there was one behind the range.
    const bool same = found->samples == history.samples();
    const bool complete = found->samples < history.samples() && found->latest > range.to;
    if (same || complete) return found->statistics;
  }
  if (found != state.known.end()) state.known.erase(found);
  const auto latest = history.latest();
  state.known.push_back({&history, range.from, range.to, history.samples(),
                         latest ? latest->t1 : 0.0, history.statistics(range.from, range.to)});
  return state.known.back().statistics;
}

void draw_statistics(ImDrawList& list, const PlotRect& area, const StripData& data,
                     StripState& state) {
  if (!state.selection) return;
  std::vector<Row> rows;
  for (const StripSeries& series : data.series) {
    if (series.history == nullptr || state.hidden.contains(series.name)) continue;
    if (const auto known = selection_statistics(*series.history, state)) {
      rows.emplace_back(series.name, *known);
    }
  }
  const AxisRange range = *state.selection;
  const std::string head =
      fmt::format("{} selected, {} .. {}{}", duration_text(range.to - range.from),
                  clock_text(range.from, 2, false), clock_text(range.to, 2, false),
                  rows.empty() ? ": no samples" : "");
  std::vector<Column> columns;
  if (!rows.empty()) columns = columns_of(rows, data);
  const float pad = 0.5F * em();
  drop_until_it_fits(columns, area.width() - 2.0F * em());
  const float width = std::max(total_width(columns), text_width(head) + em()) + pad;
  const float line = 1.2F * em();
  const float height = line * static_cast<float>(rows.empty() ? 1 : rows.size() + 2) + pad;

  // On the side of the area where less of the selection is.
  const double middle = axis_position(state.x, 0.5 * (range.from + range.to));
  const float left = middle < 0.5 ? area.x1 - width - 0.5F * em() : area.x0 + 0.5F * em();
  const float top = area.y0 + 0.5F * em();
  list.AddRectFilled({left, top}, {left + width, top + height},
                     ImGui::GetColorU32(ImGuiCol_PopupBg, 0.94F), 0.3F * em());
  list.AddRect({left, top}, {left + width, top + height}, text_color(0.25F), 0.3F * em());
  float y = top + 0.5F * pad;
  draw_text(list, left + pad, y, text_color(), head);
  float x = left + pad;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Column& column = columns[c];
    // Names stand at the left, numbers at the right of their column.
    const float align = c == 0 ? 0.0F : 1.0F;
    const float at = c == 0 ? x : x + column.width() - em();
    y = top + 0.5F * pad + line;
    draw_text(list, at, y, text_color(0.65F), column.head, align);
    for (const std::string& cell : column.cells) {
      y += line;
      draw_text(list, at, y, text_color(), cell, align);
    }
    x += column.width();
  }
}

}  // namespace encore::ui
