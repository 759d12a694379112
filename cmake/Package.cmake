# The library for other programs: docs/library.md.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# dotek_package(): dotek::dotek, one archive of all layers declared so far, and the rules that install it.
function(dotek_package)
  get_property(libraries GLOBAL PROPERTY DOTEK_LIBRARIES)
  list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  add_library(dotek_library STATIC ${objects})
  add_library(dotek::dotek ALIAS dotek_library)
  set_target_properties(dotek_library PROPERTIES
    OUTPUT_NAME dotek EXPORT_NAME dotek LINKER_LANGUAGE CXX ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_compile_features(dotek_library PUBLIC cxx_std_20)
  target_include_directories(dotek_library INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/dotek>)
  # What dotekConfig.cmake finds again; the other libraries are headers of ours alone.
  target_link_libraries(dotek_library PUBLIC fmt::fmt PRIVATE Antlr4Runtime::Antlr4Runtime Duktape::Duktape Md::Md)
  if(DOTEK_SANITIZE)
    target_link_options(dotek_library INTERFACE -fsanitize=address,undefined)
  endif()
  if(NOT DOTEK_INSTALL)
    return()
  endif()

  set(package ${CMAKE_INSTALL_LIBDIR}/cmake/dotek)
  install(TARGETS dotek_library EXPORT dotek COMPONENT development)
  install(EXPORT dotek NAMESPACE dotek:: FILE dotekTargets.cmake DESTINATION ${package}
    COMPONENT development)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/dotekConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/generated/dotekConfigVersion.cmake cmake/dotekConfig.cmake
    cmake/FindAntlr4Runtime.cmake cmake/FindDuktape.cmake cmake/FindMd.cmake DESTINATION ${package} COMPONENT development)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
  install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")
set(INCLUDES \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/dotek\")" COMPONENT development)
  install(SCRIPT cmake/InstallHeaders.cmake COMPONENT development)
endfunction()

# Beside the program: manual pages and completions, made when it is installed; docs, examples, data files to copy from, settings of
# editors, and the licences of what is in the program.
function(dotek_install_manual)
  install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")
set(PROGRAM \"$<TARGET_FILE:dotek>\")
set(SHARE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
set(NOTICES \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/notices.txt\")" COMPONENT program)
  install(SCRIPT packaging/InstallManual.cmake COMPONENT program)
  install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program FILES_MATCHING PATTERN "*.md" PATTERN "*.svg"
    PATTERN "*.schema.json" PATTERN library EXCLUDE)
  install(FILES README.md CHANGELOG.md .pre-commit-hooks.yaml DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
  install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
  install(DIRECTORY editors/nvim editors/kate DESTINATION ${CMAKE_INSTALL_DOCDIR}/editors COMPONENT program)
  install(DIRECTORY stdlib/ DESTINATION ${CMAKE_INSTALL_DATADIR}/dotek COMPONENT program FILES_MATCHING PATTERN "*.toml" PATTERN "*.cycle"
    PATTERN "*.nc" PATTERN store EXCLUDE PATTERN fusion EXCLUDE PATTERN keywords EXCLUDE)
endfunction()
