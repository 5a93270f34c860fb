# What makes a build quicker and its result no other: a compiler cache that two clones share, and a
# quicker linker; each is used where it is installed.
find_program(PLACEGRAPH_CCACHE ccache)
if(PLACEGRAPH_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Paths below the clone count as relative to it (base directory), and its own path does not count (no
  # hash of the working directory): another clone finds what this one has compiled. Precompiled
  # headers need the sloppiness about defines and times.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${PLACEGRAPH_CCACHE})
endif()

find_program(PLACEGRAPH_MOLD mold)
if(PLACEGRAPH_MOLD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12.1)
  add_link_options(-fuse-ld=mold)
elseif(PLACEGRAPH_MOLD AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_link_options(-fuse-ld=mold)
endif()
