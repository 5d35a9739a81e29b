#pragma once

#include "encore_process.h"
#include "eventually.h"
#include "person.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"
#include "virtual_display.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace encore::test {

/// Tests that use the program as a person does, on a virtual display. They are skipped, aloud,
/// where there is no Xvfb; with ENCORE_NEED_GL set they fail instead.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override { open_display(1280, 800); }
  void TearDown() override;

  void open_display(int width, int height);
  /// Starts the program in the same home as before; the arguments come after --window-size.
  Person& start(std::vector<std::string> arguments = {}, const std::string& size = "1280x800");
  /// A root for sensors to be looked for below, and none is there, whatever this machine has.
  [[nodiscard]] std::vector<std::string> no_sensors() const;
  /// Session folders that the program has written; in the order of their names.
  [[nodiscard]] std::vector<std::filesystem::path> sessions() const;
  /// Closes the window and expects exit code 0: OpenGL has not complained, either.
  void close();
  /// The program, which has been told to end, does so with this code.
  void expect_exit(int code);

  [[nodiscard]] Person& person() { return *person_; }
  [[nodiscard]] EncoreProcess& program() { return *program_; }
  [[nodiscard]] _XDisplay* display() const { return display_->connection(); }
  [[nodiscard]] const std::string& display_name() const { return display_->name(); }
  [[nodiscard]] const TemporaryFolder& home() const { return home_; }

 private:
  TemporaryFolder home_;
  std::unique_ptr<VirtualDisplay> display_;
  std::unique_ptr<EncoreProcess> program_;
  std::unique_ptr<Person> person_;
};

}  // namespace encore::test
