#pragma once

#include "energy/sources/sensor_root.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace encore::energy {

/// Reads the file of an absolute path below a root. Tests pass their own for what no file on a disk
/// can do: answer ENODATA or ENODEV, or not answer at all.
using FileReader = std::function<FileText(std::string_view absolute)>;

/// The files below a sensor root, read through a replaceable reader.
class SensorFiles {
 public:
  explicit SensorFiles(SensorRoot root, FileReader reader = {})
      : root_(std::move(root)), reader_(std::move(reader)) {}

  [[nodiscard]] const SensorRoot& root() const { return root_; }
  [[nodiscard]] std::vector<std::string> list(std::string_view absolute) const {
    return root_.list(absolute);
  }
  [[nodiscard]] FileText read(std::string_view absolute) const {
    return reader_ ? reader_(absolute) : root_.read(absolute);
  }
  [[nodiscard]] std::optional<std::string> text(std::string_view absolute) const {
    return read(absolute).text;
  }
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view absolute) const {
    const auto content = text(absolute);
    return content ? parse_integer(*content) : std::nullopt;
  }
  /// "/sys/...: permission denied (mode 0400, owner root)".
  [[nodiscard]] std::string describe(std::string_view absolute, int error) const {
    return std::string(absolute) + ": " + describe_error(root_.resolve(absolute), error);
  }

 private:
  SensorRoot root_;
  FileReader reader_;
};

}  // namespace encore::energy
