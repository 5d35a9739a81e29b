#include "scene/shipped_files.h"

#include <fmt/format.h>
#include <sys/auxv.h>

#include <algorithm>
#include <cctype>
#include <system_error>

namespace encore::scene {
namespace fs = std::filesystem;
namespace {

fs::path running_program() {
  std::error_code error;
  fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) return program;
  // Without /proc the kernel still tells what it was asked to start.
  const auto* started = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  if (started == nullptr) return {};
  program = fs::canonical(started, error);
  return error ? fs::path() : program;
}

bool is_bare_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

}  // namespace

std::vector<fs::path> shipped_folder_candidates(const fs::path& program) {
  std::vector<fs::path> candidates;
  if (program.has_parent_path()) {
    const fs::path folder = program.parent_path();
    for (const char* relative : {ENCORE_SHARE_FROM_BIN, "../share/encore"}) {
      fs::path candidate = (folder / relative).lexically_normal();
      if (candidates.empty() || candidates.back() != candidate) {
        candidates.push_back(std::move(candidate));
      }
    }
  }
  const fs::path installed = fs::path(ENCORE_SHARE_FOLDER).lexically_normal();
  if (std::find(candidates.begin(), candidates.end(), installed) == candidates.end()) {
    candidates.push_back(installed);
  }
  return candidates;
}

fs::path first_folder(std::span<const fs::path> candidates) {
  for (const fs::path& candidate : candidates) {
    std::error_code error;
    if (fs::is_directory(candidate, error)) return candidate;
  }
  return {};
}

fs::path shipped_folder() {
  return first_folder(shipped_folder_candidates(running_program()));
}

fs::path shipped_file(std::string_view kind, std::string_view name) {
  const fs::path folder = shipped_folder();
  if (folder.empty() || !is_bare_name(name)) return {};
  const fs::path file = folder / kind / fmt::format("{}.toml", name);
  std::error_code error;
  return fs::is_regular_file(file, error) ? file : fs::path();
}

std::vector<std::string> shipped_names(std::string_view kind) {
  std::vector<std::string> names;
  const fs::path folder = shipped_folder();
  if (folder.empty()) return names;
  std::error_code error;
  fs::directory_iterator files(folder / kind, error);
  for (; !error && files != fs::directory_iterator(); files.increment(error)) {
    const fs::path& file = files->path();
    if (file.extension() == ".toml") names.push_back(file.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string shipped_files_missing() {
  std::vector<std::string> looked_in;
  for (const fs::path& candidate : shipped_folder_candidates(running_program())) {
    looked_in.push_back(candidate.string());
  }
  return fmt::format(
      "the scenes and studies that ship with encore are missing (looked in {}); install the "
      "program again, or give a file's path",
      fmt::join(looked_in, ", "));
}

}  // namespace encore::scene
