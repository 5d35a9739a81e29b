#include "app/window/export.h"

#include "energy/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace encore::app {

namespace {

namespace fs = std::filesystem;
using energy::SessionError;

/// What a session folder holds, in the order of names; session.toml last, so that a copy without
/// it is no session.
std::vector<fs::path> files_of(const fs::path& from) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(from, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string kind = entry->path().extension().string();
    std::error_code unknown;
    const bool ours = kind == ".csv" || kind == ".toml";
    if (ours && entry->is_regular_file(unknown)) files.push_back(entry->path().filename());
  }
  if (error) {
    throw SessionError(fmt::format("cannot read {}: {}", from.string(), error.message()));
  }
  if (std::find(files.begin(), files.end(), fs::path("session.toml")) == files.end()) {
    throw SessionError(
        fmt::format("{} is no session: it has no session.toml; nothing was copied", from.string()));
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const bool a_last = a == "session.toml";
    const bool b_last = b == "session.toml";
    return a_last != b_last ? b_last : a < b;
  });
  return files;
}

void check_target(const fs::path& to) {
  std::error_code error;
  const fs::file_status status = fs::status(to, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status) || !fs::is_empty(to, error)) {
    throw SessionError(fmt::format(
        "{} exists already and is not overwritten; choose a new name or an empty folder",
        to.string()));
  }
}

/// Copies one file a stretch at a time, so that it can be stopped; the bytes.
std::uint64_t copy_file(const fs::path& from, const fs::path& to, TaskControl& control) {
  std::ifstream in(from, std::ios::binary);
  std::ofstream out(to, std::ios::binary | std::ios::trunc);
  if (!in) throw SessionError("cannot read " + from.string());
  std::uint64_t bytes = 0;
  std::vector<char> stretch(1U << 20U);
  while (in && out) {
    if (control.stop) throw SessionError("copying was cancelled");
    in.read(stretch.data(), static_cast<std::streamsize>(stretch.size()));
    out.write(stretch.data(), in.gcount());
    bytes += static_cast<std::uint64_t>(in.gcount());
  }
  out.close();
  if (in.bad()) throw SessionError("cannot read " + from.string());
  if (!out) throw SessionError("cannot write " + to.string() + ": the disk may be full");
  return bytes;
}

}  // namespace

ExportResult export_session(const fs::path& from, const fs::path& to, TaskControl& control) {
  const std::vector<fs::path> files = files_of(from);
  check_target(to);
  fs::path partial = to;
  if (!partial.has_filename()) partial = partial.parent_path();
  const fs::path target = partial;
  partial += ".partial";
  std::error_code error;
  if (!fs::create_directories(partial, error)) {
    throw SessionError(fmt::format(
        "cannot make the folder {}: {}", partial.string(),
        error ? error.message() : "it exists already; remove it if no copy is being made"));
  }
  ExportResult result{target, 0, 0};
  try {
    for (const fs::path& file : files) {
      result.bytes += copy_file(from / file, partial / file, control);
      ++result.files;
      control.progress = static_cast<double>(result.files) / static_cast<double>(files.size());
    }
    // Replaces an empty folder, and nothing else.
    fs::rename(partial, target, error);
    if (error) {
      throw SessionError(
          fmt::format("cannot name the copy {}: {}", target.string(), error.message()));
    }
  } catch (...) {
    fs::remove_all(partial, error);
    throw;
  }
  return result;
}

}  // namespace encore::app
