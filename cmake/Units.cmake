# A folder is the registry of its units: no list is edited to add one.

# dotek_rules(<output.cpp> <sources variable>): each lint/rules/<id>.cpp and lint/rules/shared/<id>.cpp is the rule <id>.
# Stops where its document is missing, or where a document has no rule. The shared ones, of one line each, are compiled
# as one source.
function(dotek_rules output variable)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lint/rules/*.cpp)
  file(GLOB shared CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lint/rules/shared/*.cpp)
  file(GLOB documents CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/rules/[a-z]*.md) # README.md is their list
  set(ids "")
  foreach(source IN LISTS sources shared)
    get_filename_component(id ${source} NAME_WE)
    list(APPEND ids ${id})
  endforeach()
  list(SORT ids)
  set(references "")
  set(rows "")
  foreach(id IN LISTS ids)
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/docs/rules/${id}.md)
      message(FATAL_ERROR "the rule ${id} has no docs/rules/${id}.md, which documents and tests it")
    endif()
    string(REPLACE "-" "_" name ${id})
    string(APPEND references "extern const Rule ${name};\n")
    string(APPEND rows "    {\"${id}\", &rule::${name}},\n")
  endforeach()
  foreach(document IN LISTS documents)
    get_filename_component(id ${document} NAME_WE)
    if(NOT id IN_LIST ids)
      message(FATAL_ERROR "docs/rules/${id}.md documents no rule of lint/rules")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${output} CONTENT "#include \"lint/Rule.h\"

namespace dotek::lint {
namespace rule {
@references@} // namespace rule
namespace {
const NamedRule kRules[] = {
@rows@};
} // namespace
std::span<const NamedRule> rules() { return kRules; }
} // namespace dotek::lint
" @ONLY)
  list(TRANSFORM shared REPLACE "${PROJECT_SOURCE_DIR}/(.*)" "#include \"\\1\"\n" OUTPUT_VARIABLE includes)
  string(REPLACE ";" "" includes "${includes}")
  get_filename_component(folder ${output} DIRECTORY)
  file(CONFIGURE OUTPUT ${folder}/SharedRules.cpp CONTENT "@includes@" @ONLY)
  set(${variable} ${sources} ${output} ${folder}/SharedRules.cpp PARENT_SCOPE)
endfunction()

# dotek_targets(<output.cpp> <sources variable> <libraries variable>): each backends/<name>/ but `common` is the
# target <name>. Its Target*.cpp, which look up to front ends, simulator and verify, belong to the layer of
# targets; the others are the back end, from IR to text. Libraries.cmake, where there is one, adds what only
# this folder needs. Stops where a target has no Target.cpp or no document.
function(dotek_targets output sources_variable libraries_variable)
  file(GLOB folders CONFIGURE_DEPENDS LIST_DIRECTORIES true ${PROJECT_SOURCE_DIR}/backends/*)
  list(SORT folders)
  set(sources ${output})
  set(libraries "")
  set(references "")
  set(rows "")
  foreach(folder IN LISTS folders)
    get_filename_component(name ${folder} NAME)
    if(NOT IS_DIRECTORY ${folder} OR name STREQUAL "common")
      continue()
    endif()
    if(NOT EXISTS ${folder}/Target.cpp)
      message(FATAL_ERROR "backends/${name} has no Target.cpp, which says what the target takes and how it is written")
    endif()
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/docs/${name}.md)
      message(FATAL_ERROR "the target ${name} has no docs/${name}.md, which documents it")
    endif()
    dotek_layer(backends/${name} EXCLUDE Target LINK dotek_backends_common dotek_ir dotek_stdlib)
    if(EXISTS ${folder}/Libraries.cmake)
      include(${folder}/Libraries.cmake)
    endif()
    file(GLOB own CONFIGURE_DEPENDS ${folder}/Target*.cpp)
    list(APPEND sources ${own})
    list(APPEND libraries dotek_backends_${name})
    string(APPEND references "extern const Target ${name};\n")
    string(APPEND rows "    {\"${name}\", &target::${name}},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${output} CONTENT "#include \"targets/Target.h\"

namespace dotek::targets {
namespace target {
@references@} // namespace target
namespace {
const NamedTarget kTargets[] = {
@rows@};
} // namespace
std::span<const NamedTarget> allTargets() { return kTargets; }
} // namespace dotek::targets
" @ONLY)
  set(${sources_variable} ${sources} PARENT_SCOPE)
  set(${libraries_variable} ${libraries} PARENT_SCOPE)
endfunction()
