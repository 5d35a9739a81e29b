#pragma once

#include "app/exit_code.h"

#include <CLI/CLI.hpp>

namespace encore::app {

/// Each add_* declares one subcommand with its options; when chosen on the command line, its
/// callback does the work and stores the exit code. Errors leave as exceptions (main.cpp turns
/// scene::InputError into 3, UsageError into 2, anything else into 1).
/// The window, which opens where no subcommand is given.
void add_window(CLI::App& app, ExitCode& result);
void add_scenes_command(CLI::App& app, ExitCode& result);
void add_info_command(CLI::App& app, ExitCode& result);
void add_verify_command(CLI::App& app, ExitCode& result);
void add_profile_command(CLI::App& app, ExitCode& result);
void add_render_command(CLI::App& app, ExitCode& result);
void add_study_command(CLI::App& app, ExitCode& result);
void add_doctor_command(CLI::App& app, ExitCode& result);
void add_battery_command(CLI::App& app, ExitCode& result);
void add_compare_command(CLI::App& app, ExitCode& result);
void add_model_command(CLI::App& app, ExitCode& result);
void add_attach_command(CLI::App& app, ExitCode& result);
void add_accuracy_command(CLI::App& app, ExitCode& result);
void add_bench_command(CLI::App& app, ExitCode& result);

}  // namespace encore::app
