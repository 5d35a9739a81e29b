# What an installation holds, and the Debian package of it (`cpack -G DEB` in the build folder).
# The program finds share/encore by its own place (scene/shipped_files.h), so all of it can be moved.
include(GNUInstallDirs)
set(desktop "${PROJECT_SOURCE_DIR}/assets/desktop")

install(TARGETS encore RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(DIRECTORY assets/scenes assets/studies assets/thesis
        DESTINATION "${CMAKE_INSTALL_DATADIR}/encore")

install(FILES "${desktop}/encore.desktop" DESTINATION "${CMAKE_INSTALL_DATADIR}/applications")
install(FILES "${desktop}/encore.metainfo.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/metainfo"
        RENAME invalid.encore.encore.metainfo.xml)
foreach(side 16 32 48 64 128 256 512)
  install(FILES "${desktop}/icons/${side}x${side}/encore.png"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/${side}x${side}/apps")
endforeach()
install(FILES "${desktop}/encore.svg"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps")

set(doc "${CMAKE_INSTALL_DATADIR}/doc/encore")
install(FILES README.md DESTINATION "${doc}")
install(FILES LICENSE DESTINATION "${doc}" RENAME copyright)
install(DIRECTORY docs DESTINATION "${doc}")

# Packages hold their manual page and changelog compressed; without gzip they are installed as is.
install(FILES "${desktop}/encore.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${desktop}/changelog" DESTINATION "${doc}")
find_program(ENCORE_GZIP gzip)
if(ENCORE_GZIP)
  foreach(file "${CMAKE_INSTALL_MANDIR}/man1/encore.1" "${doc}/changelog")
    if(NOT IS_ABSOLUTE "${file}")
      set(file "\${CMAKE_INSTALL_PREFIX}/${file}")
    endif()
    install(CODE "execute_process(COMMAND \"${ENCORE_GZIP}\" -9nf \"\$ENV{DESTDIR}${file}\"
                                  COMMAND_ERROR_IS_FATAL ANY)")
  endforeach()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME encore)
set(CPACK_PACKAGE_VENDOR "The ENCORE authors")
# Nobody answers at .invalid, a reserved domain; who distributes the package gives an address with
# cpack -D CPACK_DEBIAN_PACKAGE_MAINTAINER=...
set(CPACK_PACKAGE_CONTACT "The ENCORE authors <encore@encore.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "energy and time profiler of ray-tracing acceleration structures")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "\
ENCORE builds uniform grids, kd-trees and bounding volume hierarchies over a
model, checks that each returns the right hits, and measures what building,
sending and tracing them costs on the processor and on the graphics card: in
time, and in joules where the machine has a power sensor.
.
It has a window and a command line for studies of many tests, and writes what
it measured as CSV files.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
    GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# EGL and the drivers are loaded when they are asked for, so no link tells of them.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-dejavu-core, libegl1, libgl1-mesa-dri")
include(CPack)
