#pragma once

#include "energy/sources/discovery.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace encore::energy {

/// A tree of tests/fixtures/sysfs as it lies there.
inline SensorRoot fixture_root(const std::string& tree) {
  return SensorRoot(std::filesystem::path(ENCORE_FIXTURES) / "sysfs" / tree);
}

/// A copy of such a tree whose files a test may change.
class ChangingTree {
 public:
  explicit ChangingTree(const std::string& tree) {
    std::filesystem::copy(std::filesystem::path(ENCORE_FIXTURES) / "sysfs" / tree, folder_.path(),
                          std::filesystem::copy_options::recursive);
  }
  [[nodiscard]] SensorRoot root() const { return SensorRoot(folder_.path()); }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_.path() / name;
  }
  void set(const std::string& name, const std::string& content) const {
    folder_.write(name, content + '\n');
  }
  void remove(const std::string& name) const { std::filesystem::remove_all(path(name)); }

 private:
  test::TemporaryFolder folder_;
};

inline const Finding& finding_of(const std::vector<Finding>& findings, const std::string& name) {
  for (const Finding& finding : findings) {
    if (finding.info.name == name) return finding;
  }
  throw std::runtime_error("nothing was found of the name " + name);
}

/// The names of what can be used and is not set aside.
inline std::vector<std::string> taken(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  for (const Finding& finding : findings) {
    if (!finding.obstacle && finding.set_aside.empty()) names.push_back(finding.info.name);
  }
  return names;
}

inline bool has_text(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace encore::energy
