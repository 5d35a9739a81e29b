#include "ui/panels/change_text.h"

#include <fmt/format.h>

namespace encore::ui {

namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : std::string();
}

}  // namespace

std::string change_text(const std::optional<double>& percent, const std::optional<double>& low,
                        const std::optional<double>& high) {
  if (!percent) return "unavailable";
  if (!low || !high) return fmt::format("{:+.1f} %, no interval", *percent);
  return fmt::format("{:+.1f} % ({:+.1f} .. {:+.1f})", *percent, *low, *high);
}

std::string verdict_text(const std::string& verdict) {
  if (verdict == "noise") return "no difference beyond noise";
  if (verdict == "unknown") return "not known: too few repeats";
  return verdict;
}

std::string changes_csv(const std::vector<ChangeView>& changes) {
  std::string csv =
      "configuration,a_s,b_s,time_percent,time_low_percent,time_high_percent,time_verdict,"
      "a_J,b_J,joules_percent,joules_low_percent,joules_high_percent,joules_verdict\n";
  for (const ChangeView& change : changes) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", quoted(change.label),
                       cell(change.a_s), cell(change.b_s), cell(change.time_percent),
                       cell(change.time_low), cell(change.time_high), quoted(change.time_verdict),
                       cell(change.a_joules), cell(change.b_joules), cell(change.joules_percent),
                       cell(change.joules_low), cell(change.joules_high),
                       quoted(change.joules_verdict));
  }
  return csv;
}

}  // namespace encore::ui
