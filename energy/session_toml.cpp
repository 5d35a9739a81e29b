#include "energy/session_toml.h"

#include "energy/toml_depth.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <locale>
#include <sstream>

namespace encore::energy {

namespace {

std::int64_t signed_of(std::uint64_t value) {
  return static_cast<std::int64_t>(value);
}

template <class T>
void insert(toml::table& table, std::string_view key, const std::optional<T>& value) {
  if (!value) return;
  if constexpr (std::is_same_v<T, std::uint64_t>) {
    table.insert(key, signed_of(*value));
  } else {
    table.insert(key, *value);
  }
}

toml::table machine_table(const Machine& machine) {
  toml::table table;
  insert(table, "cpu_model", machine.cpu_model);
  insert(table, "logical_cores", machine.logical_cores);
  insert(table, "physical_cores", machine.physical_cores);
  insert(table, "memory_bytes", machine.memory_bytes);
  insert(table, "operating_system", machine.operating_system);
  insert(table, "kernel", machine.kernel);
  insert(table, "governor", machine.governor);
  insert(table, "virtual_machine", machine.virtual_machine);
  table.insert("compiler", machine.compiler);
  table.insert("build_type", machine.build_type);
  insert(table, "build_id", machine.build_id);
  insert(table, "microcode", machine.microcode);
  insert(table, "cpu_min_mhz", machine.cpu_min_mhz);
  insert(table, "cpu_max_mhz", machine.cpu_max_mhz);
  insert(table, "boost", machine.boost);
  insert(table, "cpu_temperature_c", machine.cpu_temperature_c);
  insert(table, "power_supply", machine.power_supply);
  insert(table, "container", machine.container);
  toml::array gpus;
  for (const std::string& gpu : machine.gpus) gpus.push_back(gpu);
  if (!gpus.empty()) table.insert("gpus", gpus);
  return table;
}

toml::table plan_table(const Plan& plan) {
  toml::table table;
  table.insert("warm_up_s", plan.warm_up.value);
  table.insert("warm_up_operations", signed_of(plan.warm_up_operations));
  table.insert("run_s", plan.run.value);
  table.insert("min_operations", signed_of(plan.min_operations));
  table.insert("max_operations", signed_of(plan.max_operations));
  table.insert("row_s", plan.row.value);
  table.insert("name", plan.name);
  table.insert("idle_before_s", plan.idle_before.value);
  table.insert("idle_after_s", plan.idle_after.value);
  table.insert("cool_down_s", plan.cool_down.value);
  table.insert("mix_s", plan.mix.value);
  table.insert("mix_seed", signed_of(plan.mix_seed));
  if (plan.poll) table.insert("poll_s", plan.poll->value);
  if (plan.cut_below) table.insert("cut_below_watts", plan.cut_below->value);
  table.insert("repeats", signed_of(plan.repeats));
  table.insert("order", to_string(plan.order));
  table.insert("order_seed", signed_of(plan.order_seed));
  if (plan.until) table.insert("until", *plan.until);
  table.insert("until_limit_s", plan.until_limit.value);
  return table;
}

toml::array source_tables(const std::vector<SessionSource>& sources) {
  toml::array tables;
  for (const SessionSource& source : sources) {
    const SourceInfo& info = source.info;
    toml::table table{{"name", info.name},
                      {"kind", to_string(info.kind)},
                      {"domain", to_string(info.domain)},
                      {"unit", info.unit},
                      {"includes", info.includes},
                      {"place", info.place},
                      {"provenance", to_string(info.provenance.origin)},
                      {"detail", info.provenance.detail},
                      {"in_total", source.in_total},
                      {"counter", info.is_counter},
                      {"update_period_s", info.update_period.value},
                      {"poll_period_s", info.poll_period.value},
                      {"gain_uncertainty", info.gain_uncertainty},
                      {"smoothing_s", info.smoothing.value}};
    if (info.energy_step) table.insert("energy_step_joules", info.energy_step->value);
    if (info.power_step) table.insert("power_step_watts", info.power_step->value);
    tables.push_back(std::move(table));
  }
  return tables;
}

/// Looks values up by their dotted name and complains by it.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  template <class T>
  std::optional<T> optional(std::string_view key) const {
    const auto node = table_.at_path(key);
    if (!node) return std::nullopt;
    if constexpr (std::is_same_v<T, std::uint64_t>) {
      const auto value = node.template value<std::int64_t>();
      if (!value || *value < 0) throw wrong(key);
      return static_cast<std::uint64_t>(*value);
    } else {
      auto value = node.template value<T>();
      if (!value) throw wrong(key);
      if constexpr (std::is_same_v<T, double>) {
        if (!std::isfinite(*value)) throw wrong(key);
      }
      return value;
    }
  }
  /// An array of strings; empty if it is not there.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const {
    std::vector<std::string> found;
    const auto node = table_.at_path(key);
    if (!node) return found;
    const toml::array* array = node.as_array();
    if (array == nullptr) throw wrong(key);
    for (const toml::node& text : *array) {
      if (!text.is_string()) throw wrong(key);
      found.push_back(text.value_or(std::string()));
    }
    return found;
  }
  template <class T>
  T required(std::string_view key) const {
    auto value = optional<T>(key);
    if (!value) throw SessionError(fmt::format("{}: {} is missing", file_, key));
    return *value;
  }
  [[nodiscard]] SessionError wrong(std::string_view key) const {
    return SessionError(fmt::format("{}: {} has a wrong value", file_, key));
  }

