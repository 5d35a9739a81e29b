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

find_path(ENCORE_GLM_DIR glm/glm.hpp REQUIRED)
find_path(ENCORE_CLI11_DIR CLI/CLI.hpp REQUIRED)
