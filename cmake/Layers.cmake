# One static library per folder. The folder is the registry of its units: every .cpp in it is built.

add_library(dotek_options INTERFACE)
target_compile_options(dotek_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns of overlaps inside std::string's own operator+ (GCC bug 105329).
  target_compile_options(dotek_options INTERFACE -Wno-restrict)
endif()
target_include_directories(dotek_options INTERFACE ${CMAKE_SOURCE_DIR})
if(DOTEK_SANITIZE)
  target_compile_options(dotek_options INTERFACE
    -O1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all)
  target_link_options(dotek_options INTERFACE -fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # The instrumented code of a std::variant's move looks uninitialised to GCC.
    target_compile_options(dotek_options INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(DOTEK_FUZZ)
  target_compile_options(dotek_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# dotek_layer(<folder> LINK <public>... PRIVATE_LINK <private>... SOURCES <generated>... LATE <generated>...)
# LATE sources are written by a tool that is built from the others (dotek_<folder>_objects).
function(dotek_layer folder)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE_LINK;SOURCES;LATE" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/[A-Za-z]*.cpp)
  set(sources ${sources} ${ARG_SOURCES})
  if(ARG_LATE)
    add_library(dotek_${name}_objects OBJECT ${sources})
    target_link_libraries(dotek_${name}_objects PUBLIC ${ARG_LINK} PRIVATE dotek_options ${ARG_PRIVATE_LINK})
    set(sources $<TARGET_OBJECTS:dotek_${name}_objects> ${ARG_LATE})
  endif()
  if(sources)
    add_library(dotek_${name} STATIC ${sources})
    target_link_libraries(dotek_${name} PUBLIC ${ARG_LINK} PRIVATE dotek_options ${ARG_PRIVATE_LINK})
  else()
    add_library(dotek_${name} INTERFACE)
    target_link_libraries(dotek_${name} INTERFACE ${ARG_LINK})
  endif()
endfunction()
