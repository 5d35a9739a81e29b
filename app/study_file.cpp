#include "app/study_file.h"

#include "app/device.h"
#include "app/exit_code.h"
#include "energy/battery_life/battery_toml.h"
#include "scene/ray_settings.h"
#include "scene/shipped_files.h"
#include "scene/text_suggestion.h"
#include "scene/toml_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <sstream>
#include <system_error>
#include <utility>

namespace encore::app {

namespace {

using scene::InputError;
using scene::TomlTable;

/// FNV-1a: tells whether two texts are the same, not who wrote them.
std::string digest_of(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("{:016x}", hash);
}

/// A problem with a word, or nothing.
using Check = std::function<std::string(const std::string&)>;

template <class Parse>
Check known_word(const std::string& what, const std::vector<std::string_view>& names, Parse parse) {
  return [=](const std::string& word) {
    if (parse(word)) return std::string();
    return fmt::format("unknown {} '{}'{}; there are {}", what, word,
                       scene::did_you_mean(word, names), fmt::join(names, ", "));
  };
}

Check structure_names() {
  std::vector<std::string_view> names{"all"};
  for (const auto kind : accel::all_structure_kinds()) names.push_back(accel::to_string(kind));
  return known_word("structure", names, [](const std::string& word) {
    return word == "all" || accel::parse_structure_kind(word).has_value();
  });
}

Check device_names() {
  std::vector<std::string_view> names;
  for (const Device device : all_devices()) names.push_back(to_string(device));
  return known_word("device", names,
                    [](const std::string& word) { return parse_device(word).has_value(); });
}

Check one_of(const std::string& what, const std::vector<std::string_view>& names) {
  return known_word(what, names, [names](const std::string& word) {
    return std::find(names.begin(), names.end(), word) != names.end();
  });
}

std::string size_problem(const std::string& text) {
  try {
    (void)parse_size(text);
    return {};
  } catch (const UsageError& error) {
    return error.what();
  }
}

std::string setting_problem(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return fmt::format("'{}' is not key=value", text);
  const std::string_view key = std::string_view(text).substr(0, equals);
  std::string problem;
  for (const auto kind : accel::all_structure_kinds()) {
    accel::StructureSpec spec = accel::default_spec(kind);
    problem = accel::apply_setting(spec, key, std::string_view(text).substr(equals + 1));
    if (!problem.empty()) break;
  }
  if (problem.starts_with("unknown")) problem += scene::did_you_mean(key, accel::setting_keys());
  return problem;
}

Check ray_setting(std::string_view key) {
  return [key](const std::string& word) {
    scene::RaySettings rays;
    return scene::apply_ray_setting(rays, key, word);
  };
}

/// A list of words (numbers are words, too), or a single one; each must pass the check.
std::vector<std::string> words(TomlTable& table, std::string_view key, const Check& check,
                               std::vector<std::string> otherwise = {}) {
  if (!table.has(key)) return otherwise;
  std::vector<std::string> found;
  const auto take = [&](const toml::node& node) {
    std::string word;
    if (const auto number = node.value_exact<std::int64_t>()) {
      word = std::to_string(*number);
    } else if (const auto text = node.value_exact<std::string>()) {
      word = *text;
    } else {
      throw InputError(fmt::format("{}: {} holds {}, not a word", table.place_of(node), key,
                                   scene::kind_of(node)));
    }
    const std::string problem = check(word);
    if (!problem.empty()) throw InputError(fmt::format("{}: {}", table.place_of(node), problem));
    found.push_back(std::move(word));
  };
  const toml::node& node = *table.raw().get(key);
  if (const toml::array* list = node.as_array()) {
    for (const toml::node& entry : *list) take(entry);
  } else {
    take(node);
  }
  if (found.empty()) table.fail(key, fmt::format("{} is empty", key));
  return found;
}

std::string anything(const std::string&) {
  return {};
}

/// Like warn_about_unknown_keys, but as an error.
void refuse_unknown_keys(const TomlTable& table) {
  scene::Warnings warnings;
  table.warn_about_unknown_keys(warnings);
  if (warnings.messages.empty()) return;
  std::string message = warnings.messages.front();
  const std::string_view ignored = " is ignored";
  if (const auto at = message.find(ignored); at != std::string::npos) {
    message.erase(at, ignored.size());
  }
  throw InputError(message);
}

std::optional<double> seconds(TomlTable& table, std::string_view key) {
  if (const auto value = table.number(key, scene::kNotNegative)) {
    return static_cast<double>(*value);
  }
  return std::nullopt;
}

std::optional<std::uint64_t> whole(TomlTable& table, std::string_view key, std::uint64_t least) {
  if (!table.has(key)) return std::nullopt;
  const auto value = table.raw().get(key)->value_exact<std::int64_t>();
  if (!value || *value < static_cast<std::int64_t>(least)) {
    table.fail(key, fmt::format("{} is not a whole number from {}", key, least));
  }
  return static_cast<std::uint64_t>(*value);
}

void read_plan(TomlTable& table, MeasuringOptions& options) {
  const auto plans = one_of("plan", {std::begin(energy::kPlanNames), std::end(energy::kPlanNames)});
  options.plan = words(table, "name", plans, {""}).front();
  options.seconds = seconds(table, "seconds");
  options.idle = seconds(table, "idle_s");
  options.warm_up = seconds(table, "warm_up_s");
  options.mix = seconds(table, "mix_s");
  options.cool_down = seconds(table, "cool_down_s");
  options.poll = seconds(table, "poll_s");
  if (options.poll && *options.poll < 0.001) table.fail("poll_s", "poll_s is below 0.001");
  if (const auto watts = seconds(table, "cut_below_watts")) options.cut = fmt::format("{}", *watts);
  if (const auto until = table.text("until")) {
    try {
      (void)parse_share(*until, "until");
    } catch (const UsageError& error) {
      table.fail("until", error.what());
    }
    options.until = *until;
  }
  options.until_limit = seconds(table, "until_limit_s");
  if (const auto repeats = whole(table, "repeats", 1)) {
    options.repeats = static_cast<std::uint32_t>(std::min<std::uint64_t>(*repeats, 10000));
  }
  options.order =
      words(table, "order", one_of("order", {"listed", "abba", "shuffled"}), {""}).front();
  options.seed = whole(table, "seed", 0);
  refuse_unknown_keys(table);
}

StudyGroup read_group(TomlTable& table) {
  StudyGroup group;
  group.place = table.place();
  group.name = table.text("name").value_or("");
  if (group.name.empty()) table.fail("name", "a group needs a name");
  group.devices = words(table, "device", device_names(), {"cpu"});
  group.scenes = words(table, "scenes", anything);
  if (group.scenes.empty()) table.fail("scenes", "a group needs scenes");
  group.structures = words(table, "structures", structure_names(), {"all"});
  group.policies =
      words(table, "policies", one_of("policy", {"rebuild", "refit", "auto", "static"}));
  group.tests = words(table, "tests", one_of("test", {"build", "static", "dynamic", "forced"}));
  group.sizes = words(table, "sizes", size_problem, {"256"});
  group.memory = words(table, "memory", one_of("memory mode", {"pool", "malloc"}), {"pool"});
  group.update_cases = words(table, "update_cases",
                             one_of("update case", {"real", "best", "average", "worst"}), {""});
  group.settings = words(table, "set", setting_problem);
  std::vector<std::string_view> modes;
  for (const auto mode : accel::all_intersection_modes()) modes.push_back(accel::to_string(mode));
  group.intersections = words(table, "intersections", one_of("intersection mode", modes));
  group.presets = words(table, "presets", one_of("preset", {"fast", "balanced", "best"}));
  group.groupings = words(table, "groupings", one_of("ray grouping", {"packets", "single"}));
  group.build_on =
      words(table, "build_on", one_of("place", {"auto", "cpu", "device"}), {"auto"}).front();
  group.rays = words(table, "rays", ray_setting("rays"), {""});
  group.samples = words(table, "samples", ray_setting("samples"), {""});
  group.depth = words(table, "depth", ray_setting("depth"), {""}).front();
  constexpr std::uint64_t kMostThreads = std::numeric_limits<int>::max();
  group.threads = static_cast<int>(std::min(whole(table, "threads", 0).value_or(0), kMostThreads));
  refuse_unknown_keys(table);
  return group;
}

}  // namespace

Study parse_study(std::string_view text, const std::string& file) {
  const toml::table parsed = scene::parse_toml(text, file);
  TomlTable root(parsed, "", file);
  Study study;
  study.file = file;
  study.digest = digest_of(text);
  study.name = root.text("name").value_or(std::filesystem::path(file).stem().string());
  if (auto plan = root.table("plan")) read_plan(*plan, study.measuring);
  study.measuring.sources = words(root, "source", anything);
  study.measuring.model = root.text("model").value_or("");
  if (root.has("battery")) {
    try {
      (void)energy::parse_battery_toml(text, file);
    } catch (const energy::BatteryError& error) {
      throw InputError(error.what());
    }
  }
  study.search_path = words(root, "search_path", anything);
  // Relative to the study, so that it means the same wherever it is started from.
  const std::filesystem::path home = std::filesystem::path(file).parent_path();
  for (std::string& folder : study.search_path) folder = (home / folder).string();
  for (TomlTable& table : root.tables("group")) study.groups.push_back(read_group(table));
  if (study.groups.empty()) {
    throw InputError(fmt::format("{}: a study needs at least one [[group]]", file));
  }
  refuse_unknown_keys(root);
  return study;
}

std::filesystem::path find_study(const std::string& name_or_path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(name_or_path, error)) return name_or_path;
  std::filesystem::path shipped = scene::shipped_file("studies", name_or_path);
  if (!shipped.empty()) return shipped;
  const std::vector<std::string> names = scene::shipped_names("studies");
  if (names.empty()) {
    throw InputError(fmt::format("cannot read the study {}: there is no such file; {}",
                                 name_or_path, scene::shipped_files_missing()));
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  throw InputError(fmt::format(
      "cannot read the study {}: there is no such file{} (the studies that ship: {})", name_or_path,
      scene::did_you_mean(name_or_path, candidates), fmt::join(names, ", ")));
}

Study read_study(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!(in && text << in.rdbuf())) {
    throw InputError(fmt::format("cannot read the study {}", file.string()));
  }
  return parse_study(text.str(), file.string());
}

}  // namespace encore::app
