# One static library per folder. The folder is the registry of its units: every .cpp in it is built.

add_library(dotek_options INTERFACE)
target_compile_options(dotek_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off -fno-char8_t)
if(DOTEK_WERROR)
  target_compile_options(dotek_options INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns of what cannot be inside std::string and std::variant (GCC bugs 105329, 105651, 105562), and a
  # precompiled header hides from it that they are the system's.
  target_compile_options(dotek_options INTERFACE
    -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds -Wno-maybe-uninitialized)
endif()
target_include_directories(dotek_options INTERFACE ${PROJECT_SOURCE_DIR})
if(DOTEK_SANITIZE)
  target_compile_options(dotek_options INTERFACE
    -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all)
  target_link_options(dotek_options INTERFACE -fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Tests start the program hundreds of times: a program at a fixed place has nothing to relocate. With ASan in
    # a shared library each entry into a function asks where its thread's data are.
    target_link_options(dotek_options INTERFACE -no-pie -static-libasan -static-libubsan)
    # The instrumented code of a std::variant's move looks uninitialised to GCC.
    target_compile_options(dotek_options INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(DOTEK_FUZZ)
  target_compile_options(dotek_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# dotek_precompile(<target> <header>...): Precompiled.h and the headers of the project that each source of the
# target includes. Targets without headers of their own share one.
function(dotek_precompile target)
  if(NOT DOTEK_PRECOMPILE)
    return()
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Winvalid-pch -fpch-preprocess)
  endif()
  if(ARGN)
    list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE headers)
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/Precompiled.h ${headers})
    return()
  endif()
  if(NOT TARGET dotek_precompiled)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/Precompiled.cpp CONTENT "")
    add_library(dotek_precompiled OBJECT ${PROJECT_BINARY_DIR}/generated/Precompiled.cpp)
    target_link_libraries(dotek_precompiled PRIVATE dotek_options fmt::fmt)
    dotek_precompile(dotek_precompiled cmake/Precompiled.h)
  endif()
  target_precompile_headers(${target} REUSE_FROM dotek_precompiled)
endfunction()

# dotek_layer(<folder> EXCLUDE <prefix> PRECOMPILE <headers>... LINK <public>... PRIVATE_LINK <private>... SOURCES <generated>...
#             LATE <generated>...)
# Sources of the folder whose names begin with EXCLUDE belong to another layer. LATE sources are written by a
# tool that is built from the others (dotek_<folder>_objects).
function(dotek_layer folder)
  cmake_parse_arguments(ARG "" "EXCLUDE" "PRECOMPILE;LINK;PRIVATE_LINK;SOURCES;LATE" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/[A-Za-z]*.cpp)
  if(ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "/${ARG_EXCLUDE}[^/]*$")
  endif()
  set(sources ${sources} ${ARG_SOURCES})
  if(ARG_LATE)
    add_library(dotek_${name}_objects OBJECT ${sources})
    target_link_libraries(dotek_${name}_objects PUBLIC ${ARG_LINK} PRIVATE dotek_options ${ARG_PRIVATE_LINK})
    dotek_precompile(dotek_${name}_objects ${ARG_PRECOMPILE})
    set(sources $<TARGET_OBJECTS:dotek_${name}_objects> ${ARG_LATE})
    set_property(GLOBAL APPEND PROPERTY DOTEK_LIBRARIES dotek_${name}_objects)
  endif()
  if(sources)
    add_library(dotek_${name} STATIC ${sources})
    target_link_libraries(dotek_${name} PUBLIC ${ARG_LINK} PRIVATE dotek_options ${ARG_PRIVATE_LINK})
    dotek_precompile(dotek_${name} ${ARG_PRECOMPILE})
    set_property(GLOBAL APPEND PROPERTY DOTEK_LIBRARIES dotek_${name})
  else()
    add_library(dotek_${name} INTERFACE)
    target_link_libraries(dotek_${name} INTERFACE ${ARG_LINK})
  endif()
endfunction()
