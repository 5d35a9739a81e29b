# Libraries, all from the distribution's packages (see scripts/install-packages.sh).
find_package(Threads REQUIRED)
find_package(assimp REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
find_package(glfw3 REQUIRED)

find_path(ENCORE_GLM_DIR glm/glm.hpp REQUIRED)
find_path(ENCORE_CLI11_DIR CLI/CLI.hpp REQUIRED)

# Embree 3 is what `encore bench` compares with: its headers here, the library when that runs. Not
# for sanitizers, which know nothing of what it does.
find_package(embree 3 QUIET)
if(embree_FOUND AND NOT ENCORE_SANITIZE)
  set(ENCORE_HAVE_EMBREE ON)
else()
  set(ENCORE_HAVE_EMBREE OFF)
  message(STATUS "Embree 3 is not used: `encore bench` compares with nothing")
endif()
