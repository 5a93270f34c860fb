# FindCAMD: SuiteSparse's constrained approximate minimum degree, which Debian installs without a
# CMake package. Defines CAMD::CAMD.
find_path(CAMD_INCLUDE_DIR suitesparse/camd.h)
find_library(CAMD_LIBRARY camd)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CAMD REQUIRED_VARS CAMD_LIBRARY CAMD_INCLUDE_DIR)
if(CAMD_FOUND AND NOT TARGET CAMD::CAMD)
  add_library(CAMD::CAMD UNKNOWN IMPORTED)
  set_target_properties(CAMD::CAMD PROPERTIES IMPORTED_LOCATION ${CAMD_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${CAMD_INCLUDE_DIR})
endif()
mark_as_advanced(CAMD_INCLUDE_DIR CAMD_LIBRARY)
