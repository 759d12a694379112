# Md::Md, the digests of BSD (libmd). Used by the build and by the installed package.
find_path(MD_INCLUDE_DIR sha2.h)
# The archive first: one shared library less to load at each start.
find_library(MD_LIBRARY NAMES libmd.a md)
mark_as_advanced(MD_INCLUDE_DIR MD_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Md REQUIRED_VARS MD_LIBRARY MD_INCLUDE_DIR)
if(Md_FOUND AND NOT TARGET Md::Md)
  add_library(Md::Md UNKNOWN IMPORTED)
  set_target_properties(Md::Md PROPERTIES IMPORTED_LOCATION ${MD_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${MD_INCLUDE_DIR})
endif()
