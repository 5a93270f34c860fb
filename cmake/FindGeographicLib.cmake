# GeographicLib as packaged by Debian: its own find module lies where CMake does not look and sets
# variables only. This one makes the target GeographicLib::GeographicLib; it is installed with the
# export, because the static libraries hand it on.
find_path(GeographicLib_INCLUDE_DIR GeographicLib/LocalCartesian.hpp)
find_library(GeographicLib_LIBRARY NAMES GeographicLib Geographic)
mark_as_advanced(GeographicLib_INCLUDE_DIR GeographicLib_LIBRARY)

if(GeographicLib_INCLUDE_DIR AND EXISTS "${GeographicLib_INCLUDE_DIR}/GeographicLib/Config.h")
  file(STRINGS "${GeographicLib_INCLUDE_DIR}/GeographicLib/Config.h" version_line
    REGEX "#define GEOGRAPHICLIB_VERSION_STRING")
  string(REGEX REPLACE ".*\"([^\"]+)\".*" "\\1" GeographicLib_VERSION "${version_line}")
  unset(version_line)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GeographicLib
  REQUIRED_VARS GeographicLib_LIBRARY GeographicLib_INCLUDE_DIR VERSION_VAR GeographicLib_VERSION)

if(GeographicLib_FOUND AND NOT TARGET GeographicLib::GeographicLib)
  add_library(GeographicLib::GeographicLib UNKNOWN IMPORTED)
  set_target_properties(GeographicLib::GeographicLib PROPERTIES
    IMPORTED_LOCATION "${GeographicLib_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${GeographicLib_INCLUDE_DIR}")
endif()