 private:
  const toml::table& table_;
  std::string file_;
};

Machine machine_from(const TableReader& read) {
  Machine machine;
  machine.cpu_model = read.optional<std::string>("machine.cpu_model");
  machine.logical_cores = read.optional<std::uint64_t>("machine.logical_cores");
  machine.physical_cores = read.optional<std::uint64_t>("machine.physical_cores");
  machine.memory_bytes = read.optional<std::uint64_t>("machine.memory_bytes");
  machine.operating_system = read.optional<std::string>("machine.operating_system");
  machine.kernel = read.optional<std::string>("machine.kernel");
  machine.governor = read.optional<std::string>("machine.governor");
  machine.virtual_machine = read.optional<bool>("machine.virtual_machine");
  machine.compiler = read.required<std::string>("machine.compiler");
  machine.build_type = read.required<std::string>("machine.build_type");
  machine.build_id = read.optional<std::string>("machine.build_id");
  machine.microcode = read.optional<std::string>("machine.microcode");
  machine.cpu_min_mhz = read.optional<double>("machine.cpu_min_mhz");
  machine.cpu_max_mhz = read.optional<double>("machine.cpu_max_mhz");
  machine.boost = read.optional<bool>("machine.boost");
  machine.cpu_temperature_c = read.optional<double>("machine.cpu_temperature_c");
  machine.power_supply = read.optional<std::string>("machine.power_supply");
  machine.container = read.optional<std::string>("machine.container");
  machine.gpus = read.texts("machine.gpus");
  return machine;
}

Plan plan_from(const TableReader& read) {
  // All 64 bits of a seed count, and TOML's integers are signed.
  const auto seed = [&](std::string_view key) {
    return static_cast<std::uint64_t>(read.required<std::int64_t>(key));
  };
  Plan plan;
  plan.warm_up = Seconds(read.required<double>("plan.warm_up_s"));
  plan.warm_up_operations = read.required<std::uint64_t>("plan.warm_up_operations");
  plan.run = Seconds(read.required<double>("plan.run_s"));
  plan.min_operations = read.required<std::uint64_t>("plan.min_operations");
  plan.max_operations = read.required<std::uint64_t>("plan.max_operations");
  plan.row = Seconds(read.required<double>("plan.row_s"));
  plan.name = read.required<std::string>("plan.name");
  plan.idle_before = Seconds(read.required<double>("plan.idle_before_s"));
  plan.idle_after = Seconds(read.required<double>("plan.idle_after_s"));
  plan.cool_down = Seconds(read.required<double>("plan.cool_down_s"));
  plan.mix = Seconds(read.required<double>("plan.mix_s"));
  plan.mix_seed = seed("plan.mix_seed");
  if (const auto poll = read.optional<double>("plan.poll_s")) plan.poll = Seconds(*poll);
  if (const auto cut = read.optional<double>("plan.cut_below_watts")) plan.cut_below = Watts(*cut);
  const auto repeats = read.required<std::uint64_t>("plan.repeats");
  if (repeats > std::numeric_limits<std::uint32_t>::max()) throw read.wrong("plan.repeats");
  plan.repeats = static_cast<std::uint32_t>(repeats);
  const auto order = parse_order(read.required<std::string>("plan.order"));
  if (!order) throw read.wrong("plan.order");
  plan.order = *order;
  plan.order_seed = seed("plan.order_seed");
  plan.until = read.optional<double>("plan.until");
  plan.until_limit = Seconds(read.required<double>("plan.until_limit_s"));
  return plan;
}

