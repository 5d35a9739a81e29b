#pragma once

#include "app/render_device.h"
#include "app/render_options.h"
#include "app/terminal.h"
#include "renderer/heatmap.h"
#include "renderer/image_diff.h"

#include <cstdint>
#include <optional>
#include <string>

namespace encore::app {

/// How far the picture is from another device's.
struct RenderComparison {
  DrawFigures figures;  ///< of the other device
  renderer::ImageDifference difference;
  std::optional<std::uint64_t> differing_hits;  ///< pixels; empty if one of the two has no hits
};

/// What a picture cost and shows.
struct RenderReport {
  std::string scene;
  std::size_t triangles = 0;
  std::string structure;           ///< empty: none was built
  std::optional<double> build_ms;  ///< likewise
  ImageSize size;
  DrawFigures figures;
  std::optional<renderer::CostStatistics> costs;
  std::optional<RenderComparison> comparison;
};

/// As JSON on standard output with --json, else in words on standard error.
void print_render_report(const RenderReport& report, const RenderOptions& options,
                         Terminal& terminal);

}  // namespace encore::app
