#include "app/profile_folder.h"

#include "app/exit_code.h"
#include "app/xdg_folders.h"
#include "energy/session.h"

#include <fmt/format.h>

#include <ctime>

namespace encore::app {

namespace {

namespace fs = std::filesystem;

fs::path sessions_home() {
  if (const auto home = data_home()) return *home / "encore" / "sessions";
  throw UsageError("there is no home folder to keep sessions in; name one with --out");
}

/// Letters, digits, dots, dashes and underscores stay, everything else becomes a dash.
std::string safe_name(std::string name) {
  for (char& c : name) {
    const bool safe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '.' || c == '-' || c == '_';
    if (!safe) c = '-';
  }
  return name.substr(0, 80);
}

energy::SessionError cannot_make(const fs::path& folder, const std::error_code& error) {
  return energy::SessionError(
      fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

fs::path wanted_folder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status)) {
      throw UsageError(fmt::format("--out {} is a file, not a folder", folder.string()));
    }
    const bool empty = fs::is_empty(folder, error);
    if (error) throw cannot_make(folder, error);
    if (!empty) {
      throw UsageError(fmt::format(
          "--out {} is not empty; nothing is overwritten, name a new folder", folder.string()));
    }
    return folder;
  }
  fs::create_directories(folder, error);
  if (error) throw cannot_make(folder, error);
  return folder;
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

fs::path make_session_folder(const std::string& wanted, const std::string& started_utc,
                             const std::string& scene) {
  if (!wanted.empty()) return wanted_folder(wanted);

  const fs::path parent = sessions_home();
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) throw cannot_make(parent, error);
  // "20260131T235959Z": no colons, which some file systems refuse.
  std::string stamp = started_utc;
  std::erase_if(stamp, [](char c) { return c == '-' || c == ':'; });
  const std::string name = stamp + "-" + safe_name(scene);

  // create_directory tells whether it was us, so that two runs in one second do not share one.
  for (int copy = 1;; ++copy) {
    fs::path folder = parent / (copy == 1 ? name : fmt::format("{}-{}", name, copy));
    if (fs::create_directory(folder, error)) return folder;
    if (error) throw cannot_make(folder, error);
  }
}

}  // namespace encore::app