std::vector<SessionSource> sources_from(const toml::table& table, const std::string& file) {
  std::vector<SessionSource> sources;
  const toml::array* tables = table["source"].as_array();
  if (tables == nullptr) return sources;
  for (const toml::node& node : *tables) {
    const toml::table* entry = node.as_table();
    if (entry == nullptr) throw SessionError(file + ": source has a wrong value");
    const TableReader read(*entry, file + ", source");
    SessionSource source;
    SourceInfo& info = source.info;
    info.name = read.required<std::string>("name");
    const auto kind = parse_source_kind(read.required<std::string>("kind"));
    if (!kind) throw read.wrong("kind");
    info.kind = *kind;
    const auto domain = parse_domain(read.required<std::string>("domain"));
    if (!domain) throw read.wrong("domain");
    info.domain = *domain;
    info.unit = read.required<std::string>("unit");
    info.includes = read.required<std::string>("includes");
    info.place = read.required<std::string>("place");
    const auto origin = parse_origin(read.required<std::string>("provenance"));
    if (!origin) throw read.wrong("provenance");
    info.provenance = {*origin, read.required<std::string>("detail")};
    source.in_total = read.required<bool>("in_total");
    info.is_counter = read.required<bool>("counter");
    info.update_period = Seconds(read.required<double>("update_period_s"));
    info.poll_period = Seconds(read.required<double>("poll_period_s"));
    info.gain_uncertainty = read.required<double>("gain_uncertainty");
    info.smoothing = Seconds(read.required<double>("smoothing_s"));
    if (const auto step = read.optional<double>("energy_step_joules")) {
      info.energy_step = Joules(*step);
    }
    if (const auto step = read.optional<double>("power_step_watts")) info.power_step = Watts(*step);
    sources.push_back(std::move(source));
  }
  return sources;
}

toml::table parse_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!(file && text << file.rdbuf())) throw SessionError("cannot read " + path.string());
  if (const auto line = line_of_deep_key(text.view())) {
    throw SessionError(
        fmt::format("{}:{}: a key of more than {} parts", path.string(), *line, kMostKeyParts));
  }
  try {
    return toml::parse(text.view());
  } catch (const toml::parse_error& error) {
    throw SessionError(
        fmt::format("{}:{}: {}", path.string(), error.source().begin.line, error.description()));
  }
}

}  // namespace

void write_session_toml(const std::filesystem::path& path, const SessionInfo& info) {
  toml::array scenes;
  for (const std::string& scene : info.scenes) scenes.push_back(scene);
  // An array of pairs keeps the order, which a table would not.
  toml::array settings;
  for (const KeyValue& setting : info.settings) {
    settings.push_back(toml::table{{"key", setting.key}, {"value", setting.value}});
  }
  toml::table table{
      {"program", info.program},
      {"command_line", info.command_line},
      {"started_utc", info.started_utc},
      {"state", to_string(info.state)},
      {"scenes", scenes},
      {"machine", machine_table(info.machine)},
      {"plan", plan_table(info.plan)},
      {"sensor",
       toml::table{{"provenance", to_string(info.sensor.origin)}, {"detail", info.sensor.detail}}},
      {"setting", settings},
  };

  if (!info.sources.empty()) table.insert("source", source_tables(info.sources));

  // Write beside, then rename: whoever reads sees the old file or the new one.
  const std::filesystem::path beside = path.string() + ".new";
  const auto fail = [&] {
    throw SessionError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  };
  std::ofstream file(beside, std::ios::binary);
  file.imbue(std::locale::classic());
  if (!file) fail();
  file << table << '\n';
  file.close();
  if (!file) fail();
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) {
    throw SessionError(fmt::format("cannot write {}: {}", path.string(), error.message()));
  }
}

SessionInfo read_session_toml(const std::filesystem::path& path) {
  const toml::table table = parse_file(path);
  const TableReader read(table, path.string());
  SessionInfo info;
  info.program = read.required<std::string>("program");
  info.command_line = read.required<std::string>("command_line");
  info.started_utc = read.required<std::string>("started_utc");
  const auto state = parse_session_state(read.required<std::string>("state"));
  if (!state) throw read.wrong("state");
  info.state = *state;
  info.machine = machine_from(read);
  info.plan = plan_from(read);
  const auto origin = parse_origin(read.required<std::string>("sensor.provenance"));
  if (!origin) throw read.wrong("sensor.provenance");
  info.sensor = {*origin, read.required<std::string>("sensor.detail")};
  info.sources = sources_from(table, path.string());
  if (const toml::array* scenes = table["scenes"].as_array()) {
    for (const toml::node& scene : *scenes) info.scenes.push_back(scene.value_or(std::string()));
  }
  if (const toml::array* settings = table["setting"].as_array()) {
    for (const toml::node& node : *settings) {
      const toml::table* pair = node.as_table();
      if (pair == nullptr) throw read.wrong("setting");
      info.settings.push_back(
          {(*pair)["key"].value_or(std::string()), (*pair)["value"].value_or(std::string())});
    }
  }
  return info;
}

}  // namespace encore::energy
