# Antlr4Runtime::Antlr4Runtime, static where there is a choice. Used by the build and by the installed package.
find_path(ANTLR4_RUNTIME_INCLUDE_DIR antlr4-runtime.h PATH_SUFFIXES antlr4-runtime)
find_library(ANTLR4_RUNTIME_LIBRARY NAMES libantlr4-runtime.a antlr4-runtime)
mark_as_advanced(ANTLR4_RUNTIME_INCLUDE_DIR ANTLR4_RUNTIME_LIBRARY)
find_package(Threads)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Antlr4Runtime
  REQUIRED_VARS ANTLR4_RUNTIME_LIBRARY ANTLR4_RUNTIME_INCLUDE_DIR Threads_FOUND)
if(Antlr4Runtime_FOUND AND NOT TARGET Antlr4Runtime::Antlr4Runtime)
  add_library(Antlr4Runtime::Antlr4Runtime UNKNOWN IMPORTED)
  set_target_properties(Antlr4Runtime::Antlr4Runtime PROPERTIES
    IMPORTED_LOCATION ${ANTLR4_RUNTIME_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${ANTLR4_RUNTIME_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES Threads::Threads)
endif()
