# Duktape::Duktape. Used by the build and by the installed package.
find_path(DUKTAPE_INCLUDE_DIR duktape.h)
find_library(DUKTAPE_LIBRARY duktape)
mark_as_advanced(DUKTAPE_INCLUDE_DIR DUKTAPE_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Duktape REQUIRED_VARS DUKTAPE_LIBRARY DUKTAPE_INCLUDE_DIR)
if(Duktape_FOUND AND NOT TARGET Duktape::Duktape)
  add_library(Duktape::Duktape UNKNOWN IMPORTED)
  set_target_properties(Duktape::Duktape PROPERTIES
    IMPORTED_LOCATION ${DUKTAPE_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${DUKTAPE_INCLUDE_DIR})
endif()
