#include "window_test.h"

#include <algorithm>
#include <cstdlib>

namespace encore::test {

void WindowTest::open_display(int width, int height) {
  std::string why;
  display_ = try_virtual_display(width, height, why);
  if (display_) return;
  if (std::getenv("ENCORE_NEED_GL") != nullptr) FAIL() << why;
  GTEST_SKIP() << why;
}

void WindowTest::TearDown() {
  if (HasFailure() && person_) person_->look().keep("failed");
  if (HasFailure() && program_) std::fprintf(stderr, "%s\n", program_->err().c_str());
  person_.reset();
  program_.reset();
  display_.reset();
}

Person& WindowTest::start(std::vector<std::string> arguments, const std::string& size) {
  arguments.insert(arguments.end(), {"--window-size", size});
  person_.reset();
  program_ = std::make_unique<EncoreProcess>(
      EncoreProcess::Setup{display_->name(), std::move(arguments), home_.path(), {}});
  person_ = std::make_unique<Person>(display_->connection(), *program_);
  return *person_;
}

std::vector<std::string> WindowTest::no_sensors() const {
  const std::filesystem::path root = home_.path() / "no-sensors";
  std::filesystem::create_directories(root);
  return {"--sysfs-root", root.string()};
}

std::vector<std::filesystem::path> WindowTest::sessions() const {
  std::vector<std::filesystem::path> found;
  std::error_code none;
  const auto folder = home_.path() / ".local/share/encore/sessions";
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void WindowTest::close() {
  person_->close_window();
  expect_exit(0);
}

void WindowTest::expect_exit(int code) {
  const auto ended = program_->wait(kPatience);
  ASSERT_TRUE(ended) << "it goes on: " << program_->err();
  EXPECT_EQ(*ended, code) << program_->err();
}

}  // namespace encore::test
