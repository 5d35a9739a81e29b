#include "energy/session_toml.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <locale>

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
  return table;
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
      return value;
    }
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
  return machine;
}

Plan plan_from(const TableReader& read) {
  Plan plan;
  plan.warm_up = Seconds(read.required<double>("plan.warm_up_s"));
  plan.warm_up_operations = read.required<std::uint64_t>("plan.warm_up_operations");
  plan.run = Seconds(read.required<double>("plan.run_s"));
  plan.min_operations = read.required<std::uint64_t>("plan.min_operations");
  plan.max_operations = read.required<std::uint64_t>("plan.max_operations");
  plan.row = Seconds(read.required<double>("plan.row_s"));
  return plan;
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
  const toml::table table{
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
  toml::table table;
  try {
    table = toml::parse_file(path.string());
  } catch (const toml::parse_error& error) {
    throw SessionError(
        fmt::format("{}:{}: {}", path.string(), error.source().begin.line, error.description()));
  }
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
