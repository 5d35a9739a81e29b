#pragma once

#include "app/exit_code.h"
#include "app/measuring_options.h"

#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What the command line says of the window.
struct WindowOptions {
  std::string scene;  ///< empty: the default one
  std::vector<std::string> search_path;
  std::optional<int> gl_device;
  MeasuringOptions measuring;  ///< sources and model
  int threads = 0;
  std::optional<std::string> size;  ///< of the window: "1280x800"
  bool fresh = false;               ///< as at the first start: kept settings are not read
  std::string widget_map;           ///< file that tells where each widget is, for test programs
  bool gl_debug = false;            ///< a debug context; its errors are told at the end
  std::string timings;              ///< file for the frame times, one a line, in milliseconds
};

/// Opens the window and runs it until it is closed or `stop` is set. Throws WindowUnavailable.
ExitCode run_window(const WindowOptions& options, const std::atomic<bool>& stop);

}  // namespace encore::app
