# Run by cmake --install: what packaging/manual.py makes of PROGRAM and SOURCE below SHARE, and the licences of the libraries that
# are in the program as NOTICES.
cmake_policy(VERSION 3.25)
find_program(PYTHON python3)
if(PYTHON)
  message(STATUS "Installing: ${SHARE}/man/man1 and completions")
  execute_process(COMMAND ${PYTHON} ${SOURCE}/packaging/manual.py --dotek ${PROGRAM} --cli ${SOURCE}/docs/cli.md --out ${SHARE}
                  RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "the manual pages were not made")
  endif()
else()
  message(WARNING "no manual pages and no completions: there is no python3")
endif()

# Debian puts the licence of each package there. doctest is in the tests alone.
set(text "The program contains, or is linked to, these libraries. Their licences follow.\n")
foreach(package libantlr4-runtime-dev libfmt-dev nlohmann-json3-dev libtomlplusplus-dev libcli11-dev duktape-dev libmd-dev libeigen3-dev)
  set(path /usr/share/doc/${package}/copyright)
  if(EXISTS ${path})
    file(READ ${path} licence)
    string(APPEND text "\n======== ${package}\n\n${licence}")
  else()
    message(WARNING "no licence of ${package} at ${path}: add it to ${NOTICES} before you hand the program on")
  endif()
endforeach()
file(WRITE ${NOTICES} "${text}")
message(STATUS "Installing: ${NOTICES}")
