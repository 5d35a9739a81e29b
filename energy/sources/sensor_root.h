#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// A small file's content, or why it could not be read.
struct FileText {
  std::optional<std::string> text;  ///< without white space at the end
  int error = 0;                    ///< errno of the failure: ENOENT, EACCES, ENODATA, ENODEV ...
};

/// The folder that stands for "/" when sensors are looked for: "/" itself, a fixture tree in
/// tests, or a copy of another machine's tree (`--sysfs-root`). Every path of a sensor is resolved
/// through it, so that no test depends on the machine it runs on.
class SensorRoot {
 public:
  explicit SensorRoot(std::filesystem::path root = "/") : root_(std::move(root)) {}

  [[nodiscard]] bool is_real() const { return root_ == "/"; }
  /// `absolute` begins with '/': "/sys/class/hwmon".
  [[nodiscard]] std::filesystem::path resolve(std::string_view absolute) const;
  /// A path below the root as the user knows it: without the root.
  [[nodiscard]] std::string shown(const std::filesystem::path& resolved) const;
  /// Names in a folder, sorted in natural order (hwmon2 before hwmon10); empty if it is not there.
  [[nodiscard]] std::vector<std::string> list(std::string_view absolute) const;
  [[nodiscard]] FileText read(std::string_view absolute) const;

 private:
  std::filesystem::path root_;
};

/// Reads a file as sysfs files are read: one open, one read from its start. At most 64 KiB.
FileText read_small_file(const std::filesystem::path& path);

/// Whole numbers as sysfs writes them, with nothing behind; nothing if it is not one or too large.
std::optional<std::int64_t> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// "permission denied (mode 0400, owner root)" for EACCES with what stat tells, else strerror.
std::string describe_error(const std::filesystem::path& path, int error);

}  // namespace encore::energy
