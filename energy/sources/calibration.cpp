#include "energy/sources/calibration.h"

#include "energy/toml_depth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <locale>
#include <sstream>
#include <vector>

namespace encore::energy {

namespace {

constexpr std::int64_t kFormat = 1;
constexpr std::size_t kLargestFile = 16 * 1024;

constexpr std::string_view kHeader =
    "# Power calibration: what one machine draws, in watts (W).\n"
    "# idle_W: while nothing runs. [above_idle]: what each phase adds while it runs, gpu_W a busy\n"
    "# GPU; a phase that is left out has unknown power. relative_uncertainty: standard\n"
    "# uncertainty, 0.03 is 3 %.\n";

std::string place(const std::string& file, const toml::source_region& source) {
  const toml::source_position at = source.begin;
  // Tables that dotted keys imply have no place of their own; the parser then says line 0.
  return at.line == 0 ? file : fmt::format("{}:{}:{}", file, at.line, at.column);
}

/// One table; complains by place.
class Reader {
 public:
  Reader(const toml::table& table, const std::string& file) : table_(table), file_(file) {}

  [[noreturn]] void fail(const toml::node& node, const std::string& message) const {
    throw PowerModelError(fmt::format("{}: {}", place(file_, node.source()), message));
  }
  std::optional<double> number(std::string_view key, double max) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value<double>();
    if (!node->is_number() || !value || !(*value >= 0.0 && *value <= max)) {
      fail(*node, fmt::format("{} must be a number from 0 to {}", key, max));
    }
    return value;
  }
  std::string text(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return {};
    const auto value = node->value<std::string>();
    if (!node->is_string() || !value) fail(*node, fmt::format("{} must be a text in quotes", key));
    return *value;
  }
  const toml::table* table(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) fail(*node, fmt::format("{} must be a table: [{}]", key, key));
    return node->as_table();
  }
  void check_format() {
    const toml::node* node = find("format");
    if (node == nullptr) {
      throw PowerModelError(
          fmt::format("{}: format = {} is missing: is this a calibration file?", file_, kFormat));
    }
    if (!node->is_integer() || node->value<std::int64_t>() != kFormat) {
      fail(*node, fmt::format("format must be {}: this version reads no other", kFormat));
    }
  }
  void refuse_unknown_keys() const {
    for (const auto& [key, node] : table_) {
      if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
      throw PowerModelError(fmt::format("{}: unknown key '{}'; known are {}",
                                        place(file_, key.source()), key.str(),
                                        fmt::join(known_, ", ")));
    }
  }

 private:
  const toml::node* find(std::string_view key) {
    known_.push_back(key);
    return table_.get(key);
  }

  const toml::table& table_;
  const std::string& file_;
  std::vector<std::string_view> known_;
};

/// "build_W" and so on, in the order of kPhases.
constexpr std::array<std::string_view, kPhaseCount> kPhaseKeys = {
    "animate_W", "build_W", "update_W", "transfer_W", "render_W"};

std::string story(const Calibration& calibration, const std::string& file) {
  std::string words = fmt::format("calibration {}", file);
  for (const std::string* part :
       {&calibration.machine, &calibration.measured_utc, &calibration.method}) {
    if (!part->empty()) words += fmt::format(", {}", *part);
  }
  return words;
}

toml::table to_table(const Calibration& calibration) {
  const PowerModel& model = calibration.model;
  toml::table above;
  for (const Phase phase : kPhases) {
    if (!model.delta[phase]) continue;
    above.insert(kPhaseKeys[static_cast<std::size_t>(phase)], model.delta[phase]->value);
  }
  if (model.gpu) above.insert("gpu_W", model.gpu->value);
  toml::table table{{"format", kFormat}, {"idle_W", model.idle.value}, {"above_idle", above}};
  if (model.uncertainty) table.insert("relative_uncertainty", *model.uncertainty);
  if (!calibration.machine.empty()) table.insert("machine", calibration.machine);
  if (!calibration.measured_utc.empty()) table.insert("measured_utc", calibration.measured_utc);
  if (!calibration.method.empty()) table.insert("method", calibration.method);
  return table;
}

}  // namespace

Calibration parse_calibration(std::string_view text, const std::string& file) {
  if (text.size() > kLargestFile) {
    throw PowerModelError(
        fmt::format("{}: larger than {} bytes: this is no calibration file", file, kLargestFile));
  }
  if (const auto line = line_of_deep_key(text)) {
    throw PowerModelError(
        fmt::format("{}:{}: a key of more than {} parts", file, *line, kMostKeyParts));
  }
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw PowerModelError(fmt::format("{}: {}", place(file, error.source()), error.description()));
  }
  Calibration calibration;
  PowerModel& model = calibration.model;
  Reader top(root, file);
  top.check_format();
  const auto idle = top.number("idle_W", kLargestModelPower);
  model.uncertainty = top.number("relative_uncertainty", 1.0);
  calibration.machine = top.text("machine");
  calibration.measured_utc = top.text("measured_utc");
  calibration.method = top.text("method");
  if (const toml::table* table = top.table("above_idle")) {
    Reader above(*table, file);
    for (const Phase phase : kPhases) {
      const auto watts =
          above.number(kPhaseKeys[static_cast<std::size_t>(phase)], kLargestModelPower);
      if (watts) model.delta[phase] = Watts(*watts);
    }
    if (const auto watts = above.number("gpu_W", kLargestModelPower)) model.gpu = Watts(*watts);
    above.refuse_unknown_keys();
  }
  top.refuse_unknown_keys();
  if (!idle) {
    throw PowerModelError(fmt::format(
        "{}: idle_W is missing: the watts that the machine draws while nothing runs", file));
  }
  model.idle = Watts(*idle);
  model.detail = story(calibration, file);
  try {
    check(model);
  } catch (const PowerModelError&) {
    throw PowerModelError(fmt::format(
        "{}: [above_idle] holds no power; add build_W, render_W or another phase", file));
  }
  return calibration;
}

Calibration read_calibration(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  // A folder opens but does not read, and then nothing arrives.
  if (!file || text.view().empty()) {
    std::error_code ignored;
    const bool is_empty = std::filesystem::is_regular_file(path, ignored) &&
                          std::filesystem::file_size(path, ignored) == 0;
    if (is_empty) return parse_calibration("", path.string());
    const bool folder = std::filesystem::is_directory(path, ignored);
    throw PowerModelError(fmt::format("cannot read {}: {}", path.string(),
                                      folder ? "it is a folder" : std::strerror(errno)));
  }
  return parse_calibration(text.view(), path.string());
}

void write_calibration(const std::filesystem::path& path, const Calibration& calibration) {
  check(calibration.model);
  const std::filesystem::path beside = path.string() + ".new";
  const auto fail = [&] {
    throw PowerModelError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  };
  std::ofstream file(beside, std::ios::binary);
  file.imbue(std::locale::classic());
  if (!file) fail();
  file << kHeader << to_table(calibration) << '\n';
  file.close();
  if (!file) fail();
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) {
    throw PowerModelError(fmt::format("cannot write {}: {}", path.string(), error.message()));
  }
}

}  // namespace encore::energy
