#include "ui/versions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <glm/glm.hpp>
#include <imgui.h>

namespace encore::ui {

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {
#ifdef ENCORE_VERSION
      {"ENCORE", ENCORE_VERSION},
#endif
      {"Dear ImGui", ImGui::GetVersion()},
      {"GLFW",
       fmt::format("{}.{}.{}", GLFW_VERSION_MAJOR, GLFW_VERSION_MINOR, GLFW_VERSION_REVISION)},
      {"GLM", fmt::format("{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
      {"{fmt}",
       fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"compiler", __VERSION__}};
}

}  // namespace encore::ui
