#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace encore::test {

/// A folder of its own for each object, so that tests may run side by side; removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    // mkdtemp fills in the last six letters.
    std::string pattern = (std::filesystem::temp_directory_path() / "encore-test-").string();
    pattern.append(6, 'X');
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes the bytes of `content` and returns the file's path; makes the folders on the way.
  std::filesystem::path write(const std::filesystem::path& name, std::string_view content) const {
    std::filesystem::path full = path_ / name;
    std::filesystem::create_directories(full.parent_path());
    std::ofstream(full, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
    return full;
  }

 private:
  std::filesystem::path path_;
};

/// All bytes of a file; none if it cannot be read.
inline std::string contents_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The folder of real models, from ENCORE_MODELS or beside the project; empty if there is none.
inline std::filesystem::path real_models() {
  const char* given = std::getenv("ENCORE_MODELS");
  const std::filesystem::path folder =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(ENCORE_SOURCE_DIR) / ".." / "shared" / "models";
  return std::filesystem::exists(folder / "INDEX.tsv") ? folder : std::filesystem::path();
}

}  // namespace encore::test
