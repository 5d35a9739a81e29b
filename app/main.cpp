#include "app/commands/commands.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/window/glfw_window.h"
#include "energy/sources/discovery.h"
#include "renderer/gl/error.h"
#include "scene/diagnostics.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

namespace {

using encore::app::ExitCode;

int fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "encore: {}\n", message);
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  CLI::App app{
      "ENCORE: what does it cost to build, update, ship and trace an acceleration structure for "
      "this scene?"};
  app.set_version_flag("--version", std::string("encore ") + ENCORE_VERSION);
  app.require_subcommand(0, 1);
  app.footer(
      "Exit codes: 0 ok, 1 failure, 2 usage, 3 bad input, 4 no usable power sensor,\n"
      "5 no usable OpenGL or display, 6 verification mismatch, 7 regression,\n"
      "130 interrupted (what was measured is saved).");

  ExitCode result = ExitCode::ok;
  encore::app::add_window(app, result);
  encore::app::add_profile_command(app, result);
  encore::app::add_study_command(app, result);
  encore::app::add_render_command(app, result);
  encore::app::add_verify_command(app, result);
  encore::app::add_info_command(app, result);
  encore::app::add_scenes_command(app, result);
  encore::app::add_doctor_command(app, result);
  encore::app::add_battery_command(app, result);
  encore::app::add_compare_command(app, result);
  encore::app::add_model_command(app, result);
  encore::app::add_attach_command(app, result);
  encore::app::add_accuracy_command(app, result);
  encore::app::add_bench_command(app, result);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(ExitCode::usage);
  } catch (const encore::app::UsageError& error) {
    return fail(ExitCode::usage, error.what());
  } catch (const encore::scene::InputError& error) {
    return fail(ExitCode::bad_input, error.what());
  } catch (const encore::energy::SensorError& error) {
    return fail(ExitCode::no_sensor, error.what());
  } catch (const encore::app::WindowUnavailable& error) {
    return fail(ExitCode::no_display, error.what());
  } catch (const encore::renderer::gl::GlUnavailable& error) {
    return fail(ExitCode::no_display, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::failure, "out of memory; close other programs or use a smaller scene");
  } catch (const std::exception& error) {
    return fail(ExitCode::failure, error.what());
  }
  return static_cast<int>(result);
}

}  // namespace

int main(int argc, char** argv) {
  encore::app::install_interrupt_handler();
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "encore: %s\n", error.what());
    return static_cast<int>(ExitCode::failure);
  }
}
